#include "model/ball_flight.h"

#include <algorithm>
#include <cmath>

namespace fastball::model {
namespace {

constexpr double kLargestStep = 5e-3;     // [s]
constexpr double kTimeAccuracy = 1e-12;   // [s], of a crossing
constexpr double kAimingStep = 0.15;      // [s]
constexpr double kAimingAccuracy = 1e-7;  // [m]
constexpr long kFewestAimingSteps = 4;
constexpr int kAimingRounds = 30;

/// Drag changes slowly: with these steps Runge-Kutta is right to a tenth of a millimetre at worst.
long aimingSteps(double duration) {
  return std::max(kFewestAimingSteps, static_cast<long>(std::ceil(duration / kAimingStep)));
}

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

/// Derivative of flightAcceleration by the velocity.
Eigen::Matrix3d dragSlope(const Eigen::Vector3d& v, double drag_per_metre) {
  const double speed = v.norm();
  if (speed == 0)
    return Eigen::Matrix3d::Zero();
  return -drag_per_metre * (speed * Eigen::Matrix3d::Identity() + v * v.transpose() / speed);
}

/// rungeKutta() and its derivatives by the velocity from which it starts.
FlightDerivatives rungeKuttaDerivatives(const BallState& s,
                                        double h,
                                        double drag_per_metre,
                                        double gravity) {
  using Eigen::Matrix3d;
  const Matrix3d one = Matrix3d::Identity();
  const auto acceleration = [&](const Eigen::Vector3d& v) {
    return flightAcceleration(v, drag_per_metre, gravity);
  };
  const auto slope = [&](const Eigen::Vector3d& v) { return dragSlope(v, drag_per_metre); };
  const Eigen::Vector3d v1 = s.v_WBall, a1 = acceleration(v1);
  const Matrix3d A1 = slope(v1);
  const Eigen::Vector3d v2 = v1 + h / 2 * a1, a2 = acceleration(v2);
  const Matrix3d V2 = one + h / 2 * A1, A2 = slope(v2) * V2;
  const Eigen::Vector3d v3 = v1 + h / 2 * a2, a3 = acceleration(v3);
  const Matrix3d V3 = one + h / 2 * A2, A3 = slope(v3) * V3;
  const Eigen::Vector3d v4 = v1 + h * a3, a4 = acceleration(v4);
  const Matrix3d V4 = one + h * A3, A4 = slope(v4) * V4;
  return {{s.p_WBall + h / 6 * (v1 + 2 * v2 + 2 * v3 + v4),
           s.v_WBall + h / 6 * (a1 + 2 * a2 + 2 * a3 + a4)},
          h / 6 * (one + 2 * V2 + 2 * V3 + V4),
          one + h / 6 * (A1 + 2 * A2 + 2 * A3 + A4)};
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

  /// Time within (0, h] at which the distance falls to zero, if it does; `after`: at(h).
  std::optional<double> crossing(double h, const BallState& after) const {
    if (!(target_.distance(start_.p_WBall) > 0))
      return std::nullopt;
    double end = h;
    if (target_.distance(after.p_WBall) > 0) {
      // The ball may touch the plane between both ends and come back.
      if (!(target_.n_WTarget.dot(start_.v_WBall) < 0 && target_.n_WTarget.dot(after.v_WBall) > 0))
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

FlightDerivatives flyWithDerivatives(const BallState& start,
                                     double duration,
                                     double drag_per_metre,
                                     double gravity,
                                     double largest_step) {
  const auto steps = static_cast<long>(std::ceil(std::abs(duration) / largest_step));
  FlightDerivatives flight{start, Eigen::Matrix3d::Zero(), Eigen::Matrix3d::Identity()};
  for (long i = 0; i < steps; ++i) {
    const FlightDerivatives step = rungeKuttaDerivatives(
        flight.state, duration / static_cast<double>(steps), drag_per_metre, gravity);
    flight.state = step.state;
    flight.dp_dv += step.dp_dv * flight.dv_dv;
    flight.dv_dv = step.dv_dv * flight.dv_dv;
  }
  return flight;
}

Eigen::Vector3d velocityToReach(const Eigen::Vector3d& p_W,
                                const Eigen::Vector3d& p_WGoal,
                                double duration,
                                double drag_per_metre,
                                double gravity,
                                const std::optional<Eigen::Vector3d>& guess) {
  const Eigen::Vector3d mean = (p_WGoal - p_W) / duration;
  const Eigen::Vector3d half_fall = gravity * duration / 2 * Eigen::Vector3d::UnitZ();
  const long steps = aimingSteps(duration);
  const double h = duration / static_cast<double>(steps);
  const double x = drag_per_metre * duration * mean.norm();
  const double across = x > 0 ? -std::expm1(-x) / x : 1;
  const double along = x > 0 ? -std::expm1(-2 * x) / (2 * x) : 1;
  const Eigen::Vector3d e = mean.normalized();
  Eigen::Vector3d v = guess.value_or(mean * (1 + x / 2) + half_fall);
  for (int i = 0; i < kAimingRounds; ++i) {
    BallState ball{p_W, v};
    for (long k = 0; k < steps; ++k)
      ball = rungeKutta(ball, h, drag_per_metre, gravity);
    const Eigen::Vector3d miss = p_WGoal - ball.p_WBall;
    // dp/dv: a change of speed along the flight dies away twice as fast as one across it.
    v += (miss / across + (1 / along - 1 / across) * e.dot(miss) * e) / duration;
    if (miss.squaredNorm() < kAimingAccuracy * kAimingAccuracy)
      break;
  }
  return v;
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
    const BallState after = step.at(h);
    if (const std::optional<double> crossing = step.crossing(h, after)) {
      Landing landing;
      landing.time = time + *crossing;
      landing.state = step.at(*crossing);
      landing.landing = target.planeCoordinates(landing.state.p_WBall);
      return landing;
    }
    state = after;
  }
  return std::nullopt;
}

}  // namespace fastball::model
