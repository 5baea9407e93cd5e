#include "vision_tracker/flight_path.h"

#include <cmath>

namespace fastball::vision_tracker {
namespace {

constexpr double kLargestStep = 5e-3;  // [s]

using Rate = Eigen::Matrix<double, 6, 1>;

/// d/dt of the state and of its sensitivity.
struct Derivative {
  Rate state;
  FlightSensitivity sensitivity;
};

Derivative derivative(const Rate& x,
                      const FlightSensitivity& s,
                      double drag_per_metre,
                      double gravity) {
  const Eigen::Vector3d v = x.tail<3>();
  const double speed = v.norm();
  Derivative d;
  d.state.head<3>() = v;
  d.state.tail<3>() = model::flightAcceleration(v, drag_per_metre, gravity);
  Eigen::Matrix3d da_dv = -drag_per_metre * speed * Eigen::Matrix3d::Identity();
  if (speed > 0)
    da_dv -= drag_per_metre / speed * v * v.transpose();
  d.sensitivity.topRows<3>() = s.bottomRows<3>();
  d.sensitivity.bottomRows<3>().noalias() = da_dv * s.bottomRows<3>();
  d.sensitivity.bottomRows<3>().col(6) -= speed * v;
  return d;
}

}  // namespace

FlightPath::FlightPath(const model::BallState& start, double drag_per_metre, double gravity)
    : drag_per_metre_(drag_per_metre), gravity_(gravity), state_(start) {
  sensitivity_.setZero();
  sensitivity_.leftCols<6>().setIdentity();
}

void FlightPath::step(double h) {
  Rate x;
  x << state_.p_WBall, state_.v_WBall;
  const FlightSensitivity& s = sensitivity_;
  const Derivative a = derivative(x, s, drag_per_metre_, gravity_);
  const Derivative b =
      derivative(x + h / 2 * a.state, s + h / 2 * a.sensitivity, drag_per_metre_, gravity_);
  const Derivative c =
      derivative(x + h / 2 * b.state, s + h / 2 * b.sensitivity, drag_per_metre_, gravity_);
  const Derivative d =
      derivative(x + h * c.state, s + h * c.sensitivity, drag_per_metre_, gravity_);
  x += h / 6 * (a.state + 2 * b.state + 2 * c.state + d.state);
  sensitivity_ += h / 6 * (a.sensitivity + 2 * b.sensitivity + 2 * c.sensitivity + d.sensitivity);
  state_ = {x.head<3>(), x.tail<3>()};
}

void FlightPath::moveTo(double time) {
  const double duration = time - time_;
  const auto steps = static_cast<long>(std::ceil(std::abs(duration) / kLargestStep));
  for (long i = 0; i < steps; ++i)
    step(duration / static_cast<double>(steps));
  time_ = time;
}

}  // namespace fastball::vision_tracker
