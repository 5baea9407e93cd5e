#include "planner/swing_problem.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "model/ball_flight.h"
#include "planner/hand_motion.h"

namespace fastball::planner {
namespace {

// [s] before the release, where speeds peak and samples are dense.
constexpr double kDense = 0.1;
// [rad] of the joint ranges, for what happens between the samples.
constexpr double kReserve = 0.005;

double square(double x) {
  return x * x;
}

/// |x|, smooth at 0.
double smoothAbs(double x, double width) {
  return std::sqrt(x * x + width * width);
}

/// <= 0 where low <= x <= high, smooth.
double outside(double x, double low, double high) {
  return square((2 * x - low - high) / (high - low)) - 1;
}

}  // namespace

double SwingProblem::Values::violation() const {
  if (!inequalities.allFinite() || !equalities.allFinite() || !std::isfinite(release_speed))
    return std::numeric_limits<double>::infinity();
  return std::max({0.0, inequalities.maxCoeff(), equalities.cwiseAbs().maxCoeff()});
}

SwingProblem::SwingProblem(const SwingTask& task, int elbow_sign)
    : task_(task), elbow_sign_(elbow_sign) {
  const model::ArmParameters& arm = task.arm->parameters();
  //        alpha1 omega1 phi1 c1   amp2 omega2 switch c2   alpha3 omega3 phi3 c3  gamma flight
  lower_ << -1.5, 1.5, -1.0, -4, -1.5, 3, -0.05, -4, -2.5, 2, -1.0, -6.3, 0, 0.15;
  upper_ << 1.5, 8, 0.8, 4, 1.5, 16, 0.05, 4, 2.5, 12, 0.8, 6.3, 0, 1.5;
  upper_[kOmega1] = task.settings.omega_max[0];
  upper_[kOmega2] = task.settings.omega_max[1];
  upper_[kOmega3] = task.settings.omega_max[2];
  lower_[kGamma] = 0.2;
  upper_[kGamma] = arm.q_max[1] - arm.position_margin - kReserve;
}

void SwingProblem::atSample(const model::ArmMotion& motion, bool swinging, double* c) const {
  const model::Arm& arm = *task_.arm;
  const model::ArmParameters& limits = arm.parameters();
  const SwingSettings& settings = task_.settings;
  const double f = task_.limit_factor;
  for (int j : {0, 2, 3}) {
    const double margin = limits.position_margin + kReserve;
    *c++ = outside(motion.q[j], limits.q_min[j] + margin, limits.q_max[j] - margin);
    *c++ = square(motion.qd[j] / (f * limits.qd_max[j])) - 1;
  }
  *c++ = swinging ? settings.elbow_margin - elbow_sign_ * motion.q[3] : -1;
  const Eigen::Vector4d tau =
      arm.inverseDynamics(motion.q, motion.qd, motion.qdd) + arm.frictionTorque(motion.qd);
  const Eigen::Vector4d share = tau.cwiseQuotient(f * limits.tau_max);
  *c++ = square(share[0]) - 1;
  *c++ = smoothAbs(share[1], 1e-2) + smoothAbs(share[2], 1e-2) - 1;
  *c++ = square(share[3]) - 1;
  const Eigen::Vector3d p_WBall = arm.p_WPoint(motion.q, task_.p_TBall);
  // The column: below the shoulder and a little above it.
  const double above = std::max(0.0, p_WBall.z() - 0.1);
  const double distance = std::sqrt(p_WBall.head<2>().squaredNorm() + square(above));
  *c++ = std::max(settings.body_clearance - distance, settings.lowest_ball - p_WBall.z());
}

void SwingProblem::atRelease(const SwingVector& x,
                             const model::ArmMotion& motion,
                             Values& values) const {
  const model::Arm& arm = *task_.arm;
  model::BallState ball;
  ball.p_WBall = arm.p_WPoint(motion.q, task_.p_TBall);
  ball.v_WBall = arm.pointJacobian(motion.q, task_.p_TBall) * motion.qd;
  values.release_speed = ball.v_WBall.norm();
  const ThrowDirection direction = throwDirection(arm, motion, task_.p_TBall);
  double* c = values.inequalities.data() + kInequalities - 2;
  c[0] = square(direction.wrist_roll / task_.settings.wrist_limit) - 1;
  // Eq. (24): the hand falls behind the ball.
  const Eigen::Vector3d gravity(0, 0, -arm.parameters().gravity);
  const Eigen::Vector3d a_WHand =
      arm.pointAcceleration(motion.q, motion.qd, motion.qdd, task_.p_TBall);
  c[1] = 0.05 * (a_WHand - gravity).dot(direction.y_WH);
  // Eq. (25): the ball is released along the path of the hand, across the fingers.
  values.equalities.setZero();
  values.equalities[0] = ball.v_WBall.dot(arm.X_WT(motion.q).linear().col(2));
  if (!task_.must_land)
    return;
  const double k = task_.ball.dragPerMetre();
  const Eigen::Vector3d p_W = model::fly(ball, x[kFlightTime], k, arm.parameters().gravity).p_WBall;
  values.equalities[1] = task_.target.distance(p_W);
  values.equalities.tail<2>() = task_.target.planeCoordinates(p_W) - task_.aim;
}

SwingProblem::Values SwingProblem::evaluate(const SwingVector& x) const {
  Values values;
  const SwingCurve curve(x, elbow_sign_);
  const FollowThrough& follow = task_.settings.follow;
  const double begin = std::min(curve.begin(), -kDense - 0.05), end = follow.delay;
  double* c = values.inequalities.data();
  model::ArmMotion motion;
  for (int i = 0; i < kSwingSamples; ++i, c += kPerSample) {
    const double t = i < kEarlySamples
                         ? begin + (-kDense - begin) * i / kEarlySamples
                         : -kDense + (end + kDense) * (i - kEarlySamples) / (kLateSamples - 1);
    motion = curve.at(t, motion.q[2]);
    atSample(motion, true, c);
  }
  const model::ArmMotion from = motion;
  const double longest = follow.brake_time.maxCoeff();
  for (int i = 1; i <= kBrakeSamples; ++i, c += kPerSample) {
    atSample(follow.braked(from, longest * i / kBrakeSamples), false, c);
  }
  atRelease(x, curve.at(0), values);
  return values;
}

std::string SwingProblem::worstConstraint(const SwingVector& x) const {
  static constexpr const char* kNames[kPerSample] = {
      "the range of joint 1",
      "the speed limit of joint 1",
      "the range of joint 3",
      "the speed limit of joint 3",
      "the range of joint 4",
      "the speed limit of joint 4",
      "the distance of the elbow from its straight pose",
      "the torque limit of joint 1",
      "the torque limit of joints 2 and 3",
      "the torque limit of joint 4",
      "the clearance from column and floor"};
  const Values values = evaluate(x);
  int worst = 0;
  const double violation = values.inequalities.maxCoeff(&worst);
  const double miss = values.equalities.tail<3>().norm();
  if (miss > violation) {
    return fmt::format("misses it by {:.2g} m", miss);
  }
  const char* name = worst == kInequalities - 1   ? "Eq. (24): the hand must fall behind the ball"
                     : worst == kInequalities - 2 ? "the range of the wrist"
                                                  : kNames[worst % kPerSample];
  return fmt::format("breaks {} (by {:.2g} of it)", name, violation);
}

}  // namespace fastball::planner
