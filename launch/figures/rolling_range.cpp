#include "launch/figures/rolling_range.h"

#include <Eigen/Geometry>
#include <cmath>

#include "model/hand.h"

namespace fastball::launch {

model::HandMotion CircleSwing::operator()(double t) const {
  using Eigen::Vector3d;
  const double w0 = speed / radius, dw0 = acceleration / radius;
  const double angle = t * (w0 + t * (dw0 / 2 - dw0 * t / (6 * fade_time)));
  const double rate = w0 + t * (dw0 - dw0 * t / (2 * fade_time));
  const double rate_change = dw0 * (1 - t / fade_time);
  const Vector3d axis = Vector3d::UnitY();
  const Eigen::Matrix3d turned = Eigen::AngleAxisd(angle, axis).toRotationMatrix();
  const Vector3d outwards = turned * Vector3d::UnitZ(), forwards = turned * Vector3d::UnitX();
  model::HandMotion hand;
  hand.X_WH.setIdentity();
  hand.X_WH.linear().col(0) = std::cos(lean) * outwards + std::sin(lean) * forwards;
  hand.X_WH.linear().col(1) = -std::sin(lean) * outwards + std::cos(lean) * forwards;
  hand.X_WH.linear().col(2) = axis;
  hand.X_WH.translation() = radius * outwards;
  hand.v_WH = radius * rate * forwards;
  hand.w_WH = rate * axis;
  hand.a_WH = radius * (rate_change * forwards - rate * rate * outwards);
  hand.dw_WH = rate_change * axis;
  return hand;
}

CircleSwing CircleSwing::faster(double factor) const {
  CircleSwing swing = *this;
  swing.speed *= factor;
  swing.acceleration *= factor * factor;
  swing.fade_time /= factor;
  return swing;
}

RollOutcome outcomeOf(const model::RollingMotion& motion) {
  const double x = motion.samples.back().p_FBall.x(), t = motion.t_release;
  if (motion.samples.size() < 2)
    return {RollKind::kNone, x, t};
  return {x < 0 ? RollKind::kBackwards : RollKind::kForwards, x, t};
}

double fingertipPastBall(const model::HandParameters& parameters, double ball_radius) {
  const model::Hand hand(parameters);
  const double touch = ball_radius + parameters.finger_radius;
  const model::HandVector q = hand.posture(0, 0, {touch, touch, touch});
  return hand.phalanges(model::kFingerA, q)[1].p_end.z() - parameters.p_HBall.z();
}

}  // namespace fastball::launch
