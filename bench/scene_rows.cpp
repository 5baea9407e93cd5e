#include "bench/scene_rows.h"

#include <fmt/format.h>

#include <cmath>
#include <opencv2/imgcodecs.hpp>

#include "bench/held_ball.h"
#include "bench/timing.h"
#include "sim_bullet/node.h"
#include "vision_tracker/config.h"
#if defined(FASTBALL_HAS_MUJOCO)
#include <mujoco/mujoco.h>

#include "bench/mujoco_peer.h"
#endif

namespace fastball::bench {
namespace {

constexpr double kMicro = 1e6;
constexpr double kMilli = 1e3;
constexpr int64_t kForeverUs = INT64_MAX;
constexpr int64_t kTickUs = 1000;

/// The default experiment's simulator, the arm at rest and braked.
struct Simulator {
  sim_bullet::SimulatorSetup setup = defaultSetup();
  sim_bullet::Scene scene{setup.experiment,
                          setup.settings,
                          setup.uncertainty,
                          {{0, 1}, setup.experiment.q_rest, setup.experiment.target}};

  static sim_bullet::SimulatorSetup defaultSetup() {
    messaging::ProcessOptions options;
    options.config = config::defaultExperimentPath();
    return sim_bullet::loadSetup(options);
  }
};

Row physicsTick() {
  Simulator simulator;
  const double seconds =
      cpuSecondsPerCall("sim.tick_us", [&] { simulator.scene.brake(simulator.scene.openHand()); });
  return {"sim.tick_us",
          seconds * kMicro,
          "us",
          "simulated time",
          sim_bullet::kTick * kMicro,
          "10 steps of 0.1 ms, arm and open hand at rest"};
}

/// A physics step while three fingers hold the ball.
Row heldStep() {
  HeldBall held;
  const double seconds = cpuSecondsPerCall("sim.step_us", [&] { held.tick(); });
  const int steps = held.settings().substeps;
  return {"sim.step_us",
          seconds / steps * kMicro,
          "us",
          "simulated time",
          sim_bullet::kTick / steps * kMicro,
          "arm braked, three fingers hold the ball; servos, contacts and sensors included"};
}

Row realTimeFactor() {
  HeldBall held;
  const double seconds = cpuSecondsPerCall("sim.real_time_factor", [&] { held.tick(); });
  return {"sim.real_time_factor",
          sim_bullet::kTick / seconds,
          "times",
          "the clock",
          1,
          "the same scene at 0.1 ms, without images, one core"};
}

#if defined(FASTBALL_HAS_MUJOCO)
Row mujocoRatio() {
  HeldBall held;
  const double peer = mujocoSecondsPerStep(held);
  const int steps = held.settings().substeps;
  const double own = cpuSecondsPerCall("sim.step_us", [&] { held.tick(); }) / steps;
  return {"sim.mujoco_ratio",
          peer / own,
          "times",
          "MuJoCo",
          1,
          fmt::format("MuJoCo {} takes {:.1f} us for a step of the same scene, Bullet {:.1f}",
                      mj_versionString(), peer * kMicro, own * kMicro)};
}
#endif

/// Cameras that look at a scene which stands still.
class StillCameras {
 public:
  explicit StillCameras(Simulator& simulator)
      : snapshot_(simulator.scene.snapshot(0)),
        rig_(*simulator.setup.cameras,
             simulator.setup.experiment.arm,
             simulator.setup.experiment.hand,
             simulator.setup.experiment.ball.radius) {
    rig_.begin(1, 1, 0, kForeverUs, simulator.setup.experiment.target);
  }
  /// The next image of each camera.
  std::vector<sim_bullet::RenderedImage> nextImages() {
    std::vector<sim_bullet::RenderedImage> images;
    while (images.size() < rig_.cameras().size()) {
      rig_.add(snapshot_);
      snapshot_.utime += kTickUs;
      rig_.flush();
      sim_bullet::RenderedImage image;
      while (rig_.nextImage(image))
        images.push_back(image);
    }
    return images;
  }
  const std::vector<sim_bullet::RigCamera>& cameras() const { return rig_.cameras(); }

 private:
  sim_bullet::SceneSnapshot snapshot_;
  sim_bullet::CameraRig rig_;
};

Row drawing() {
  Simulator simulator;
  StillCameras cameras(simulator);
  const double seconds = secondsPerCall("camera.pair_ms", [&] { cameras.nextImages(); });
  return {"camera.pair_ms",
          seconds * kMilli,
          "ms",
          "time between two images",
          kMilli / cameras.cameras().front().rate,
          "both cameras drawn and compressed, on all their threads"};
}

Row search() {
  Simulator simulator;
  StillCameras cameras(simulator);
  vision_tracker::ThrowTracker tracker(
      vision_tracker::readTracker(simulator.setup.experiment.path).tracker);
  for (std::size_t i = 0; i < cameras.cameras().size(); ++i) {
    const sim_bullet::RigCamera& camera = cameras.cameras()[i];
    tracker.setCamera(static_cast<int>(i), {camera.camera, camera.rate, camera.exposure});
  }
  tracker.begin(simulator.setup.experiment.target);
  const std::vector<sim_bullet::RenderedImage> images = cameras.nextImages();
  int64_t utime = 0;
  const double rate = cameras.cameras().front().rate;
  const double seconds = secondsPerCall("vision.pair_ms", [&] {
    utime += std::llround(kMicro / rate);
    for (const sim_bullet::RenderedImage& image : images) {
      tracker.add(image.camera, utime, cv::imdecode(image.jpeg, cv::IMREAD_GRAYSCALE));
    }
  });
  return {"vision.pair_ms",
          seconds * kMilli,
          "ms",
          "time between two images",
          kMilli / rate,
          "both images decoded and searched as a whole, no ball in flight"};
}

}  // namespace

std::vector<Benchmark> sceneBenchmarks() {
  return {
    {"sim.tick_us", physicsTick}, {"sim.step_us", heldStep},
        {"sim.real_time_factor", realTimeFactor},
#if defined(FASTBALL_HAS_MUJOCO)
        {"sim.mujoco_ratio", mujocoRatio},
#endif
        {"camera.pair_ms", drawing}, {
      "vision.pair_ms", search
    }
  };
}

}  // namespace fastball::bench
