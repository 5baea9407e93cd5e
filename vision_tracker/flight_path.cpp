#include "vision_tracker/flight_path.h"

#include <Eigen/Geometry>
#include <cmath>

namespace fastball::vision_tracker {
namespace {

constexpr double kLargestStep = 5e-3;  // [s]
constexpr int kWithoutLift = 7;        // columns of the sensitivity

using Rate = Eigen::Matrix<double, 6, 1>;

/// d/dt of the state and of its sensitivity.
template <int Columns>
struct Derivative {
  Rate state;
  Eigen::Matrix<double, 6, Columns> sensitivity;
};

Eigen::Vector3d acceleration(const Eigen::Vector3d& v,
                             double drag_per_metre,
                             const Eigen::Vector3d& lift,
                             double gravity) {
  return model::flightAcceleration(v, drag_per_metre, gravity) + lift.cross(v);
}

Eigen::Matrix3d crossMatrix(const Eigen::Vector3d& a) {
  Eigen::Matrix3d cross;
  cross << 0, -a.z(), a.y(), a.z(), 0, -a.x(), -a.y(), a.x(), 0;
  return cross;
}

template <int Columns>
Derivative<Columns> derivative(const Rate& x,
                               const Eigen::Matrix<double, 6, Columns>& s,
                               double drag_per_metre,
                               const Eigen::Vector3d& lift,
                               double gravity) {
  const Eigen::Vector3d v = x.tail<3>();
  const double speed = v.norm();
  Derivative<Columns> d;
  d.state.template head<3>() = v;
  d.state.template tail<3>() = acceleration(v, drag_per_metre, lift, gravity);
  Eigen::Matrix3d da_dv = -drag_per_metre * speed * Eigen::Matrix3d::Identity();
  if (speed > 0)
    da_dv -= drag_per_metre / speed * v * v.transpose();
  if (Columns > kWithoutLift)
    da_dv += crossMatrix(lift);
  d.sensitivity.template topRows<3>() = s.template bottomRows<3>();
  d.sensitivity.template bottomRows<3>().noalias() = da_dv * s.template bottomRows<3>();
  d.sensitivity.template bottomRows<3>().col(6) -= speed * v;
  if constexpr (Columns > kWithoutLift)
    d.sensitivity.template block<3, 3>(3, kWithoutLift) -= crossMatrix(v);
  return d;
}

}  // namespace

model::BallState flyLifted(const model::BallState& start,
                           double duration,
                           double drag_per_metre,
                           const Eigen::Vector3d& lift,
                           double gravity) {
  if (lift.isZero(0))
    return model::fly(start, duration, drag_per_metre, gravity);
  FlightPath path(start, drag_per_metre, gravity, lift, true);
  path.moveTo(duration);
  return path.state();
}

FlightPath::FlightPath(const model::BallState& start,
                       double drag_per_metre,
                       double gravity,
                       const Eigen::Vector3d& lift,
                       bool with_lift)
    : drag_per_metre_(drag_per_metre),
      gravity_(gravity),
      lift_(lift),
      with_lift_(with_lift),
      state_(start) {
  sensitivity_.setZero();
  sensitivity_.leftCols<6>().setIdentity();
}

template <int Columns>
void FlightPath::step(double h) {
  using Sensitivity = Eigen::Matrix<double, 6, Columns>;
  Rate x;
  x << state_.p_WBall, state_.v_WBall;
  const Sensitivity s = sensitivity_.leftCols<Columns>();
  const auto slope = [&](const Rate& at, const Sensitivity& sensitivity) {
    return derivative<Columns>(at, sensitivity, drag_per_metre_, lift_, gravity_);
  };
  const Derivative<Columns> a = slope(x, s);
  const Derivative<Columns> b = slope(x + h / 2 * a.state, s + h / 2 * a.sensitivity);
  const Derivative<Columns> c = slope(x + h / 2 * b.state, s + h / 2 * b.sensitivity);
  const Derivative<Columns> d = slope(x + h * c.state, s + h * c.sensitivity);
  x += h / 6 * (a.state + 2 * b.state + 2 * c.state + d.state);
  sensitivity_.leftCols<Columns>() +=
      h / 6 * (a.sensitivity + 2 * b.sensitivity + 2 * c.sensitivity + d.sensitivity);
  state_ = {x.head<3>(), x.tail<3>()};
}

void FlightPath::moveTo(double time) {
  const double duration = time - time_;
  const auto steps = static_cast<long>(std::ceil(std::abs(duration) / kLargestStep));
  for (long i = 0; i < steps; ++i) {
    if (with_lift_)
      step<kFlightParameters>(duration / static_cast<double>(steps));
    else
      step<kWithoutLift>(duration / static_cast<double>(steps));
  }
  time_ = time;
}

}  // namespace fastball::vision_tracker
