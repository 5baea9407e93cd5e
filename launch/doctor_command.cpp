#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <memory>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "launch/commands.h"
#include "launch/doctor/machine_checks.h"
#include "launch/doctor/network_checks.h"
#include "launch/results.h"
#include "messaging/lcm_endpoint.h"
#include "messaging/process.h"

namespace fastball::launch {
namespace {

constexpr std::array<const char*, 3> kWords = {"good", "remark", "bad"};

const char* word(const Finding& finding) {
  return kWords[static_cast<std::size_t>(finding.verdict)];
}

void print(const Findings& findings) {
  for (const Finding& finding : findings) {
    fmt::print("{:<7} {:<24} {}\n", word(finding), finding.what, finding.value);
    if (!finding.mend.empty())
      fmt::print("{:<32} mend: {}\n", "", finding.mend);
  }
}

nlohmann::json toJson(const Findings& findings) {
  nlohmann::json list = nlohmann::json::array();
  for (const Finding& finding : findings)
    list.push_back({{"what", finding.what},
                    {"verdict", word(finding)},
                    {"value", finding.value},
                    {"mend", finding.mend}});
  return {{"findings", list}};
}

/// The checks in the order in which one builds on another: without a route none of the network's can be made.
Findings examine(const std::string& lcm_url) {
  Findings all;
  const auto add = [&all](const Findings& some) {
    all.insert(all.end(), some.begin(), some.end());
  };
  add(checkLibraries());
  add(checkRoute(lcm_url));
  const bool routed = std::none_of(all.begin(), all.end(), [](const Finding& finding) {
    return finding.what == "route" && finding.verdict == Verdict::kBad;
  });
  if (routed) {
    for (const auto check : {checkRoundTrip, checkReceiveBuffer, checkOthers}) {
      try {
        add(check(lcm_url));
      } catch (const std::runtime_error& e) {
        add({{"network", Verdict::kBad, e.what(), ""}});
      }
    }
  }
  add(checkRealTime());
  add(checkDisk());
  return all;
}

}  // namespace

void addDoctorCommand(CLI::App& app, int& exit_status) {
  struct Options {
    std::string lcm_url = messaging::defaultLcmUrl();
    std::string json;
  };
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand(
      "doctor",
      "Check this machine and its network; says how to mend each fault (exit status 1: "
      "the experiment would suffer)");
  command->add_option("--lcm-url", options->lcm_url, "LCM network")->capture_default_str();
  command->add_option("--json", options->json, "File for the findings as one JSON object");
  command->callback([options, &exit_status] {
    const Findings findings = examine(options->lcm_url);
    print(findings);
    if (!options->json.empty())
      writeJson(toJson(findings), options->json);
    const bool bad = std::any_of(findings.begin(), findings.end(), [](const Finding& finding) {
      return finding.verdict == Verdict::kBad;
    });
    exit_status = bad ? messaging::kExitFailed : messaging::kExitDone;
  });
}

}  // namespace fastball::launch
