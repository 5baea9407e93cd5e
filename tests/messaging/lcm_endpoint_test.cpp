#include "messaging/lcm_endpoint.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cstring>
#include <random>
#include <stdexcept>
#include <thread>
#include <vector>

#include "messaging/multicast_check.h"
#include "tests/messaging/examples.h"

namespace fastball::messaging {
namespace {

using examples::example;
using SteadyClock = std::chrono::steady_clock;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// Drains until `done()`, at most 30 s.
template <class Done>
bool drainUntil(LcmEndpoint& endpoint, Done done) {
  const auto end = SteadyClock::now() + std::chrono::seconds(30);
  while (!done() && SteadyClock::now() < end) {
    if (endpoint.drain() == 0)
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return done();
}

TEST(LcmUrl, GetsAReceiveBufferUnlessItNamesOne) {
  EXPECT_EQ(withReceiveBuffer("udpm://239.255.76.67:7667"),
            "udpm://239.255.76.67:7667?recv_buf_size=4194304");
  EXPECT_EQ(withReceiveBuffer("udpm://239.255.76.67:7667?ttl=1"),
            "udpm://239.255.76.67:7667?ttl=1&recv_buf_size=4194304");
  EXPECT_EQ(withReceiveBuffer("udpm://?recv_buf_size=9"), "udpm://?recv_buf_size=9");
  EXPECT_EQ(withReceiveBuffer("memq://"), "memq://");
}

TEST(LcmUrl, ComesFromTheEnvironment) {
  setenv("LCM_DEFAULT_URL", "udpm://239.255.76.67:1111?ttl=0", 1);
  EXPECT_EQ(defaultLcmUrl(), "udpm://239.255.76.67:1111?ttl=0");
  setenv("FASTBALL_LCM_URL", "udpm://239.255.76.67:2222?ttl=0", 1);
  EXPECT_EQ(defaultLcmUrl(), "udpm://239.255.76.67:2222?ttl=0");
  unsetenv("FASTBALL_LCM_URL");
  unsetenv("LCM_DEFAULT_URL");
  EXPECT_EQ(defaultLcmUrl(), kDefaultLcmUrl);
}

TEST(LcmUrl, IsTakenApart) {
  const auto url = parseMulticastUrl("udpm://239.1.2.3:7700?ttl=1&recv_buf_size=5").value();
  EXPECT_EQ(url.group, "239.1.2.3");
  EXPECT_EQ(url.port, 7700);
  EXPECT_EQ(url.ttl, 1);
  EXPECT_EQ(parseMulticastUrl("udpm://").value().port, 7667);
  EXPECT_EQ(parseMulticastUrl("memq://"), std::nullopt);
}

TEST(LcmUrl, ThatDoesNotParseIsRefused) {
  for (const char* url :
       {"udpm://10.0.0.1:7667", "udpm://239.255.76.67:0", "udpm://239.255.76.67:99999",
        "udpm://239.255.76:7667", "udpm://239.255.76.67:7667?ttl=300", "udpm://239.255.76.67:x"}) {
    try {
      LcmEndpoint endpoint(url);
      ADD_FAILURE() << url << " was accepted";
    } catch (const std::invalid_argument& error) {
      EXPECT_THAT(error.what(), HasSubstr(url));
    }
  }
  EXPECT_THROW(LcmEndpoint("carrier-pigeon://roof"), std::invalid_argument);
}

/// Two processes' endpoints in one program: LCM does not care.
class LcmEndpointTest : public ::testing::Test {
 protected:
  LcmEndpoint sender{defaultLcmUrl()};
  LcmEndpoint receiver{defaultLcmUrl()};
};

TEST_F(LcmEndpointTest, CarriesEveryFieldOfStatesImagesAndPlans) {
  Latest<arm_state_t> state(receiver, kArmState);
  Latest<image_t> image(receiver, kCameraLeft);
  Latest<swing_plan_t> plan(receiver, kSwingPlan);
  auto big = example<image_t>();
  big.pixelformat = image_t::MJPEG;
  big.size = 60000;
  for (int i = 0; i < big.size; ++i)
    big.data.push_back(static_cast<uint8_t>(i));
  big.data.resize(60000);
  ASSERT_TRUE(sender.publish(kArmState, example<arm_state_t>()));
  ASSERT_TRUE(sender.publish(kCameraLeft, big));
  ASSERT_TRUE(sender.publish(kSwingPlan, example<swing_plan_t>()));
  ASSERT_TRUE(
      drainUntil(receiver, [&] { return state.get() != nullptr && image.get() && plan.get(); }));
  EXPECT_EQ(state.get()->q[0], example<arm_state_t>().q[0]);
  EXPECT_EQ(image.get()->data, big.data);
  EXPECT_EQ(plan.get()->q, example<swing_plan_t>().q);
  EXPECT_EQ(plan.get()->parameter_names, example<swing_plan_t>().parameter_names);
}

TEST_F(LcmEndpointTest, EmptyVectorsDoNotKeepWhatCameBefore) {
  Latest<swing_plan_t> plan(receiver, kSwingPlan);
  auto refused = example<swing_plan_t>();
  refused.plan_id = 2;
  refused.status = swing_plan_t::REFUSED;
  refused.n_parameters = refused.n_samples = 0;
  refused.parameters.clear();
  refused.parameter_names.clear();
  for (auto* rows : {&refused.q, &refused.qd, &refused.qdd})
    rows->clear();
  sender.publish(kSwingPlan, example<swing_plan_t>());
  sender.publish(kSwingPlan, refused);
  ASSERT_TRUE(drainUntil(receiver, [&] { return plan.get() && plan.get()->plan_id == 2; }));
  EXPECT_TRUE(plan.get()->parameters.empty());
}

TEST_F(LcmEndpointTest, BurstWaitsForASlowReaderInOrder) {
  std::vector<int64_t> heard;
  receiver.subscribe<arm_state_t>(kArmState, [&](const auto& m) { heard.push_back(m.seq); });
  Publisher<arm_state_t> publisher(sender, kArmState);
  std::vector<int64_t> sent;
  auto state = example<arm_state_t>();
  for (int i = 0; i < 2000; ++i) {
    ASSERT_TRUE(publisher.publish(state));
    sent.push_back(state.seq);
  }
  // Nobody has drained meanwhile.
  ASSERT_TRUE(drainUntil(receiver, [&] { return heard.size() >= sent.size(); })) << heard.size();
  EXPECT_EQ(heard, sent);
  EXPECT_EQ(receiver.counts().at("ARM_STATE").lost, 0);
}

TEST_F(LcmEndpointTest, HostileBytesAreCountedAndDropped) {
  int handled = 0;
  receiver.subscribe<swing_plan_t>(kSwingPlan, [&](const auto&) { ++handled; });
  const auto plan = example<swing_plan_t>();
  std::vector<uint8_t> good(static_cast<std::size_t>(plan.getEncodedSize()));
  plan.encode(good.data(), 0, static_cast<int>(good.size()));
  int sent = 0;
  const auto send = [&](const std::vector<uint8_t>& bytes) {
    EXPECT_TRUE(sender.publishBytes("SWING_PLAN", bytes.data(), bytes.size()));
    ++sent;
  };
  send({});
  send({good.begin(), good.begin() + 40});
  auto wrong_type = good;
  wrong_type[0] ^= 0xff;
  send(wrong_type);
  auto trailing = good;
  trailing.push_back(7);
  send(trailing);
  // The row count stands 3 matrices of 3 x 4 doubles before the end.
  const std::size_t count_at = good.size() - 3UL * 3 * 4 * sizeof(double) - 4;
  for (const uint8_t top_byte : {0x80, 0xff, 0x7f, 0x23}) {
    auto hostile_count = good;
    hostile_count[count_at] = top_byte;
    send(hostile_count);
  }
  auto nan = good;
  std::memset(nan.data() + nan.size() - 8, 0xff, 8);
  send(nan);
  std::mt19937 random(1);
  for (int i = 0; i < 500; ++i) {
    std::vector<uint8_t> noise(random() % 300);
    for (auto& byte : noise)
      byte = static_cast<uint8_t>(random());
    send(noise);
  }
  const ReceiveCounts& counts = receiver.counts().at("SWING_PLAN");
  EXPECT_TRUE(drainUntil(receiver, [&] { return counts.invalid >= sent; })) << counts.invalid;
  EXPECT_EQ(handled, 0);
  send(good);
  EXPECT_TRUE(drainUntil(receiver, [&] { return handled == 1; }));
  EXPECT_EQ(counts.accepted, 1);
}

TEST_F(LcmEndpointTest, HandlerThatThrowsIsCountedAndTheNextMessageComes) {
  int calls = 0;
  receiver.subscribe<estop_t>(kEstop, [&](const auto&) {
    if (++calls == 1)
      throw std::runtime_error("no");
    if (calls == 2)
      throw 7;  // NOLINT: not even an exception
  });
  for (int i = 0; i < 3; ++i)
    sender.publish(kEstop, example<estop_t>());
  ASSERT_TRUE(drainUntil(receiver, [&] { return calls == 3; }));
  EXPECT_EQ(receiver.counts().at("ESTOP").invalid, 2);
  EXPECT_EQ(receiver.counts().at("ESTOP").accepted, 1);
}

TEST_F(LcmEndpointTest, BrokenOrOversizeMessageIsNotSent) {
  auto command = example<arm_command_t>();
  command.tau[0] = NAN;
  EXPECT_FALSE(sender.publish(kArmCommand, command));
  const Channel<swing_plan_t> narrow{"SWING_PLAN", 100};
  EXPECT_FALSE(sender.publish(narrow, example<swing_plan_t>()));
  EXPECT_EQ(sender.unsent(), 2);
}

TEST_F(LcmEndpointTest, GapsAreCounted) {
  int heard = 0;
  receiver.subscribe<arm_state_t>(kArmState, [&](const auto&) { ++heard; });
  for (const int64_t seq : {0, 1, 5, 5}) {
    auto state = example<arm_state_t>();
    state.seq = seq;
    sender.publish(kArmState, state);
  }
  ASSERT_TRUE(drainUntil(receiver, [&] { return heard == 4; }));
  EXPECT_EQ(receiver.counts().at("ARM_STATE").lost, 3);
  EXPECT_EQ(receiver.counts().at("ARM_STATE").repeated, 1);
}

TEST_F(LcmEndpointTest, RawSubscriptionHearsBytesOfMatchingChannels) {
  std::vector<std::string> heard;
  int64_t heard_utime = 0;
  receiver.subscribeRaw("(ESTOP|X_.*)", [&](const std::string& channel, const void* data,
                                            std::size_t size, int64_t utime) {
    heard.push_back(channel + " " + std::string(static_cast<const char*>(data), size));
    heard_utime = utime;
  });
  sender.publishBytes("X_1", "abc", 3);
  sender.publishBytes("OTHER", "def", 3);
  sender.publishBytes("ESTOP", "", 0);
  ASSERT_TRUE(drainUntil(receiver, [&] { return heard.size() >= 2; }));
  EXPECT_THAT(heard, ElementsAre("X_1 abc", "ESTOP "));
  const auto now_us = std::chrono::duration_cast<std::chrono::microseconds>(
                          std::chrono::system_clock::now().time_since_epoch())
                          .count();
  EXPECT_NEAR(static_cast<double>(heard_utime), static_cast<double>(now_us), 60e6);
}

TEST_F(LcmEndpointTest, RawHandlerThatThrowsMakesDrainThrow) {
  receiver.subscribeRaw("ESTOP", [](const auto&...) { throw std::runtime_error("disk full"); });
  sender.publish(kEstop, example<estop_t>());
  EXPECT_THROW(drainUntil(receiver, [] { return false; }), std::runtime_error);
  EXPECT_NO_THROW(receiver.drain());
}

TEST(LcmEndpointInMemory, WorksWithoutNetwork) {
  LcmEndpoint endpoint("memq://");
  Latest<arm_state_t> state(endpoint, kArmState);
  endpoint.publish(kArmState, example<arm_state_t>());
  EXPECT_EQ(endpoint.drain(), 1);
  EXPECT_NE(state.get(), nullptr);
}

TEST(LcmEndpointInMemory, DrainEndsInAFlood) {
  LcmEndpoint endpoint("memq://");
  int heard = 0;
  // Every message that is handled brings another one.
  endpoint.subscribe<estop_t>(kEstop, [&](const auto& m) {
    ++heard;
    endpoint.publish(kEstop, m);
  });
  endpoint.publish(kEstop, example<estop_t>());
  EXPECT_EQ(endpoint.drain(), LcmEndpoint::kDrainLimit);
  EXPECT_EQ(heard, LcmEndpoint::kDrainLimit);
}

}  // namespace
}  // namespace fastball::messaging
