#include "bench/round_trip.h"

#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <csignal>
#include <functional>
#include <memory>
#include <stdexcept>
#include <thread>

#include "bench/round_trip_ways.h"
#include "bench/timing.h"
#include "messaging/multicast_check.h"

namespace fastball::bench {
namespace {

using Steady = std::chrono::steady_clock;

constexpr auto kPeriod = std::chrono::milliseconds(1);
constexpr int kPatienceMs = 20;
constexpr int kBlock = 250;  // trips before the other way has its turn

/// The controller of one way: a process that answers until it is killed.
class Controller {
 public:
  explicit Controller(const std::function<std::unique_ptr<Way>()>& make) : pid_(fork()) {
    if (pid_ != 0)
      return;
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    try {
      for (const auto way = make();;) {
        waitFor(way->fileDescriptor(), -1);
        way->hear();
      }
    } catch (const std::exception&) {
    }
    _exit(1);
  }
  ~Controller() {
    if (pid_ > 0) {
      kill(pid_, SIGKILL);
      waitpid(pid_, nullptr, 0);
    }
  }
  Controller(const Controller&) = delete;
  Controller& operator=(const Controller&) = delete;

 private:
  pid_t pid_;
};

/// One trip. @return [s], nothing if no answer came.
double trip(Way& way, int64_t tick) {
  const auto start = Steady::now();
  way.say(tick);
  while (waitFor(way.fileDescriptor(), kPatienceMs)) {
    if (way.hear() == tick)
      return std::chrono::duration<double>(Steady::now() - start).count();
  }
  return -1;
}

/// `count` trips, one a millisecond.
void measure(Way& way, int count, int64_t& tick, std::vector<double>& times) {
  auto next = Steady::now();
  for (int i = 0; i < count; ++i) {
    next += kPeriod;
    std::this_thread::sleep_until(next);
    if (const double time = trip(way, ++tick); time >= 0)
      times.push_back(time);
  }
}

/// Until the controller is there.
void awaitAnswer(Way& way, int64_t& tick) {
  for (int i = 0; i < 200; ++i) {
    if (trip(way, ++tick) >= 0)
      return;
  }
  throw std::runtime_error("no answer over multicast in 4 s");
}

}  // namespace

double quantile(std::vector<double> values, double share) {
  const auto place = std::min(values.size() - 1,
                              static_cast<std::size_t>(share * static_cast<double>(values.size())));
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(place),
                   values.end());
  return values[place];
}

RoundTrips roundTrips(double seconds) {
  const std::string url = privateLcmUrl();
  messaging::MulticastUrl where = *messaging::parseMulticastUrl(url);
  using Make = std::function<std::unique_ptr<Way>(bool is_controller)>;
  RoundTrips trips;
  struct Measured {
    Make make;
    std::vector<double>& times;
    std::unique_ptr<Controller> controller;
    std::unique_ptr<Way> robot;
  };
  messaging::MulticastUrl bare_where = where, piped_where = where;
  bare_where.port = static_cast<uint16_t>(where.port + 1);
  piped_where.port = static_cast<uint16_t>(where.port + 2);
  std::array<Measured, 3> ways{
      Measured{[&](bool c) { return lcmWay(url, c); }, trips.lcm, {}, {}},
      Measured{[&](bool c) { return bareWay(bare_where, c); }, trips.bare, {}, {}},
      Measured{[&](bool c) { return pipedWay(piped_where, c); }, trips.piped, {}, {}}};
  // All are forked before this process has threads of its own for them.
  for (Measured& way : ways)
    way.controller = std::make_unique<Controller>([&] { return way.make(true); });
  int64_t tick = 0;
  for (Measured& way : ways) {
    way.robot = way.make(false);
    awaitAnswer(*way.robot, tick);
  }
  const double turn_s = static_cast<double>(ways.size()) * kBlock * 1e-3;
  for (int i = 0; i < std::max(1, static_cast<int>(std::lround(seconds / turn_s))); ++i) {
    for (Measured& way : ways)
      measure(*way.robot, kBlock, tick, way.times);
  }
  for (const Measured& way : ways) {
    if (way.times.empty())
      throw std::runtime_error("no answer over multicast");
  }
  return trips;
}

}  // namespace fastball::bench
