#include "bench/timing.h"

#include <sys/resource.h>

#include <benchmark/benchmark.h>
#include <fmt/format.h>
#include <unistd.h>

#include <stdexcept>
#include <vector>

namespace fastball::bench {
namespace {

constexpr int kFirstPort = 20000;
constexpr int kPorts = 20000;

class Collector : public benchmark::BenchmarkReporter {
 public:
  bool ReportContext(const Context& /*context*/) override { return true; }
  void ReportRuns(const std::vector<Run>& runs) override {
    for (const Run& run : runs) {
      wall_seconds = run.real_accumulated_time / static_cast<double>(run.iterations);
      cpu_seconds = run.cpu_accumulated_time / static_cast<double>(run.iterations);
    }
  }
  double wall_seconds = -1, cpu_seconds = -1;
};

Collector measured(const std::string& id, const std::function<void()>& call) {
  benchmark::ClearRegisteredBenchmarks();
  benchmark::RegisterBenchmark(id.c_str(), [&call](benchmark::State& state) {
    for (auto _ : state)
      call();
  });
  Collector collector;
  benchmark::RunSpecifiedBenchmarks(&collector);
  benchmark::ClearRegisteredBenchmarks();
  if (collector.wall_seconds < 0)
    throw std::runtime_error(fmt::format("{} could not be measured", id));
  return collector;
}

}  // namespace

double secondsPerCall(const std::string& id, const std::function<void()>& call) {
  return measured(id, call).wall_seconds;
}

double cpuSecondsPerCall(const std::string& id, const std::function<void()>& call) {
  return measured(id, call).cpu_seconds;
}

std::string privateLcmUrl() {
  return fmt::format("udpm://239.255.76.67:{}?ttl=0", kFirstPort + getpid() % kPorts);
}

double childrenCpu() {
  rusage usage{};
  getrusage(RUSAGE_CHILDREN, &usage);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

}  // namespace fastball::bench
