#include "bench/messaging_rows.h"

#include <fmt/format.h>
#include <poll.h>

#include <functional>
#include <memory>
#include <optional>

#include "bench/logged_traffic.h"
#include "bench/round_trip.h"
#include "bench/timing.h"
#include "messaging/lcm_endpoint.h"
#include "messaging/local_network.h"

namespace fastball::bench {
namespace {

constexpr double kMicro = 1e6;
constexpr int kPatienceMs = 1000;

/// An ARM_STATE and its ARM_COMMAND, over and over, between a robot and a controller that does no work.
class RoundTrip {
 public:
  RoundTrip(messaging::Endpoint& robot, messaging::Endpoint& controller)
      : states_(robot, messaging::kArmState), commands_(controller, messaging::kArmCommand) {
    controller.subscribe<arm_state_t>(messaging::kArmState, [this](const arm_state_t& state) {
      arm_command_t command{};
      command.scene_id = state.scene_id;
      command.tick = state.tick;
      commands_.publish(command);
    });
    robot.subscribe<arm_command_t>(messaging::kArmCommand,
                                   [this](const arm_command_t& m) { answered_ = m.tick; });
  }
  void ask() {
    arm_state_t state{};
    state.scene_id = 1;
    state.tick = ++tick_;
    states_.publish(state);
  }
  bool answered() const { return answered_ == tick_; }

 private:
  messaging::Publisher<arm_state_t> states_;
  messaging::Publisher<arm_command_t> commands_;
  int64_t tick_ = 0;
  int64_t answered_ = 0;
};

void drainWhenReadable(messaging::LcmEndpoint& endpoint) {
  pollfd readable{endpoint.fileDescriptor(), POLLIN, 0};
  poll(&readable, 1, kPatienceMs);
  endpoint.drain();
}

double overLcm() {
  const std::string url = privateLcmUrl();
  messaging::LcmEndpoint robot(url);
  messaging::LcmEndpoint controller(url);
  RoundTrip trip(robot, controller);
  return secondsPerCall("lcm.round_trip_us", [&] {
    trip.ask();
    drainWhenReadable(controller);
    while (!trip.answered())
      drainWhenReadable(robot);
  });
}

double throughMemory() {
  const messaging::SystemClock clock;
  messaging::LocalNetwork network(clock);
  messaging::Endpoint& robot = network.addEndpoint();
  messaging::Endpoint& controller = network.addEndpoint();
  RoundTrip trip(robot, controller);
  return secondsPerCall("local.round_trip_us", [&] {
    trip.ask();
    network.run([&] { return trip.answered(); });
  });
}

constexpr double kTripSeconds = 8;
constexpr int kBusyLoops = 4;

/// The trips of one run, idle and beside the busy loops.
struct MeasuredTrips {
  RoundTrips idle, loaded;
};
MeasuredTrips measuredTrips() {
  MeasuredTrips trips;
  trips.idle = roundTrips(kTripSeconds);
  const BusyLoops busy(kBusyLoops);
  trips.loaded = roundTrips(kTripSeconds);
  return trips;
}

Row ratioRow(const MeasuredTrips& trips) {
  const auto p50 = [](const std::vector<double>& times) { return quantile(times, 0.5) * kMicro; };
  return {
      "lcm.round_trip_ratio",
      p50(trips.idle.lcm) / p50(trips.idle.bare),
      "",
      "bare UDP multicast, same run",
      1.0,
      fmt::format("p50 of ARM_STATE to its ARM_COMMAND at 1 kHz between two processes: {:.0f} "
                  "us and {:.0f} us; {:.0f} us where the bare sockets have a reading thread and a "
                  "pipe, as in LCM 1.3.1; beside {} busy loops {:.0f}, {:.0f} and {:.0f} us",
                  p50(trips.idle.lcm), p50(trips.idle.bare), p50(trips.idle.piped), kBusyLoops,
                  p50(trips.loaded.lcm), p50(trips.loaded.bare), p50(trips.loaded.piped))};
}

Row tailRow(const char* id, const RoundTrips& trips, const std::string& beside) {
  const double share = 0.999;
  return {id,
          quantile(trips.lcm, share) * kMicro,
          "us",
          "bare UDP multicast, same run",
          quantile(trips.bare, share) * kMicro,
          fmt::format("p99.9 of the same, {}", beside)};
}

}  // namespace

std::vector<Benchmark> messagingBenchmarks() {
  // Measured when the first row asks for it.
  auto measured = std::make_shared<std::optional<MeasuredTrips>>();
  const auto trips = [measured]() -> const MeasuredTrips& {
    if (!*measured)
      *measured = measuredTrips();
    return **measured;
  };
  return {
      {"lcm.round_trip_us",
       [] {
         return Row{"lcm.round_trip_us",
                    overLcm() * kMicro,
                    "us",
                    "through memory, one process",
                    throughMemory() * kMicro,
                    "ARM_STATE and its ARM_COMMAND, one thread at both ends"};
       }},
      {"lcm.round_trip_ratio", [trips] { return ratioRow(trips()); }},
      {"lcm.round_trip_p999_us",
       [trips] { return tailRow("lcm.round_trip_p999_us", trips().idle, "nothing beside it"); }},
      {"lcm.round_trip_p999_loaded_us", [trips] {
         return tailRow("lcm.round_trip_p999_loaded_us", trips().loaded,
                        fmt::format("beside {} busy loops", kBusyLoops));
       }}};
}

}  // namespace fastball::bench
