#include "messaging/peer_watch.h"

#include <gmock/gmock.h>

#include <string>
#include <vector>

#include "messaging/local_network.h"
#include "tests/messaging/examples.h"

namespace fastball::messaging {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

constexpr double kLimit = 0.5;            // [s]
constexpr int64_t kBeatUs = 100'000;      // five within the limit
constexpr int64_t kLookUs = kBeatUs / 5;  // as wakeUs() asks for

class PeerWatchTest : public testing::Test {
 protected:
  void say(const std::string& name, const std::string& host, const std::string& state = "idle") {
    auto message = examples::example<heartbeat_t>();
    message.name = name;
    message.host = host;
    message.state = state;
    ASSERT_TRUE(speaker.publish(kHeartbeat, message));
  }
  void look() {
    listener.drain();
    for (const PeerNews& news : watch.update()) {
      (news.is_silent ? silent : back).push_back(news.names);
      sentences.push_back(news.sentence);
    }
  }
  /// Looks on schedule for so long; those in `speaking`, all on `robot`, say HEARTBEAT on theirs.
  void goOn(int64_t us, const std::vector<std::string>& speaking) {
    for (int64_t end = clock.monotonicUs() + us; clock.monotonicUs() < end;) {
      clock.advanceUs(kLookUs);
      if (clock.monotonicUs() % kBeatUs == 0)
        for (const std::string& name : speaking)
          say(name, "robot");
      look();
    }
  }

  ManualClock clock;
  LocalNetwork network{clock};
  Endpoint& speaker = network.addEndpoint();
  Endpoint& listener = network.addEndpoint();
  PeerWatch watch{listener, clock, "logger", kLimit};
  std::vector<std::vector<std::string>> silent, back;
  std::vector<std::string> sentences;
};

TEST_F(PeerWatchTest, AsksToLookOftenEnough) {
  look();
  EXPECT_EQ(watch.wakeUs(), clock.monotonicUs() + kLookUs);
}

TEST_F(PeerWatchTest, NoticesWithinTheLimitAndSaysItOnceAndThatItIsBackOnce) {
  goOn(1'000'000, {"controller", "sim_bullet"});
  EXPECT_THAT(sentences, IsEmpty());
  const int64_t heard = clock.monotonicUs();
  while (silent.empty())
    goOn(kLookUs, {});
  EXPECT_LE(clock.monotonicUs() - heard, 500'000);
  EXPECT_GT(clock.monotonicUs() - heard, 400'000);
  EXPECT_THAT(silent, ElementsAre(ElementsAre("controller", "sim_bullet")));
  EXPECT_EQ(watch.silence(),
            "nothing has been heard of robot (controller, sim_bullet) for 0.48 s "
            "(silence_limit 0.5 s)");
  EXPECT_EQ(sentences.back(), watch.silence());
  goOn(1'520'000, {});
  EXPECT_EQ(silent.size(), 1U);
  goOn(1'000'000, {"controller"});
  EXPECT_THAT(back, ElementsAre(ElementsAre("controller")));
  EXPECT_EQ(sentences.back(), "controller on robot is heard again, after 2.10 s");
  EXPECT_THAT(watch.silence(),
              testing::StartsWith("nothing has been heard of sim_bullet on robot"));
  goOn(kBeatUs, {"controller", "sim_bullet"});
  EXPECT_EQ(watch.silence(), "");
  EXPECT_EQ(silent.size(), 1U);
}

TEST_F(PeerWatchTest, TimeInWhichItDidNotRunItselfDoesNotCount) {
  goOn(kBeatUs, {"controller"});
  for (int i = 0; i < 3; ++i) {
    clock.advanceUs(10'000'000);
    look();
    EXPECT_THAT(silent, IsEmpty()) << i;
    goOn(kBeatUs, {"controller"});
  }
}

TEST_F(PeerWatchTest, ThreeHeartbeatsLostInARowAreNoSilence) {
  goOn(1'000'000, {"controller"});
  for (int i = 0; i < 10; ++i) {
    goOn(3 * kBeatUs, {});
    goOn(kBeatUs, {"controller"});
  }
  EXPECT_THAT(sentences, IsEmpty());
}

TEST_F(PeerWatchTest, LastWordsThePlannersWorkAndItselfAreNotWaitedFor) {
  say("vision_tracker", "vision", "ended");
  say("hand_server", "robot", "failed");
  say("planner", "operator", "planning");
  say("logger", "operator");
  goOn(5'000'000, {});
  EXPECT_THAT(sentences, IsEmpty());
  say("planner", "operator", "idle");
  goOn(1'000'000, {});
  EXPECT_THAT(silent, ElementsAre(ElementsAre("planner")));
}

TEST_F(PeerWatchTest, WhoWasStartedOnAnotherMachineIsNotMissedOnTheOldOne) {
  say("vision_tracker", "old");
  goOn(1'000'000, {});
  say("vision_tracker", "new");
  look();
  EXPECT_EQ(watch.silence(), "");
}

}  // namespace
}  // namespace fastball::messaging
