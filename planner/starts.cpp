#include "planner/starts.h"

#include <random>

namespace fastball::planner {
namespace {

/// The throw seen in a mirror: left and right exchanged.
SwingVector mirrored(SwingVector x) {
  for (int i : {kAlpha1, kC1, kAlpha3, kC3})
    x[i] = -x[i];
  return x;
}

// Both were found by optimisations from a thousand random starts with the default arm, target and ball; every throw at the
// limits that was found is near one of them or its mirror image.

/// The upper arm swings forward at shoulder height, the forearm hangs and comes through below it, level at the release.
SwingVector lowSidearm() {
  SwingVector x;
  x << 0.58, 4.0, 0.0, -1.05, -1.10, 6.0, -0.006, 2.63, 1.37, 7.0, 0.8, -0.65, 1.0, 0.57;
  return x;
}

/// The upper arm points up, the forearm comes through beside it.
SwingVector highSidearm() {
  SwingVector x;
  x << 0.58, 4.0, -0.05, -1.26, -1.07, 4.3, 0.0, 2.63, 1.27, 6.5, 0.72, -0.58, 0.59, 0.63;
  return x;
}

/// How far [rad, rad/s, ...] random starts lie from the stored ones (standard deviation).
SwingVector spread() {
  SwingVector x;
  x << 0.15, 0.5, 0.1, 0.2, 0.2, 1.5, 0.01, 0.3, 0.3, 1.0, 0.2, 0.2, 0.2, 0.1;
  return x;
}

}  // namespace

std::vector<Start> swingStarts(double azimuth, int random, int64_t seed) {
  std::vector<Start> starts{{"low sidearm, right", lowSidearm(), 1},
                            {"low sidearm, left", mirrored(lowSidearm()), 1},
                            {"high sidearm, right", highSidearm(), 1},
                            {"high sidearm, left", mirrored(highSidearm()), 1}};
  const std::size_t stored = starts.size();
  std::mt19937_64 engine(static_cast<uint64_t>(seed));
  std::normal_distribution<double> normal;
  for (int i = 0; i < random; ++i) {
    Start start = starts[i % stored];
    start.name = "random";
    for (int k = 0; k < kSwingVariables; ++k)
      start.x[k] += spread()[k] * normal(engine);
    starts.push_back(start);
  }
  for (Start& start : starts)
    start.x[kC1] += azimuth;
  return starts;
}

}  // namespace fastball::planner
