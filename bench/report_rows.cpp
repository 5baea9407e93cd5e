#include "bench/report_rows.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <boost/process/args.hpp>
#include <boost/process/exe.hpp>
#include <boost/process/io.hpp>
#include <boost/process/system.hpp>
#include <chrono>
#include <filesystem>
#include <stdexcept>

#include "bench/timing.h"
#include "launch/processes.h"

namespace fastball::bench {
namespace {

namespace bp = boost::process;
namespace fs = std::filesystem;

constexpr int kThrows = 10;
constexpr std::size_t kRepetitions = 3;

void fastball(const std::vector<std::string>& arguments) {
  const int status = bp::system(bp::exe = launch::programFolder() + "/fastball",
                                bp::args = arguments, bp::std_out > bp::null);
  if (status != 0)
    throw std::runtime_error(fmt::format("the measured fastball {} ended with exit status {}",
                                         arguments.front(), status));
}

Row tenThrows() {
  const fs::path folder =
      fs::temp_directory_path() / fmt::format("fastball-bench-report-{}", getpid());
  fs::create_directories(folder);
  const std::string log = folder / "run.lcmlog";
  fastball(
      {"run", "--throws", std::to_string(kThrows), "--log", log, "--lcm-url", privateLcmUrl()});
  std::vector<double> walls;
  const double cpu_before = childrenCpu();
  for (std::size_t i = 0; i < kRepetitions; ++i) {
    const auto begun = std::chrono::steady_clock::now();
    fastball({"report", log, "-o", folder / "report"});
    walls.push_back(
        std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count());
  }
  const double cpu = (childrenCpu() - cpu_before) / kRepetitions;
  const double megabytes = 1e-6 * static_cast<double>(fs::file_size(log));
  fs::remove_all(folder);
  std::sort(walls.begin(), walls.end());
  return {
      "report.ten_throws_s",
      walls[kRepetitions / 2],
      "s",
      "its processor time",
      cpu,
      fmt::format("`fastball report` of a log of {} throws, {:.0f} MB, with all pictures; middle "
                  "of {}, {:.2f} to {:.2f}",
                  kThrows, megabytes, kRepetitions, walls.front(), walls.back())};
}

}  // namespace

std::vector<Benchmark> reportBenchmarks() {
  return {{"report.ten_throws_s", tenThrows}};
}

}  // namespace fastball::bench
