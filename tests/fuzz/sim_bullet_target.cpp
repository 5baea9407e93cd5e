#include "sim_bullet/node.h"
#include "tests/fuzz/node_target.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, std::size_t size) {
  using namespace fastball;
  static const auto kSetup = [] {
    messaging::ProcessOptions options;
    options.config = fuzz::experimentPath();
    return sim_bullet::loadSetup(options);
  }();
  static int lives = 0;
  static fuzz::NodeTarget target("sim_bullet", 50, [](auto& endpoint, const auto& clock) {
    sim_bullet::SimulatorSetup setup = kSetup;
    setup.realtime = ++lives % 2 == 0;
    // Images take most of the time, and see little of the messages.
    if (lives % 8 != 1)
      setup.cameras.reset();
    return std::make_unique<sim_bullet::SimNode>(endpoint, clock, setup);
  });
  target.hear(data, size);
  return 0;
}
