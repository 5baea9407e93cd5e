#include "model/ball_flight.h"

#include <algorithm>
#include <cmath>

namespace fastball::model {
namespace {

constexpr double kLargestStep = 5e-3;    // [s]
constexpr double kTimeAccuracy = 1e-12;  // [s], of a crossing

BallState rungeKutta(const BallState& s, double h, double drag_per_metre, double gravity) {
  const auto acceleration = [&](const Eigen::Vector3d& v) {
    return flightAcceleration(v, drag_per_metre, gravity);
  };
  const Eigen::Vector3d v1 = s.v_WBall, a1 = acceleration(v1);
  const Eigen::Vector3d v2 = v1 + h / 2 * a1, a2 = acceleration(v2);
  const Eigen::Vector3d v3 = v1 + h / 2 * a2, a3 = acceleration(v3);
  const Eigen::Vector3d v4 = v1 + h * a3, a4 = acceleration(v4);
  return {s.p_WBall + h / 6 * (v1 + 2 * v2 + 2 * v3 + v4),
          s.v_WBall + h / 6 * (a1 + 2 * a2 + 2 * a3 + a4)};
}

/// Time in [low, high] at which f falls through zero: f(low) > 0 >= f(high). Newton's steps,
/// bisection where they would leave the bracket.
template <typename Function, typename Slope>
double fallingRoot(const Function& f, const Slope& slope, double low, double high) {
  double t = high;
  for (int i = 0; i < 200 && high - low > kTimeAccuracy; ++i) {
    const double value = f(t);
    (value > 0 ? low : high) = t;
    const double newton = t - value / slope(t);
    const double next = newton > low && newton < high ? newton : (low + high) / 2;
    if (std::abs(next - t) < kTimeAccuracy / 4)
      return next;
    t = next;
  }
  return (low + high) / 2;
}

/// One step of the flight, seen along the normal of the target plane.
class Step {
 public:
  Step(const BallState& start, const Target& target, double drag_per_metre, double gravity)
      : start_(start), target_(target), drag_per_metre_(drag_per_metre), gravity_(gravity) {}

  BallState at(double h) const { return rungeKutta(start_, h, drag_per_metre_, gravity_); }
  double distance(double h) const { return target_.distance(at(h).p_WBall); }
  double rate(double h) const { return target_.n_WTarget.dot(at(h).v_WBall); }
  double acceleration(double h) const {
    return target_.n_WTarget.dot(flightAcceleration(at(h).v_WBall, drag_per_metre_, gravity_));
  }

  /// Time within (0, h] at which the distance falls to zero, if it does.
  std::optional<double> crossing(double h) const {
    if (!(distance(0) > 0))
      return std::nullopt;
    double end = h;
    if (distance(h) > 0) {
      // The ball may touch the plane between both ends and come back.
      if (!(rate(0) < 0 && rate(h) > 0))
        return std::nullopt;
      end = fallingRoot([&](double t) { return -rate(t); },
                        [&](double t) { return -acceleration(t); }, 0, h);
      if (distance(end) > 0)
        return std::nullopt;
    }
    return fallingRoot([&](double t) { return distance(t); }, [&](double t) { return rate(t); }, 0,
                       end);
  }

 private:
  const BallState& start_;
  const Target& target_;
  double drag_per_metre_, gravity_;
};

}  // namespace

Eigen::Vector3d flightAcceleration(const Eigen::Vector3d& v_W,
                                   double drag_per_metre,
                                   double gravity) {
  return -gravity * Eigen::Vector3d::UnitZ() - drag_per_metre * v_W.norm() * v_W;
}

BallState fly(const BallState& start, double duration, double drag_per_metre, double gravity) {
  const auto steps = static_cast<long>(std::ceil(std::abs(duration) / kLargestStep));
  BallState state = start;
  for (long i = 0; i < steps; ++i)
    state = rungeKutta(state, duration / static_cast<double>(steps), drag_per_metre, gravity);
  return state;
}

std::optional<Landing> land(const BallState& start,
                            const Target& target,
                            double drag_per_metre,
                            double gravity,
                            double max_time) {
  BallState state = start;
  for (long i = 0; static_cast<double>(i) * kLargestStep < max_time; ++i) {
    const double time = static_cast<double>(i) * kLargestStep;
    const double h = std::min(kLargestStep, max_time - time);
    const Step step(state, target, drag_per_metre, gravity);
    if (const std::optional<double> crossing = step.crossing(h)) {
      Landing landing;
      landing.time = time + *crossing;
      landing.state = step.at(*crossing);
      landing.landing = target.planeCoordinates(landing.state.p_WBall);
      return landing;
    }
    state = step.at(h);
  }
  return std::nullopt;
}

}  // namespace fastball::model
