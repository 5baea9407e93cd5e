#pragma once

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <map>
#include <memory>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "tests/config/temporary_folder.h"
#include "tests/kit/hosts.h"
#include "tests/system/fastball_run.h"

namespace fastball::system_test {

/// Host of each process, in the order in which they are started.
using Places = std::vector<std::pair<std::string, std::string>>;

/// As config/systems/three-machines.yaml has them.
inline const Places kUsualPlaces = {{"logger", "operator"},  {"planner", "operator"},
                                    {"controller", "robot"}, {"hand_server", "robot"},
                                    {"sim_bullet", "robot"}, {"vision_tracker", "vision"}};

/// A system on three machines, the launcher and `fastball run` on the operator's.
class ThreeHosts : public testing::Test {
 protected:
  void SetUp() override {
    if (const std::string why = test_kit::Hosts::whyNot(); !why.empty())
      GTEST_SKIP() << why;
    setenv("XDG_RUNTIME_DIR", folder_.path().c_str(), 1);
    hosts_ =
        std::make_unique<test_kit::Hosts>(std::vector<std::string>{"robot", "vision", "operator"});
  }
  void TearDown() override {
    if (hosts_)
      down();
  }

  /// Writes the system file and starts the system.
  Outcome up(const Places& places, const std::string& flags, const std::vector<std::string>& ssh) {
    std::string file = fmt::format("lcm_url: '{}'\nhosts:\n", test_kit::Hosts::lcmUrl());
    for (const char* host : {"robot", "vision"})
      file += fmt::format("  - {{name: {}, folder: {}, ssh: [{}]}}\n", host, FASTBALL_BIN_DIR,
                          fmt::join(ssh, ", "));
    file += "processes:\n";
    for (const auto& [name, host] : places) {
      places_[name] = host;
      std::string program = "fastball-" + name;
      std::replace(program.begin(), program.end(), '_', '-');
      file += fmt::format("  - {{name: {}, host: {}, command: [{}{}]}}\n", name,
                          host == "operator" ? "here" : host, program,
                          name == "logger" ? ", --log, " + log_ : flags);
    }
    file_ = folder_.write("system.yaml", file);
    while (true) {
      Outcome outcome = fastball({"up", file_}, hosts_->enter("operator"));
      // As in wasTooBusy(): a machine that does not run the launcher for three seconds.
      if (outcome.output.find("nothing was heard from the launcher") == std::string::npos)
        return outcome;
    }
  }
  void down() const { fastball({"down", file_}, hosts_->enter("operator")); }
  std::unique_ptr<FastballRun> run(const std::string& throws) const {
    return std::make_unique<FastballRun>(
        std::vector<std::string>{"run", "--system", file_, "--throws", throws},
        hosts_->enter("operator"));
  }
  /// A machine that is so busy that it does not run a process for half a second ends a run as a cut cable does, and rightly so.
  /// Where that is not what is tested, such a run is made again.
  static bool wasTooBusy(const Outcome& outcome) {
    return outcome.output.find("nothing has been heard of") != std::string::npos;
  }
  Outcome throwOnce() const {
    while (true) {
      Outcome outcome = run("1")->wait();
      if (!wasTooBusy(outcome))
        return outcome;
    }
  }
  static void pause() { std::this_thread::sleep_for(std::chrono::milliseconds(5)); }

  config::TemporaryFolder folder_;
  std::string log_ = (folder_.path() / "log").string();
  std::string file_ = (folder_.path() / "system.yaml").string();
  std::unique_ptr<test_kit::Hosts> hosts_;
  std::map<std::string, std::string> places_;  ///< host of each process
};

}  // namespace fastball::system_test
