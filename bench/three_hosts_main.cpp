// Measures `fastball up` for the experiment on three hosts, in namespaces of this machine: {"seconds": [...], "ssh": "..."}.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/kit/hosts.h"
#include "tests/kit/ssh_servers.h"

namespace fastball::bench {
namespace {

namespace fs = std::filesystem;

constexpr int kTimes = 3;

std::string systemText(const fs::path& programs,
                       const std::string& log,
                       const std::vector<std::string>& ssh) {
  std::string text = fmt::format("lcm_url: '{}'\nhosts:\n", test_kit::Hosts::lcmUrl());
  for (const char* host : {"robot", "vision"})
    text += fmt::format("  - {{name: {}, folder: {}, ssh: [{}]}}\n", host, programs.string(),
                        fmt::join(ssh, ", "));
  text += fmt::format(
      "processes:\n"
      "  - {{name: logger, command: [fastball-logger, --log, {}]}}\n"
      "  - {{name: planner, command: [fastball-planner]}}\n"
      "  - {{name: controller, host: robot, command: [fastball-controller]}}\n"
      "  - {{name: hand_server, host: robot, command: [fastball-hand-server]}}\n"
      "  - {{name: sim_bullet, host: robot, command: [fastball-sim-bullet]}}\n"
      "  - {{name: vision_tracker, host: vision, command: [fastball-vision-tracker]}}\n",
      log);
  return text;
}

nlohmann::json measure(const fs::path& folder) {
  const fs::path programs = fs::read_symlink("/proc/self/exe").parent_path();
  test_kit::Hosts hosts({"robot", "vision", "operator"});
  std::unique_ptr<test_kit::SshServers> servers;
  const bool has_ssh = test_kit::SshServers::whyNot().empty();
  if (has_ssh)
    servers =
        std::make_unique<test_kit::SshServers>(hosts, std::vector<std::string>{"robot", "vision"});
  const std::string file = (folder / "system.yaml").string();
  std::ofstream(file) << systemText(
      programs, (folder / "log").string(),
      has_ssh ? servers->client() : std::vector<std::string>{hosts.sshStandIn()});
  setenv("XDG_RUNTIME_DIR", folder.c_str(), 1);
  const auto fastball = [&](const std::string& what) {
    return hosts.run(
        "operator",
        {"sh", "-c", fmt::format("exec {}/fastball {} {} >&2", programs.string(), what, file)});
  };
  nlohmann::json seconds = nlohmann::json::array();
  for (int i = 0; i < kTimes; ++i) {
    const auto start = std::chrono::steady_clock::now();
    if (fastball("up") != 0)
      throw std::runtime_error("fastball up failed");
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
    seconds.push_back(taken.count());
    fastball("down");
  }
  return {
      {"seconds", seconds},
      {"ssh", has_ssh ? "OpenSSH with an sshd on each" : "a stand-in for ssh without a network"}};
}

}  // namespace
}  // namespace fastball::bench

int main() {
  namespace fs = std::filesystem;
  const fs::path folder =
      fs::temp_directory_path() / fmt::format("fastball-hosts-bench-{}", getpid());
  int status = 0;
  try {
    fs::create_directories(folder);
    fmt::print("{}\n", fastball::bench::measure(folder).dump());
  } catch (const std::exception& e) {
    fmt::print(stderr, "fastball-three-hosts: {}\n", e.what());
    status = 1;
  }
  std::error_code ignored;
  fs::remove_all(folder, ignored);
  return status;
}
