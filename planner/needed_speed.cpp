#include "planner/needed_speed.h"

#include <cmath>

#include "model/ball_flight.h"

namespace fastball::planner {
namespace {

constexpr double kFastest = 100;       // [m/s]
constexpr double kResolution = 0.005;  // [m/s]
constexpr double kDegree = 3.14159265358979 / 180;

}  // namespace

std::optional<double> neededSpeed(const model::Target& target,
                                  double reach,
                                  double drag_per_metre,
                                  double gravity) {
  const Eigen::Vector3d& goal = target.p_WTarget;
  // The throw runs in the vertical plane through shoulder and target.
  const Eigen::Vector3d forward(goal.x() / goal.head<2>().norm(), goal.y() / goal.head<2>().norm(),
                                0);
  model::Target plane = target;
  plane.n_WTarget = -forward;
  const auto passesAbove = [&](double release, double elevation, double speed) {
    const model::BallState start{
        reach * (std::cos(release) * forward + std::sin(release) * Eigen::Vector3d::UnitZ()),
        speed * (std::cos(elevation) * forward + std::sin(elevation) * Eigen::Vector3d::UnitZ())};
    const auto landing = model::land(start, plane, drag_per_metre, gravity);
    return landing && landing->landing.y() >= 0;
  };
  double best = kFastest;
  for (int release = -80; release <= 80; release += 20) {
    for (int elevation = -80; elevation <= 80; elevation += 5) {
      // Only a speed below the best so far is of interest.
      if (!passesAbove(release * kDegree, elevation * kDegree, best))
        continue;
      double low = 0, high = best;
      while (high - low > kResolution) {
        const double middle = 0.5 * (low + high);
        (passesAbove(release * kDegree, elevation * kDegree, middle) ? high : low) = middle;
      }
      best = high;
    }
  }
  if (best == kFastest)
    return {};
  return best;
}

}  // namespace fastball::planner
