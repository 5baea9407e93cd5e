#include "planner/window_starts.h"

namespace fastball::planner {
namespace {

// Found by optimisations from some thousand random starts to targets 2 to 4 m away, 0.8 m below to 0.8 m above the shoulder, with
// windows of 5 to 40 ms: every good throw was near one of them or its mirror image.
constexpr double kStored[][kWindowVariables] = {
    // The arm comes up from below, stretched forward.
    {0.36, 1.57, 0.32, 1.2, 0.67, 0,   26,  250, 3.3, 3.4, 0.5, 0.3, 0.5,
     0.35, 0.35, 0.4,  0.4, 0.45, -15, -45, 15,  10,  5,   0,   0,   70},
    // Sidearm, the forearm comes through below the shoulder's height.
    {0.7,  1.51, 2.32, 1.52, 0.7,  5.57, -68, -360, -0.4, -0.4, 0.44, 0.36, 0.35,
     0.35, 0.35, 0.35, 0.15, 0.45, -38,  28,  28,   3,    0,    30,   -39,  60},
    // Overhead, nearly in one plane.
    {0.02, 0.11, -0.13, -0.67, 0.76, 0, -14, -280, -0.6, -0.6, 0.44, 0.15, 0.3,
     0.23, 0.4,  0.6,   0.2,   0.2,  0, 0,   0,    0,    0,    0,    0,    0},
    // The elbow bends the other way.
    {-0.47, 1.7,  2.64, -0.75, 0.72, -0.12, -30, -800, 2.2, 2.9, 0.6, 0.12, 0.35,
     0.4,   0.35, 0.47, 0.47,  0.58, 30,    -35, 6,    60,  0,   -3,  -2,   -64},
};

}  // namespace

WindowThrow mirrored(WindowThrow x) {
  x.window.q_start[0] = -x.window.q_start[0];
  x.window.q_start[2] = -x.window.q_start[2];
  x.window.joint3 = -x.window.joint3;
  return x;
}

WindowThrow turned(WindowThrow x, double angle) {
  x.window.q_start[0] += angle;
  return x;
}

std::vector<WindowThrow> windowStarts(double azimuth, double length) {
  std::vector<WindowThrow> starts;
  for (const auto& stored : kStored) {
    const WindowThrow x = fromVector(Eigen::Map<const WindowVector>(stored), length);
    starts.push_back(turned(x, azimuth));
    starts.push_back(turned(mirrored(x), azimuth));
  }
  return starts;
}

}  // namespace fastball::planner
