#include "vision_tracker/flight_landing.h"

#include <cmath>

#include "vision_tracker/flight_path.h"

namespace fastball::vision_tracker {

std::optional<LandingEstimate> landingOf(const FlightEstimate& flight,
                                         const model::Target& target,
                                         double gravity) {
  const std::optional<model::Landing> crossing =
      model::land(flight.start, target, flight.drag, gravity);
  if (!crossing || !(std::abs(crossing->state.v_WBall.dot(target.n_WTarget)) > 1e-3))
    return std::nullopt;
  FlightPath path(flight.start, flight.drag, gravity);
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
