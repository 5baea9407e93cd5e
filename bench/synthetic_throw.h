#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "config/experiment.h"
#include "model/ball_flight.h"
#include "sim_bullet/camera_rig.h"
#include "sim_bullet/snapshot.h"

namespace fastball::bench {

/// A throw made of formulas: the arm swings, the ball leaves the hand with the hand's own velocity and flies with drag.
struct SyntheticThrow {
  int64_t start_utime = 0, end_utime = 0;  ///< [us], of the camera images
  int64_t release_utime = 0;
  model::BallState release;
  double drag = 0;         ///< [1/m], true one, up to 20 % from the ball file's
  model::Landing landing;  ///< true, time after the release
  int64_t landing_utime = 0;
  std::vector<sim_bullet::SceneSnapshot> snapshots;  ///< every millisecond
};

/// The release, drag and landing of a throw alone. @param drag [1/m], instead of a drawn one
SyntheticThrow makeFlight(const config::Experiment& experiment,
                          int seed,
                          std::optional<double> drag = {});

/// Another throw for another seed: release point, flight time, landing point in the ring and drag are drawn from it.
SyntheticThrow makeThrow(const config::Experiment& experiment,
                         int seed,
                         int64_t scene_utime = 10000000);

/// All images of a throw, in order of time.
std::vector<sim_bullet::RenderedImage> renderThrow(sim_bullet::CameraRig& rig,
                                                   const config::Experiment& experiment,
                                                   const SyntheticThrow& synthetic,
                                                   int64_t seed);

}  // namespace fastball::bench
