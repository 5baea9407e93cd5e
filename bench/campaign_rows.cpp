#include "bench/campaign_rows.h"

#include <fmt/format.h>
#include <unistd.h>

#include <boost/process/args.hpp>
#include <boost/process/exe.hpp>
#include <boost/process/io.hpp>
#include <boost/process/system.hpp>
#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>

#include "bench/timing.h"
#include "launch/processes.h"

namespace fastball::bench {
namespace {

namespace bp = boost::process;
namespace fs = std::filesystem;

constexpr const char* kStrategy = "adaptive";
constexpr int kSetUpThrows = 10;  // as by default
// Of each job: a campaign has thousands, beside which its start is nothing.
constexpr int kThrows = 100;
constexpr int kThrowsWithImages = 10;
constexpr double kMinute = 60;  // [s]

/// A campaign from the start of its command to its end.
struct Measured {
  int throws = 0;
  double wall_s = 0;
  double cpu_s = 0;  ///< of all its processes
  double perMinute() const { return kMinute * throws / wall_s; }
  double cores() const { return cpu_s / wall_s; }
};

Measured campaign(int throws, int jobs, bool images) {
  const fs::path folder =
      fs::temp_directory_path() / fmt::format("fastball-bench-campaign-{}", getpid());
  fs::remove_all(folder);
  std::vector<std::string> arguments = {"campaign",
                                        "--strategy",
                                        kStrategy,
                                        "--throws",
                                        std::to_string(throws),
                                        "--jobs",
                                        std::to_string(jobs),
                                        "--set-up-throws",
                                        std::to_string(kSetUpThrows),
                                        "--folder",
                                        folder};
  if (images)
    arguments.emplace_back("--images");
  const double cpu_before = childrenCpu();
  const auto begun = std::chrono::steady_clock::now();
  const int status = bp::system(bp::exe = launch::programFolder() + "/fastball",
                                bp::args = arguments, bp::std_out > bp::null);
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - begun;
  fs::remove_all(folder);
  if (status != 0)
    throw std::runtime_error(
        fmt::format("the measured campaign ended with exit status {}", status));
  return {throws, wall.count(), childrenCpu() - cpu_before};
}

std::string noteOf(const Measured& measured) {
  return fmt::format("one job, {} throws of strategy {} from start to end, {:.2f} cores busy",
                     measured.throws, kStrategy, measured.cores());
}

}  // namespace

std::vector<Benchmark> campaignBenchmarks() {
  // Measured when the first row asks for it.
  auto alone = std::make_shared<std::optional<Measured>>();
  const auto one_job = [alone]() -> const Measured& {
    if (!*alone) {
      campaign(1, 1, false);  // makes the planner's atlas if there is none yet
      *alone = campaign(kThrows, 1, false);
    }
    return **alone;
  };
  return {{"campaign.throws_per_minute",
           [one_job] {
             return Row{"campaign.throws_per_minute",
                        one_job().perMinute(),
                        "1/min",
                        "none",
                        std::nullopt,
                        noteOf(one_job())};
           }},
          {"campaign.throws_per_minute_vision",
           [one_job] {
             one_job();
             const Measured vision = campaign(kThrowsWithImages, 1, true);
             return Row{"campaign.throws_per_minute_vision",
                        vision.perMinute(),
                        "1/min",
                        "without images",
                        one_job().perMinute(),
                        "with images and tracker, " + noteOf(vision)};
           }},
          {"campaign.two_core_ratio", [one_job] {
             const Measured two = campaign(2 * kThrows, 2, false);
             return Row{
                 "campaign.two_core_ratio",
                 two.perMinute() / one_job().perMinute(),
                 "times",
                 "cores busy, two jobs by one",
                 two.cores() / one_job().cores(),
                 fmt::format("two jobs' {:.0f} throws a minute by one job's {:.0f}; {} throws each",
                             two.perMinute(), one_job().perMinute(), kThrows)};
           }}};
}

}  // namespace fastball::bench
