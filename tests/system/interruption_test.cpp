// Whatever ends a run: it says so, its log can be read, and no process is left.
#include <gmock/gmock.h>

#include <chrono>
#include <csignal>
#include <thread>

#include "logger/log_reader.h"
#include "messaging/channels.h"
#include "tests/system/fastball_run.h"

namespace fastball::system_test {
namespace {

using testing::HasSubstr;

constexpr std::size_t kPrograms = 6;

void awaitEndOf(const std::map<std::string, int>& children) {
  for (const auto& [program, pid] : children) {
    while (isRunning(pid))
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
}

void expectNoneOf(const std::map<std::string, int>& children) {
  for (const auto& [program, pid] : children)
    EXPECT_FALSE(isRunning(pid)) << program << " is left";
}

TEST(Interruption, CtrlCInMidSwingEndsAllAndLeavesAReadableLog) {
  FastballRun run({"run", "--throws", "100"});
  ASSERT_NO_FATAL_FAILURE(run.awaitSwing());
  const auto children = run.children();
  ASSERT_EQ(children.size(), kPrograms);
  run.signal(SIGINT);
  const Outcome outcome = run.wait();
  EXPECT_EQ(outcome.exit_status, 1);
  EXPECT_THAT(outcome.output, HasSubstr("interrupted"));
  EXPECT_EQ(outcome.json["error"], "interrupted");
  expectNoneOf(children);

  int states = 0;
  int estops = 0;
  const int damaged = logger::readLog(run.logPath(), [&](const logger::LogEntry& entry) {
    states += entry.channel == messaging::kArmState.name;
    estops += entry.channel == messaging::kEstop.name;
  });
  EXPECT_EQ(damaged, 0);
  EXPECT_GT(states, 100);
  EXPECT_EQ(estops, 1);
}

TEST(Interruption, EvenAKilledLauncherLeavesNoProcess) {
  FastballRun run({"run", "--throws", "100"});
  ASSERT_NO_FATAL_FAILURE(run.awaitSwing());
  const auto children = run.children();
  ASSERT_EQ(children.size(), kPrograms);
  run.signal(SIGKILL);
  EXPECT_EQ(run.wait().exit_status, 128 + SIGKILL);
  awaitEndOf(children);
}

}  // namespace
}  // namespace fastball::system_test
