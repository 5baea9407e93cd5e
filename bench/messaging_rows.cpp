#include "bench/messaging_rows.h"

#include <poll.h>

#include <functional>

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

}  // namespace

std::vector<Benchmark> messagingBenchmarks() {
  return {{"lcm.round_trip_us", [] {
             return Row{"lcm.round_trip_us",
                        overLcm() * kMicro,
                        "us",
                        "through memory, one process",
                        throughMemory() * kMicro,
                        "ARM_STATE and its ARM_COMMAND, one thread at both ends"};
           }}};
}

}  // namespace fastball::bench
