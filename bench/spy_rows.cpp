#include "bench/spy_rows.h"

#include <fmt/format.h>
#include <signal.h>
#include <time.h>

#include <atomic>
#include <boost/process/args.hpp>
#include <boost/process/child.hpp>
#include <boost/process/exe.hpp>
#include <boost/process/io.hpp>
#include <boost/process/pipe.hpp>
#include <chrono>
#include <filesystem>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "bench/timing.h"
#include "launch/processes.h"
#include "lcmtypes/fastball_types.h"
#include "messaging/lcm_endpoint.h"

namespace fastball::bench {
namespace {

namespace bp = boost::process;
using Steady = std::chrono::steady_clock;
using namespace std::chrono_literals;

constexpr int kChannels = 10;
constexpr int kTicks = 5000;
constexpr auto kTick = 1ms;
constexpr auto kStartTimeout = 10s;
/// For what is still on its way when all is said.
constexpr auto kGrace = 200ms;

struct Watched {
  int64_t sent = 0;
  int64_t counted = 0;
  double seconds = 0;      ///< that the sending took
  double cpu_seconds = 0;  ///< of the spy meanwhile
};

/// `fastball spy --json` while it runs. What it prints is read all the time, for it waits when a pipe is full.
class RunningSpy {
 public:
  explicit RunningSpy(const std::string& url)
      : child_(bp::exe = program(),
               bp::args = {"spy", "--json", "--lcm-url", url},
               bp::std_out > output_),
        reader_([this] { read(); }) {}
  ~RunningSpy() { end(); }
  RunningSpy(const RunningSpy&) = delete;
  RunningSpy& operator=(const RunningSpy&) = delete;

  void awaitStart(messaging::LcmEndpoint& endpoint) {
    for (const auto start = Steady::now(); !hears_;) {
      if (Steady::now() - start > kStartTimeout)
        throw std::runtime_error("fastball spy hears nothing");
      endpoint.publishBytes("START", "start", 5);
      std::this_thread::sleep_for(20ms);
    }
  }

  /// [s] of processor time that it has taken so far.
  double cpuSeconds() const {
    clockid_t clock{};
    timespec time{};
    if (clock_getcpuclockid(child_.id(), &clock) != 0 || clock_gettime(clock, &time) != 0)
      throw std::runtime_error("the processor time of fastball spy cannot be read");
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
  }

  /// Ends it. @return how many messages it has counted on the channels of the benchmark.
  int64_t end() {
    if (reader_.joinable()) {
      kill(child_.id(), SIGINT);
      reader_.join();
      child_.wait();
    }
    counts_.erase("START");
    int64_t sum = 0;
    for (const auto& [channel, count] : counts_)
      sum += count;
    return sum;
  }

 private:
  static std::string program() { return launch::programFolder() + "/fastball"; }
  void read() {
    for (std::string line; std::getline(output_, line);) {
      const auto object = nlohmann::json::parse(line, nullptr, false);
      if (object.is_object())
        counts_[object.at("channel")] = object.at("count");
      hears_ = true;
    }
  }

  bp::ipstream output_;
  bp::child child_;
  std::map<std::string, int64_t> counts_;  // the reader's until it has ended
  std::atomic<bool> hears_{false};
  std::thread reader_;
};

/// States of many arms, a thousand times a second.
int64_t sayStates(messaging::LcmEndpoint& endpoint) {
  arm_state_t state{};
  std::vector<char> bytes(static_cast<std::size_t>(state.getEncodedSize()));
  int64_t sent = 0;
  const auto start = Steady::now();
  for (int tick = 0; tick < kTicks; ++tick) {
    std::this_thread::sleep_until(start + tick * kTick);
    state.seq = tick;
    state.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
    for (int channel = 0; channel < kChannels; ++channel)
      sent += endpoint.publishBytes(fmt::format("STATE_{}", channel), bytes.data(), bytes.size());
  }
  return sent;
}

Watched watch() {
  const std::string url = privateLcmUrl();
  messaging::LcmEndpoint endpoint(url);
  RunningSpy spy(url);
  spy.awaitStart(endpoint);
  Watched watched;
  const double cpu = spy.cpuSeconds();
  const auto start = Steady::now();
  watched.sent = sayStates(endpoint);
  watched.seconds = std::chrono::duration<double>(Steady::now() - start).count();
  std::this_thread::sleep_for(kGrace);
  watched.cpu_seconds = spy.cpuSeconds() - cpu;
  watched.counted = spy.end();
  return watched;
}

}  // namespace

std::vector<Benchmark> spyBenchmarks() {
  // Measured when the first row asks for it.
  auto measured = std::make_shared<std::optional<Watched>>();
  const auto watched = [measured]() -> const Watched& {
    if (!*measured)
      *measured = watch();
    return **measured;
  };
  return {{"spy.cpu_share",
           [watched] {
             Row row;
             row.id = "spy.cpu_share";
             row.value = watched().cpu_seconds / watched().seconds;
             row.unit = "of a core";
             row.note =
                 fmt::format("ARM_STATE on {} channels, together {:.0f} messages/s", kChannels,
                             static_cast<double>(watched().sent) / watched().seconds);
             return row;
           }},
          {"spy.lost", [watched] {
             Row row;
             row.id = "spy.lost";
             row.value = static_cast<double>(watched().sent - watched().counted);
             row.unit = "messages";
             row.note = fmt::format("of {}, same run", watched().sent);
             return row;
           }}};
}

}  // namespace fastball::bench
