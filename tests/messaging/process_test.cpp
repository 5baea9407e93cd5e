// A real process, started, talked to, stopped and broken.
#include "messaging/process.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "messaging/version.h"
#include "tests/messaging/child_process.h"
#include "tests/messaging/examples.h"
#include "tests/messaging/scripted_node.h"

namespace fastball::messaging {
namespace {

using Seconds = std::chrono::duration<double>;
using SteadyClock = std::chrono::steady_clock;
using ::testing::HasSubstr;
using ::testing::Not;

const std::string kEcho = FASTBALL_BIN_DIR "/messaging_test_echo";

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

TEST(Process, HelpAndVersionAreAnswered) {
  ChildProcess help({kEcho, "--help"});
  EXPECT_EQ(help.wait(), kExitDone);
  for (const char* flag :
       {"--lcm-url", "--config", "--realtime", "--verbose", "--duration", "--version", "--fail"}) {
    EXPECT_THAT(help.output(), HasSubstr(flag));
  }
  ChildProcess version_flag({kEcho, "--version"});
  EXPECT_EQ(version_flag.wait(), kExitDone);
  EXPECT_EQ(version_flag.output(), std::string(version()) + "\n");
}

TEST(Process, WrongUsageIsStatusTwo) {
  for (const auto& flags : std::vector<std::vector<std::string>>{{"--no-such-flag"},
                                                                 {"--duration", "-1"},
                                                                 {"--config", "/no/such/file"},
                                                                 {"--lcm-url", "udpm://10.0.0.1"},
                                                                 {"--fail", "usage"}}) {
    std::vector<std::string> command = {kEcho};
    command.insert(command.end(), flags.begin(), flags.end());
    ChildProcess process(command);
    EXPECT_EQ(process.wait(), kExitUsage) << flags[0];
    EXPECT_THAT(process.output(), Not(HasSubstr("shut down")));
  }
}

TEST(Process, StartsWithOneLineOfNameVersionAndUrl) {
  ChildProcess process({kEcho, "--duration", "0.01"});
  EXPECT_EQ(process.wait(), kExitDone);
  EXPECT_EQ(process.output(), std::string("echo ") + version() + " on " + defaultLcmUrl() +
                                  "&recv_buf_size=4194304\nshut down\n");
}

TEST(Process, AnswersUntilASignalThenShutsDownAndSaysALastHeartbeat) {
  for (const int signal : {SIGTERM, SIGINT}) {
    LcmEndpoint endpoint(defaultLcmUrl());
    ChildProcess process({kEcho});
    Latest<arm_command_t> answer(endpoint, kArmCommand);
    int heartbeats = 0;
    endpoint.subscribe<heartbeat_t>(kHeartbeat, [&](const heartbeat_t& m) {
      if (m.pid == process.pid())
        ++heartbeats;
    });
    ASSERT_TRUE(drainUntil(endpoint, [&] { return heartbeats >= 1; })) << process.output();
    endpoint.publish(kArmState, examples::example<arm_state_t>());
    EXPECT_TRUE(drainUntil(endpoint, [&] { return answer.get() != nullptr; }));
    const int heartbeats_before = heartbeats;
    const auto start = SteadyClock::now();
    EXPECT_EQ(process.stop(signal), kExitDone);
    EXPECT_LT(Seconds(SteadyClock::now() - start).count(), 1.0);
    EXPECT_THAT(process.output(), HasSubstr("shut down"));
    EXPECT_TRUE(drainUntil(endpoint, [&] { return heartbeats > heartbeats_before; }));
  }
}

TEST(Process, SignalWhileItIsBeingBuiltIsNotLost) {
  ChildProcess process({kEcho, "--fail", "slow start"});
  ASSERT_TRUE(process.waitForOutput(" on "));
  EXPECT_EQ(process.stop(SIGTERM), kExitDone);
  EXPECT_THAT(process.output(), HasSubstr("shut down"));
}

TEST(Process, FailureIsOneSentenceAndStatusOne) {
  LcmEndpoint endpoint(defaultLcmUrl());
  std::string detail;
  endpoint.subscribe<heartbeat_t>(kHeartbeat, [&](const auto& m) {
    if (m.state == "failed")
      detail = m.detail;
  });
  ChildProcess thrower({kEcho, "--fail", "throw"});
  EXPECT_EQ(thrower.wait(), kExitFailed);
  EXPECT_THAT(thrower.output(), HasSubstr("echo: the step failed\n"));
  EXPECT_THAT(thrower.output(), HasSubstr("shut down\n"));
  EXPECT_TRUE(drainUntil(endpoint, [&] { return detail == "the step failed"; }));

  ChildProcess failer({kEcho, "--fail", "state"});
  EXPECT_EQ(failer.wait(), kExitFailed);
  EXPECT_THAT(failer.output(), HasSubstr("the arm is gone"));
  EXPECT_TRUE(drainUntil(endpoint, [&] { return detail == "the arm is gone"; }));
}

TEST(Process, MissingRouteIsNamedWithAMendThatMends) {
  if (ChildProcess({"unshare", "-n", "true"}).wait() != 0)
    GTEST_SKIP() << "no private network namespace to be had here";
  for (const auto& [url, mend] : {
           std::pair{"udpm://239.255.76.67:7667?ttl=0", "ip route add 239.255.76.67/32 dev lo"},
           std::pair{"udpm://239.1.2.3:7700?ttl=0", "ip route add 239.1.2.3/32 dev lo"},
       }) {
    const auto start = SteadyClock::now();
    ChildProcess process({"unshare", "-n", kEcho, "--lcm-url", url});
    EXPECT_EQ(process.wait(), kExitFailed);
    // LCM alone needs 10 s; the rest is for a busy machine.
    EXPECT_LT(Seconds(SteadyClock::now() - start).count(), 5.0);
    const std::string& said = process.output();
    EXPECT_THAT(said, HasSubstr(url));
    EXPECT_THAT(said, HasSubstr(mend));
    const std::string command =
        said.substr(said.find('`') + 1, said.rfind('`') - said.find('`') - 1);
    ChildProcess mended(
        {"unshare", "-n", "sh", "-c",
         fmt::format("{} && exec {} --duration 0.01 --lcm-url '{}'", command, kEcho, url)});
    EXPECT_EQ(mended.wait(), kExitDone) << mended.output();
  }
}

TEST(RunOverLcm, StepsAtTheWakeTimeWithoutMessages) {
  LcmEndpoint endpoint(defaultLcmUrl());
  const SystemClock clock;
  ScriptedNode node;
  const int64_t start_us = clock.monotonicUs();
  std::vector<int64_t> early_us;
  node.on_step = [&] {
    if (node.steps > 1)
      early_us.push_back(node.wake_us - clock.monotonicUs());
    node.wake_us = start_us + int64_t{20'000} * node.steps;
    node.is_finished = node.steps == 5;
  };
  EXPECT_EQ(runOverLcm(node, endpoint, clock), kExitDone);
  EXPECT_EQ(node.shut_downs, 1);
  EXPECT_THAT(early_us, ::testing::Each(::testing::Le(0)));
  EXPECT_EQ(node.steps, 5);
}

}  // namespace
}  // namespace fastball::messaging
