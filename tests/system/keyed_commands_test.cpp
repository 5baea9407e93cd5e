// Commands with a key, as real processes: who is refused, and that a throw stays what it is.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <thread>
#include <vector>

#include "messaging/command_guard.h"
#include "messaging/heartbeat.h"
#include "messaging/lcm_endpoint.h"
#include "tests/config/temporary_folder.h"
#include "tests/kit/unreliable_relay.h"
#include "tests/messaging/child_process.h"
#include "tests/messaging/examples.h"
#include "tests/system/fastball_run.h"

namespace fastball::system_test {
namespace {

using messaging::ChildProcess;
using messaging::CommandKey;
using messaging::examples::example;
using testing::AllOf;
using testing::HasSubstr;

using Bytes = std::vector<char>;

template <class T>
Bytes encoded() {
  auto message = example<T>();
  Bytes bytes(static_cast<std::size_t>(message.getEncodedSize()));
  message.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
  return bytes;
}

Bytes messageOf(const std::string& channel) {
  if (channel == "PLAN_REQUEST")
    return encoded<plan_request_t>();
  if (channel == "SWING_PLAN")
    return encoded<swing_plan_t>();
  if (channel == "THROW_START")
    return encoded<throw_start_t>();
  if (channel == "SCENE")
    return encoded<scene_t>();
  return channel == "ARM_COMMAND" ? encoded<arm_command_t>() : encoded<hand_command_t>();
}

/// A process of the experiment, its name in HEARTBEAT, and the commands that it hears.
struct Consumer {
  std::string program, name;
  std::vector<std::string> channels;
};

class KeyedProcess : public testing::TestWithParam<Consumer> {
 protected:
  KeyedProcess() {
    endpoint_.subscribe<heartbeat_t>(messaging::kHeartbeat, [this](const heartbeat_t& m) {
      if (m.name == GetParam().name)
        heartbeat_ = m;
    });
  }
  template <class Done>
  bool waitFor(Done done) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
    while (!done() && std::chrono::steady_clock::now() < end) {
      if (endpoint_.drain() == 0)
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return done();
  }
  void say(const std::string& channel, const Bytes& bytes) {
    ASSERT_TRUE(endpoint_.publishBytes(channel, bytes.data(), bytes.size()));
  }
  static Bytes signedWith(const CommandKey& key, const std::string& channel) {
    Bytes bytes = messageOf(channel);
    const std::size_t size = bytes.size();
    bytes.resize(size + messaging::kTrailerBytes);
    messaging::CommandSigner(std::make_shared<const CommandKey>(key), "a friend")
        .sign(channel, bytes.data(), size, messaging::SystemClock().wallUs());
    return bytes;
  }

  config::TemporaryFolder folder_;
  const std::string key_path_ = (folder_.path() / "a.key").string();
  const CommandKey key_ = CommandKey::make(key_path_);
  const CommandKey other_key_ = CommandKey::make((folder_.path() / "b.key").string());
  messaging::LcmEndpoint endpoint_{messaging::defaultLcmUrl()};
  ChildProcess process_{{FASTBALL_BIN_DIR "/" + GetParam().program, "--key", key_path_}};
  heartbeat_t heartbeat_{};
};

TEST_P(KeyedProcess, RefusesBareForgedChangedAndReplayedCommandsAndTakesOneOfAFriend) {
  ASSERT_TRUE(waitFor([this] { return heartbeat_.state == "idle"; })) << process_.output();
  EXPECT_EQ(messaging::keyIdOf(heartbeat_), key_.id());
  int64_t refused = 0;
  for (const std::string& channel : GetParam().channels) {
    say(channel, messageOf(channel));
    ASSERT_TRUE(waitFor([&] {
      return heartbeat_.detail.find("refused 1 " + channel + "; the first has no tag") !=
             std::string::npos;
    })) << heartbeat_.detail;
    say(channel, signedWith(other_key_, channel));
    Bytes changed = signedWith(key_, channel);
    changed[10] ^= 1;
    say(channel, changed);
    const Bytes elsewhere = signedWith(key_, channel == "SCENE" ? "ARM_COMMAND" : "SCENE");
    say(channel, elsewhere);
    refused += 4;
    ASSERT_TRUE(waitFor([&] { return heartbeat_.invalid == refused; })) << heartbeat_.invalid;
  }
  EXPECT_EQ(heartbeat_.received, 0);
  EXPECT_EQ(heartbeat_.state, "idle");
  EXPECT_EQ(heartbeat_.plan_id, 0);

  const std::string& channel = GetParam().channels.front();
  const Bytes good = signedWith(key_, channel);
  say(channel, good);
  ASSERT_TRUE(waitFor([&] { return heartbeat_.received == 1; })) << heartbeat_.detail;
  say(channel, good);
  ASSERT_TRUE(waitFor([&] { return heartbeat_.invalid == refused + 1; })) << heartbeat_.detail;
  EXPECT_EQ(heartbeat_.received, 1);
  EXPECT_EQ(process_.stop(SIGTERM), 0);
  EXPECT_THAT(process_.output(), HasSubstr("refused 1 " + channel));
}

INSTANTIATE_TEST_SUITE_P(
    Of,
    KeyedProcess,
    testing::Values(
        Consumer{"fastball-planner", "planner", {"PLAN_REQUEST"}},
        Consumer{"fastball-controller", "controller", {"THROW_START", "SWING_PLAN"}},
        Consumer{"fastball-hand-server", "hand_server", {"THROW_START", "SWING_PLAN"}},
        Consumer{"fastball-sim-bullet", "sim_bullet", {"ARM_COMMAND", "HAND_COMMAND", "SCENE"}},
        Consumer{"fastball-vision-tracker", "vision_tracker", {"PLAN_REQUEST"}}),
    [](const auto& consumer) { return consumer.param.name; });

/// Keys, and a system of all processes.
class KeyedRun : public testing::Test {
 protected:
  KeyedRun() {
    setenv("XDG_RUNTIME_DIR", folder_.path().c_str(), 1);
    CommandKey::make(key_);
    CommandKey::make(other_key_);
  }
  ~KeyedRun() override {
    if (!file_.empty())
      fastball({"down", file_});
  }
  /// Starts a system in which `odd` gets other flags than --key; controller and hand server are on the network `far`.
  void up(const std::string& far, const std::string& odd = "", const std::string& flags = "") {
    std::string text = fmt::format("lcm_url: '{}'\nprocesses:\n", near_);
    for (const std::string name :
         {"logger", "planner", "controller", "hand_server", "sim_bullet", "vision_tracker"}) {
      std::string program = name;
      std::replace(program.begin(), program.end(), '_', '-');
      const std::string words = name == "logger" ? ", --log, " + log_
                                : name == odd    ? flags
                                                 : ", --key, " + key_;
      const bool is_far = name == "controller" || name == "hand_server";
      text += fmt::format(
          "  - {{name: {}, command: [fastball-{}{}], environment: ['FASTBALL_LCM_URL={}']}}\n",
          name, program, words, is_far ? far : near_);
    }
    file_ = folder_.write("system.yaml", text);
    const Outcome outcome = fastball({"up", file_});
    ASSERT_EQ(outcome.exit_status, 0) << outcome.output;
  }
  std::string path(const std::string& name) const { return (folder_.path() / name).string(); }

  config::TemporaryFolder folder_;
  const std::string key_ = path("a.key"), other_key_ = path("b.key"), log_ = path("run.lcmlog");
  const std::string near_ = fmt::format("udpm://239.255.76.67:{}?ttl=0", 20000 + getpid() % 20000);
  std::string file_;
};

TEST_F(KeyedRun, ThrowsTheSameBitForBitAndItsLogServesAsAnyOther) {
  const nlohmann::json bare = fastball({"run", "--no-network", "--throws", "1"}).json;
  const Outcome keyed =
      fastball({"run", "--throws", "1", "--key", key_, "--log", log_, "--lcm-url", near_});
  ASSERT_EQ(keyed.exit_status, 0) << keyed.output;
  const nlohmann::json thrown = keyed.json.at("throws").at(0);
  EXPECT_TRUE(thrown.at("hit").get<bool>());
  EXPECT_EQ(thrown.at("landing_true_mm"), bare.at("throws").at(0).at("landing_true_mm"));
  EXPECT_EQ(thrown.at("release_speed_mps"), bare.at("throws").at(0).at("release_speed_mps"));
  const Outcome check = fastball({"log", "check", log_});
  EXPECT_EQ(check.exit_status, 0) << check.output;
  const Outcome rerun = fastball({"replay", log_, "--rerun", "controller"});
  EXPECT_EQ(rerun.exit_status, 0) << rerun.output;

  // The planner takes its request out of the log only from one who has the key.
  messaging::LcmEndpoint endpoint(near_);
  heartbeat_t planner{};
  int plans = 0;
  endpoint.subscribe<heartbeat_t>(messaging::kHeartbeat, [&](const auto& m) { planner = m; });
  endpoint.subscribeRaw("SWING_PLAN", [&](const auto&...) { ++plans; });
  ChildProcess process({FASTBALL_BIN_DIR "/fastball-planner", "--key", key_, "--lcm-url", near_});
  const auto listenUntil = [&](const auto& done) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
    while (!done() && std::chrono::steady_clock::now() < end) {
      endpoint.drain();
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return done();
  };
  ASSERT_TRUE(listenUntil([&] { return planner.name == "planner"; }));
  const std::vector<std::string> replay = {"replay",       log_,        "--channel",
                                           "PLAN_REQUEST", "--lcm-url", near_};
  // What a replay without the key says is neither new nor of now.
  EXPECT_EQ(fastball(replay).exit_status, 0);
  ASSERT_TRUE(listenUntil([&] { return planner.invalid == 1; })) << planner.detail;
  auto with_key = replay;
  with_key.insert(with_key.end(), {"--key", key_});
  EXPECT_EQ(fastball(with_key).exit_status, 0);
  EXPECT_TRUE(listenUntil([&] { return plans == 1; })) << planner.detail;
}

TEST_F(KeyedRun, AProcessWithAnotherKeyEndsTheRunAtOnceAndIsNamed) {
  up(near_, "controller", ", --key, " + other_key_);
  const Outcome outcome = fastball({"run", "--system", file_, "--throws", "1", "--key", key_});
  EXPECT_EQ(outcome.exit_status, 1);
  EXPECT_THAT(outcome.output, AllOf(HasSubstr("controller (process "),
                                    HasSubstr("has key " + CommandKey::read(other_key_).id() +
                                              ", this run has key " + CommandKey::read(key_).id()),
                                    HasSubstr("give all processes the same --key")));
}

TEST_F(KeyedRun, AProcessOrARunWithoutItEndsTheRunAtOnceAndIsNamed) {
  up(near_, "sim_bullet", "");
  EXPECT_THAT(fastball({"run", "--system", file_, "--throws", "1", "--key", key_}).output,
              AllOf(HasSubstr("sim_bullet (process "), HasSubstr("has no key, this run has key ")));
  EXPECT_THAT(fastball({"run", "--system", file_, "--throws", "1"}).output,
              HasSubstr(", this run has no key: give all processes the same --key"));
}

TEST_F(KeyedRun, ABadNetworkDoesNotChangeTheThrow) {
  const nlohmann::json clean = fastball({"run", "--no-network", "--throws", "1"}).json;
  const std::string far = fmt::format("udpm://239.255.76.67:{}?ttl=0", 40000 + getpid() % 20000);
  test_kit::Mischief mischief;
  mischief.lost = 0.01;
  mischief.duplicated = 0.02;
  mischief.reordered = 0.05;
  const test_kit::UnreliableRelay relay(near_, far, mischief);
  messaging::LcmEndpoint endpoint(near_);
  int64_t refused = 0;
  endpoint.subscribe<heartbeat_t>(messaging::kHeartbeat, [&](const auto& m) {
    if (m.name == "sim_bullet")
      refused = m.invalid;
  });
  up(far);
  const Outcome outcome = fastball({"run", "--system", file_, "--throws", "1", "--key", key_});
  ASSERT_EQ(outcome.exit_status, 0) << outcome.output;
  EXPECT_EQ(outcome.json.at("throws").at(0).at("landing_true_mm"),
            clean.at("throws").at(0).at("landing_true_mm"));
  endpoint.drain();
  EXPECT_GT(refused, 50) << "doubled commands are refused and counted";
}

TEST_F(KeyedRun, AKeyThatOthersCanReadIsRefusedBeforeAnythingStarts) {
  std::filesystem::permissions(key_, std::filesystem::perms(0644));
  const Outcome outcome = fastball({"run", "--throws", "1", "--key", key_});
  EXPECT_EQ(outcome.exit_status, 2);
  EXPECT_THAT(outcome.output, AllOf(HasSubstr(key_), HasSubstr("chmod 600")));
  ChildProcess process({FASTBALL_BIN_DIR "/fastball-controller", "--key", key_});
  EXPECT_EQ(process.wait(), 2);
  EXPECT_THAT(process.output(), HasSubstr("chmod 600"));
}

TEST_F(KeyedRun, TheCommandMakesAKeyAndNeverOverwritesOne) {
  const std::string file = path("new.key");
  const Outcome made = fastball({"key", file});
  EXPECT_EQ(made.exit_status, 0);
  EXPECT_THAT(made.output, HasSubstr("key " + CommandKey::read(file).id()));
  const Outcome again = fastball({"key", file});
  EXPECT_EQ(again.exit_status, 2);
  EXPECT_THAT(again.output, HasSubstr("is there already"));
}

}  // namespace
}  // namespace fastball::system_test
