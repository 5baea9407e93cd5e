#include "vision_tracker/flight_landing.h"

#include <cmath>

#include "vision_tracker/flight_path.h"

namespace fastball::vision_tracker {
namespace {

/// As model::land(), with lift.
std::optional<model::Landing> crossingOf(const FlightEstimate& flight,
                                         const model::Target& target,
                                         double gravity) {
  if (flight.lift.isZero(0))
    return model::land(flight.start, target, flight.drag, gravity);
  constexpr double kStep = 5e-3, kLongest = 3.0;  // [s]
  model::BallState before = flight.start;
  for (double time = 0; time < kLongest; time += kStep) {
    const model::BallState after = flight.onward(before, kStep, gravity);
    if (target.distance(before.p_WBall) > 0 && !(target.distance(after.p_WBall) > 0)) {
      double low = 0, high = kStep;
      for (int i = 0; i < 40; ++i) {
        const double middle = (low + high) / 2;
        (target.distance(flight.onward(before, middle, gravity).p_WBall) > 0 ? low : high) = middle;
      }
      model::Landing landing;
      landing.time = time + high;
      landing.state = flight.onward(before, high, gravity);
      landing.landing = target.planeCoordinates(landing.state.p_WBall);
      return landing;
    }
    before = after;
  }
  return std::nullopt;
}

}  // namespace

std::optional<LandingEstimate> landingOf(const FlightEstimate& flight,
                                         const model::Target& target,
                                         double gravity) {
  const std::optional<model::Landing> crossing = crossingOf(flight, target, gravity);
  if (!crossing || !(std::abs(crossing->state.v_WBall.dot(target.n_WTarget)) > 1e-3))
    return std::nullopt;
  FlightPath path(flight.start, flight.drag, gravity, flight.lift,
                  !flight.noise_cov.bottomRows<3>().isZero(0));
  path.moveTo(crossing->time);
  // The crossing moves along the flight with the time it takes: dx - v (n . dx) / (n . v).
  const Eigen::Vector3d v = crossing->state.v_WBall;
  const Eigen::Matrix3d along =
      Eigen::Matrix3d::Identity() - v * target.n_WTarget.transpose() / v.dot(target.n_WTarget);
  Eigen::Matrix<double, 2, 3> axes;
  axes.row(0) = target.rightAxis();
  axes.row(1) = target.upAxis();
  const Eigen::Matrix<double, 2, kFlightParameters> jacobian =
      axes * along * path.sensitivity().topRows<3>();
  LandingEstimate landing;
  landing.utime = flight.utime + std::llround(crossing->time * 1e6);
  landing.landing = crossing->landing;
  landing.cov = jacobian * flight.cov * jacobian.transpose();
  landing.noise_cov = jacobian * flight.noise_cov * jacobian.transpose();
  for (const FlightGain& gain : flight.gains)
    landing.gains.push_back(jacobian * gain);
  landing.state = crossing->state;
  return landing;
}

}  // namespace fastball::vision_tracker
