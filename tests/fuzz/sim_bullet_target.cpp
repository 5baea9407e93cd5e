#include "sim_bullet/node.h"
#include "tests/fuzz/node_target.h"

namespace fastball {
namespace {

/// Cheap to step and to draw.
sim_bullet::SimulatorSetup cheapSetup() {
  messaging::ProcessOptions options;
  options.config = fuzz::experimentPath();
  options.one_thread = true;
  sim_bullet::SimulatorSetup setup = sim_bullet::loadSetup(options);
  setup.settings.substeps = 2;
  constexpr int kSmaller = 16;
  for (sim_bullet::RigCamera& seen : setup.cameras->cameras) {
    model::Camera& camera = seen.camera;
    camera.width /= kSmaller;
    camera.height /= kSmaller;
    for (double* const pixels : {&camera.fx, &camera.fy, &camera.cx, &camera.cy})
      *pixels /= kSmaller;
  }
  return setup;
}

}  // namespace
}  // namespace fastball

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, std::size_t size) {
  using namespace fastball;
  static const sim_bullet::SimulatorSetup kSetup = cheapSetup();
  static int lives = 0;
  static fuzz::NodeTarget target("sim_bullet", 50, [](auto& endpoint, const auto& clock) {
    sim_bullet::SimulatorSetup setup = kSetup;
    // In real time each message may bring a hundred ticks. Images take most of the time, and see little of the messages.
    setup.realtime = ++lives % 8 == 0;
    if (lives % 8 != 1)
      setup.cameras.reset();
    return std::make_unique<sim_bullet::SimNode>(endpoint, clock, setup);
  });
  target.hear(data, size);
  return 0;
}
