#include "launch/processes.h"

#include <gmock/gmock.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <stdexcept>
#include <thread>

namespace fastball::launch {
namespace {

using testing::HasSubstr;

/// A shell as the process called `name`.
ProcessCommand shell(const std::string& name, const std::string& script) {
  return {name, "/bin/sh", {"-c", script}};
}

bool alive(int pid) {
  return kill(pid, 0) == 0;
}

/// Waits for what must come, however slow the machine is.
template <class Predicate>
void await(Predicate predicate) {
  while (!predicate())
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
}

TEST(Processes, ThatRunSayNothing) {
  Processes processes;
  processes.start(shell("sleeper", "sleep 100"));
  EXPECT_FALSE(processes.ended());
  EXPECT_TRUE(alive(processes.pid("sleeper")));
  EXPECT_EQ(processes.pid("nobody"), 0);
}

TEST(Processes, OneThatEndsIsNamedWithItsStatusAndLastWords) {
  Processes processes;
  processes.start(shell("planner", "echo all is well; echo no route >&2; exit 3"));
  std::optional<std::string> sentence;
  await([&] { return (sentence = processes.ended()).has_value(); });
  EXPECT_THAT(*sentence, HasSubstr("planner ended by itself with exit status 3"));
  EXPECT_THAT(*sentence, HasSubstr("[planner] all is well\n[planner] no route"));
}

TEST(Processes, OneThatIsKilledIsNamedWithTheSignal) {
  Processes processes;
  processes.start(shell("controller", "sleep 100"));
  kill(processes.pid("controller"), SIGKILL);
  std::optional<std::string> sentence;
  await([&] { return (sentence = processes.ended()).has_value(); });
  EXPECT_THAT(*sentence, HasSubstr("controller was ended by signal 9 (Killed)"));
}

TEST(Processes, ExitStatusTellsHowOneEnded) {
  Processes processes;
  processes.start(shell("planner", "exit 3"));
  processes.start(shell("controller", "sleep 100"));
  await([&] { return processes.exitStatus("planner") >= 0; });
  EXPECT_EQ(processes.exitStatus("planner"), 3);
  EXPECT_EQ(processes.exitStatus("controller"), -1);
  kill(processes.pid("controller"), SIGKILL);
  await([&] { return processes.exitStatus("controller") >= 0; });
  EXPECT_EQ(processes.exitStatus("controller"), 128 + SIGKILL);
  EXPECT_EQ(processes.exitStatus("nobody"), -1);
}

TEST(Processes, KeepsOnlyTheLastLines) {
  Processes processes;
  processes.start(shell("talker", "for i in $(seq 1000); do echo line $i; done"));
  await([&] { return processes.ended().has_value(); });
  EXPECT_EQ(processes.lastOutput("talker"),
            "[talker] line 996\n[talker] line 997\n[talker] line 998\n[talker] line 999\n[talker] "
            "line 1000");
}

TEST(Processes, StopEndsTheLastOneLast) {
  Processes processes;
  const std::string patient =
      "trap 'sleep 0.2; exit 0' INT; echo ready; while :; do sleep 0.01; done";
  processes.start(shell("logger", "trap 'exit 0' INT; echo ready; while :; do sleep 0.01; done"));
  processes.start(shell("controller", patient));
  await([&] { return processes.lastOutput("controller") == "[controller] ready"; });
  await([&] { return processes.lastOutput("logger") == "[logger] ready"; });
  const int logger = processes.pid("logger");
  const int controller = processes.pid("controller");
  std::thread watch([&] {
    while (alive(controller)) {
      EXPECT_TRUE(alive(logger));
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  });
  EXPECT_TRUE(processes.stop(60, "logger").empty());
  watch.join();
  EXPECT_FALSE(alive(logger));
}

TEST(Processes, StopKillsWhoDoesNotListen) {
  Processes processes;
  processes.start(shell("deaf", "trap '' INT TERM; echo ready; while :; do sleep 0.01; done"));
  await([&] { return processes.lastOutput("deaf") == "[deaf] ready"; });
  const int pid = processes.pid("deaf");
  EXPECT_EQ(processes.stop(0.05), std::vector<std::string>{"deaf"});
  EXPECT_FALSE(alive(pid));
}

TEST(Processes, NoneIsLeftWhenAnExceptionFlies) {
  int pid = 0;
  try {
    Processes processes;
    processes.start(shell("deaf", "trap '' INT TERM; while :; do sleep 0.01; done"));
    pid = processes.pid("deaf");
    throw std::runtime_error("something else went wrong");
  } catch (const std::runtime_error&) {
  }
  ASSERT_NE(pid, 0);
  EXPECT_FALSE(alive(pid));
  EXPECT_EQ(errno, ESRCH);
}

TEST(Processes, AProgramThatIsNotThereIsNamed) {
  Processes processes;
  try {
    processes.start({"planner", "/nonexistent/fastball-planner", {}});
    FAIL() << "started a program that does not exist";
  } catch (const std::runtime_error& e) {
    EXPECT_THAT(e.what(), HasSubstr("cannot start planner: /nonexistent/fastball-planner"));
  }
}

}  // namespace
}  // namespace fastball::launch
