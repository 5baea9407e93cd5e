#include <fmt/format.h>
#include <gmock/gmock.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <thread>

#include "tests/config/temporary_folder.h"
#include "tests/system/fastball_run.h"

namespace fastball::system_test {
namespace {

using testing::HasSubstr;

/// A system file of its own, with a launcher's state folder of its own.
class Systems : public testing::Test {
 protected:
  Systems() { setenv("XDG_RUNTIME_DIR", folder_.path().c_str(), 1); }
  ~Systems() override { fastball({"down", file_}); }

  /// `processes`: the file's list of processes.
  void write(const std::string& processes, const std::string& rest = "") {
    const char* url = std::getenv("FASTBALL_LCM_URL");
    folder_.write(
        "system.yaml",
        fmt::format("lcm_url: {}\n{}\nprocesses:\n{}",
                    url != nullptr ? url : "udpm://239.255.76.67:7667?ttl=1", rest, processes));
  }
  Outcome up() const { return fastball({"up", file_}); }
  Outcome down() const { return fastball({"down", file_}); }
  nlohmann::json list() const {
    return nlohmann::json::parse(fastball({"ps", file_, "--json"}).output, nullptr, false);
  }
  nlohmann::json process(const std::string& name) const {
    const nlohmann::json all = list();
    for (const nlohmann::json& process : all.at("processes"))
      if (process.at("name") == name)
        return process;
    return {};
  }
  int pid(const std::string& name) const { return process(name).value("pid", 0); }
  /// Waits for what must come, however slow the machine is.
  static void await(const std::function<bool()>& condition) {
    while (!condition())
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }

  config::TemporaryFolder folder_;
  std::string file_ = (folder_.path() / "system.yaml").string();
};

constexpr const char* kPlanner = "  - {name: planner, command: [fastball-planner]}\n";

TEST_F(Systems, MakeThrowsFromRunToRun) {
  write("  - {name: logger, command: [fastball-logger, --log, " + folder_.path().string() +
        "/system.lcmlog]}\n"
        "  - {name: planner, command: [fastball-planner]}\n"
        "  - {name: controller, command: [fastball-controller]}\n"
        "  - {name: hand_server, command: [fastball-hand-server]}\n"
        "  - {name: sim_bullet, command: [fastball-sim-bullet]}\n"
        "  - {name: vision_tracker, command: [fastball-vision-tracker]}\n");
  ASSERT_EQ(up().exit_status, 0);
  EXPECT_EQ(process("controller").value("state", ""), "ready");
  const Outcome first = fastball({"run", "--system", file_, "--throws", "2"});
  const Outcome second = fastball({"run", "--system", file_, "--throws", "2"});
  ASSERT_EQ(first.exit_status, 0) << first.output;
  ASSERT_EQ(second.exit_status, 0) << second.output;
  for (const int i : {0, 1})
    EXPECT_EQ(first.json["throws"][i]["landing_true_mm"],
              second.json["throws"][i]["landing_true_mm"]);
  const int controller = pid("controller");
  EXPECT_THAT(down().output, HasSubstr("is down"));
  EXPECT_FALSE(isRunning(controller));
  EXPECT_EQ(fastball({"ps", file_}).exit_status, 1);
}

TEST_F(Systems, AreUpOnlyOnce) {
  write(kPlanner);
  ASSERT_EQ(up().exit_status, 0);
  const Outcome again = up();
  EXPECT_EQ(again.exit_status, 1);
  EXPECT_THAT(again.output, HasSubstr("is up already"));
}

TEST_F(Systems, EndWithTheirLauncherHoweverItDies) {
  write(kPlanner);
  ASSERT_EQ(up().exit_status, 0);
  const int planner = pid("planner");
  kill(list().at("launcher").get<int>(), SIGKILL);
  await([&] { return !isRunning(planner); });
  EXPECT_THAT(down().output, HasSubstr("was not up"));
}

TEST_F(Systems, ThatDoNotBecomeReadySayWhyAndAreEnded) {
  write(std::string(kPlanner) +
        "  - {name: robot, command: [sh, -c, 'echo no brakes; exit 3'], ready_timeout: 20}\n");
  const Outcome outcome = up();
  EXPECT_EQ(outcome.exit_status, 1);
  EXPECT_THAT(outcome.output, HasSubstr("robot on here: ended by itself with exit status 3"));
  EXPECT_THAT(outcome.output, HasSubstr("[robot] no brakes"));
  EXPECT_EQ(fastball({"ps", file_}).exit_status, 1);
}

TEST_F(Systems, ARobotThatNeverSaysHeartbeatIsNotWaitedForForever) {
  write("  - {name: robot, command: [sleep, '100'], ready_timeout: 0.5}\n");
  const Outcome outcome = up();
  EXPECT_EQ(outcome.exit_status, 1);
  EXPECT_THAT(outcome.output, HasSubstr("robot on here: did not say HEARTBEAT within 0.5 s"));
}

TEST_F(Systems, StartAgainWhatShallBeAndListWhatShallNot) {
  write(
      "  - {name: planner, command: [fastball-planner], restart: on_failure}\n"
      "  - {name: controller, command: [fastball-controller]}\n");
  ASSERT_EQ(up().exit_status, 0);
  const int planner = pid("planner");
  kill(planner, SIGKILL);
  kill(pid("controller"), SIGKILL);
  await([&] { return pid("planner") != planner && process("planner")["state"] == "ready"; });
  EXPECT_EQ(process("planner")["restarts"], 1);
  await([&] { return process("controller")["state"] == "ended"; });
  EXPECT_THAT(process("controller").value("note", ""), HasSubstr("signal 9"));
}

/// A script in ssh's place, which runs the line on this machine; `cat` is the link.
class OtherMachine : public Systems {
 protected:
  OtherMachine() {
    const std::string ssh =
        folder_.write("ssh", fmt::format("#!/bin/sh\n"
                                         "sh -c 'echo $$ > {0}/link; exec cat' |"
                                         " sh -c \"$2\"\n",
                                         folder_.path().string()));
    std::filesystem::permissions(ssh, std::filesystem::perms::owner_all);
    write("  - {name: planner, host: robot, command: [fastball-planner]}\n",
          fmt::format("hosts: [{{name: robot, folder: {}, ssh: [{}]}}]", FASTBALL_BIN_DIR, ssh));
  }
  /// Process id of the link.
  int link() const {
    int pid = 0;
    std::ifstream(folder_.path() / "link") >> pid;
    return pid;
  }
};

TEST_F(OtherMachine, HoldsItsProcessesOnlyWhileTheLinkIsThere) {
  ASSERT_EQ(up().exit_status, 0);
  const int planner = pid("planner");
  ASSERT_TRUE(isRunning(planner));
  kill(link(), SIGKILL);
  await([&] { return !isRunning(planner); });
  await([&] { return process("planner")["state"] == "ended"; });
}

TEST_F(OtherMachine, NoticesALinkThatIsSilentWithoutEnding) {
  ASSERT_EQ(up().exit_status, 0);
  const int planner = pid("planner");
  kill(link(), SIGSTOP);
  await([&] { return !isRunning(planner); });
  kill(link(), SIGCONT);
}

TEST_F(OtherMachine, LosesItsProcessesOnDown) {
  ASSERT_EQ(up().exit_status, 0);
  const int planner = pid("planner");
  EXPECT_THAT(down().output, HasSubstr("is down"));
  EXPECT_FALSE(isRunning(planner));
}

}  // namespace
}  // namespace fastball::system_test
