#include "planner/starts.h"

#include <algorithm>
#include <random>

namespace fastball::planner {
namespace {

// All were found by searches with the default arm, hand and ball: 900 random starts for each of 13 targets 2 to 4 m away, -0.8 to
// 0.8 m high, up to 60 degrees to the side, and 600 more for each of 8 far and high ones with the shoulder free. Of the
// optima found, these are the fewest from which every target is solved that any of the optima solves, at more than 0.999 of
// the best speed found: on 120 other targets with the shoulder held, on 72 with it free, half of them far and high.
struct Stored {
  const char* name;
  double x[kSwingVariables];
};

constexpr Stored kHeldStarts[] = {
    // The upper arm swings forward, the forearm comes through beside it and below.
    {"sidearm",
     {0.42, 5.7, 0.01, -0.49, 0.05, 10, 0.03, 3.57, 0.82, 10, 0.14, -4.32, 0, 3, 0, 0.8, 0.5, 0.64,
      -0.25}},
    // The upper arm turned away from the target, the forearm stretches to it.
    {"backhand",
     {0.42, 5.7, 0, -1.75, 0.33, 10, -0.02, 0.84, 0.83, 10, -0.26, 0.91, 0, 3, 0, 0.67, 0.37, -0.6,
      0.17}},
    // The upper arm beside the body, the forearm comes through level with it.
    {"level sidearm",
     {0.4, 6, 0.02, -0.83, -0.55, 10, 0, 1.96, 1.3, 10, 0.8, -0.94, 0, 3, 0, 1.04, 0.3, 0.47,
      -0.05}}};

constexpr Stored kFreeStarts[] = {
    // The shoulder lifts the nearly straight arm beside the body: a high throw. Two ways to turn the forearm.
    {"lift",
     {0.4, 6, 0.08, -1.38, 2.88, 4.2, 0, -5.84, 0.77, 6, 0.8, -3.92, -0.59, 6, 0.03, 1.32, 1.05,
      1.6, -0.2}},
    {"lift with the forearm bent",
     {0.4, 6, 0.06, -1.39, -0.63, 7.5, 0, 0.96, 0.86, 5.1, 0.8, -0.84, -0.58, 6, 0.09, 1.33, 1,
      1.58, -0.2}},
    // The same with the upper arm turned farther away from the target.
    {"lift from behind",
     {0.89, 2.7, -0.08, -0.86, 1.98, 5.8, 0, -5.3, 0.55, 10, 0.8, 2.33, -0.55, 6, 0.03, 1.35, 0.93,
      1.59, -0.33}}};

/// The throw seen in a mirror: left and right exchanged.
SwingVector mirrored(SwingVector x) {
  for (int i : {kAlpha1, kC1, kAlpha3, kC3})
    x[i] = -x[i];
  return x;
}

/// How far [rad, rad/s, ...] random starts lie from the stored ones (standard deviation).
SwingVector spread(Shoulder shoulder) {
  SwingVector x;
  x << 0.15, 0.5, 0.1, 0.2, 0.2, 1.5, 0.01, 0.3, 0.3, 1.0, 0.2, 0.2, 0.1, 0.5, 0.1, 0.2, 0.1, 0, 0;
  if (shoulder == Shoulder::kHeld)
    x.segment<3>(kAlphaGamma).setZero();
  return x;
}

}  // namespace

std::vector<Start> storedStarts(Shoulder shoulder, double azimuth) {
  std::vector<Start> starts;
  const auto add = [&](const Stored& stored) {
    const SwingVector x = SwingVector::Map(stored.x);
    for (Start start : {Start{stored.name, x, 1}, Start{stored.name, mirrored(x), 1}}) {
      start.x[kC1] += azimuth;
      starts.push_back(start);
    }
  };
  if (shoulder == Shoulder::kHeld) {
    std::for_each(std::begin(kHeldStarts), std::end(kHeldStarts), add);
  } else {
    std::for_each(std::begin(kFreeStarts), std::end(kFreeStarts), add);
  }
  return starts;
}

std::vector<Start> randomStarts(Shoulder shoulder, double azimuth, int count, int64_t seed) {
  const std::vector<Start> stored = storedStarts(shoulder, azimuth);
  const SwingVector width = spread(shoulder);
  std::mt19937_64 engine(static_cast<uint64_t>(seed));
  std::normal_distribution<double> normal;
  std::vector<Start> starts;
  for (int i = 0; i < count; ++i) {
    Start start = stored[i % stored.size()];
    start.name = "random";
    for (int k = 0; k < kSwingVariables; ++k)
      start.x[k] += width[k] * normal(engine);
    starts.push_back(start);
  }
  return starts;
}

}  // namespace fastball::planner
