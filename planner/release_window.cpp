#include "planner/release_window.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <optional>

#include "model/arm_derivatives.h"

namespace fastball::planner {
namespace {

constexpr double kPathAccuracy = 1e-12;  // [m], of the joints that follow the path
constexpr int kNewtonSteps = 8;
constexpr double kLeastPivot = 1e-3;  // [m^3], |det| of the Jacobian of joints 1, 2 and 4
constexpr double kFlightStep = 0.15;  // [s], as velocityToReach() takes them
constexpr double kShortest = 0.01;    // [s], time to go

using ByWindow3 = Eigen::Matrix<double, 3, kWindowParameters>;
using ByWindow1 = Eigen::Matrix<double, 1, kWindowParameters>;
constexpr int kStart = 0, kJoint3 = 5;

/// v(p, T), each call beginning where the last one ended.
class AimedVelocity {
 public:
  explicit AimedVelocity(const WindowTask& task) : task_(task) {}

  Eigen::Vector3d at(const Eigen::Vector3d& p_W, double T) {
    std::optional<Eigen::Vector3d> guess;
    if (T_ > 0)  // what a change of p and T does without drag
      guess = v_ - (p_W - p_W_ + (T - T_) * (v_ - task_.gravity * T_ * kUp)) / T_;
    v_ = model::velocityToReach(p_W, task_.p_WGoal, T, task_.drag_per_metre, task_.gravity, guess);
    p_W_ = p_W;
    T_ = T;
    return v_;
  }
  /// dv/dp at constant T [1/s] and dv/dT at constant p [m/s^2], about the last point asked for. Where the ball comes to moves
  /// with p as p does, with v as the flight says, and with T by the velocity there.
  struct Slopes {
    Eigen::Matrix3d by_position;
    Eigen::Vector3d by_time;
  };
  Slopes slopes() const {
    const model::FlightDerivatives flight =
        model::flyWithDerivatives({p_W_, v_}, T_, task_.drag_per_metre, task_.gravity, kFlightStep);
    const Eigen::Matrix3d by_position = -flight.dp_dv.inverse();
    return {by_position, by_position * flight.state.v_WBall};
  }

 private:
  const Eigen::Vector3d kUp = Eigen::Vector3d::UnitZ();
  const WindowTask& task_;
  Eigen::Vector3d p_W_, v_;
  double T_ = 0;
};

/// The path of the ball point, integrated with its derivatives.
class Path {
 public:
  Path(const WindowTask& task, const ReleaseWindow& window, bool with_slopes)
      : task_(task), window_(window), with_slopes_(with_slopes), velocity_(task) {
    p_W_ = task.arm->p_WPoint(window.q_start, task.p_TBall);
    v_W_ = velocity_.at(p_W_, window.time_to_go);
    if (!with_slopes_)
      return;
    p_slope_.setZero();
    p_slope_.leftCols<4>() = task.arm->pointJacobian(window.q_start, task.p_TBall);
    v_slope_ = velocitySlope(p_slope_, 0);
  }

  /// Runge-Kutta 4 from t to t + h. With the same stages the derivatives of the path are those of its integration.
  void advance(double t, double h) {
    const bool flying = window_.pace.isZero();
    const Eigen::Vector3d k1 = v_W_;
    const ByWindow3 s1 = v_slope_;
    ByWindow3 s2, s3, s4;
    const auto stage = [&](double part, const Eigen::Vector3d& k, const ByWindow3& s,
                           ByWindow3& slope) {
      const Eigen::Vector3d v = velocity_.at(p_W_ + part * h * k, timeToGo(t + part * h));
      if (with_slopes_)
        slope = velocitySlope(p_slope_ + part * h * s, t + part * h);
      return v;
    };
    if (flying && !with_slopes_) {
      const model::BallState ball =
          model::fly({p_W_, v_W_}, h, task_.drag_per_metre, task_.gravity);
      p_W_ = ball.p_WBall;
      v_W_ = ball.v_WBall;
      return;
    }
    const Eigen::Vector3d k2 = stage(0.5, k1, s1, s2);
    const Eigen::Vector3d k3 = stage(0.5, k2, s2, s3);
    const Eigen::Vector3d k4 = stage(1, k3, s3, s4);
    p_W_ += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
    v_W_ = velocity_.at(p_W_, timeToGo(t + h));
    if (!with_slopes_)
      return;
    p_slope_ += h / 6 * (s1 + 2 * s2 + 2 * s3 + s4);
    v_slope_ = velocitySlope(p_slope_, t + h);
  }

  double timeToGo(double t) const {
    return window_.time_to_go - t + t * (window_.pace[0] + pace(t)) / 2;
  }
  ByWindow1 timeToGoSlope(double t) const {
    ByWindow1 slope = ByWindow1::Zero();
    slope[kTimeToGo] = 1;
    slope[kPace + 1] = t * t / (2 * window_.length);
    slope[kPace] = t - slope[kPace + 1];
    return slope;
  }
  double pace(double t) const {
    return window_.pace[0] + (window_.pace[1] - window_.pace[0]) * t / window_.length;
  }
  model::BallState ball() const { return {p_W_, v_W_}; }
  const ByWindow3& positionSlope() const { return p_slope_; }
  const ByWindow3& velocitySlope() const { return v_slope_; }

  /// What the hand adds to the free ball's acceleration [m/s^2].
  Eigen::Vector3d push(double t) const {
    if (window_.pace.isZero())
      return Eigen::Vector3d::Zero();
    return pace(t) * velocity_.slopes().by_time;
  }
  /// Derivative of flightAcceleration() + push(), but for what drag does to that of dv/dT.
  ByWindow3 accelerationSlope(double t) {
    const double v = v_W_.norm(), T = timeToGo(t), k = task_.drag_per_metre;
    const Eigen::Matrix3d by_velocity =
        -k * (v * Eigen::Matrix3d::Identity() + v_W_ * v_W_.transpose() / v);
    ByWindow3 slope = by_velocity * v_slope_;
    const Eigen::Vector3d by_time = velocity_.slopes().by_time;
    slope.col(kPace) += (1 - t / window_.length) * by_time;
    slope.col(kPace + 1) += t / window_.length * by_time;
    // dv/dT = -v_land / T without drag.
    const ByWindow1 time_slope = timeToGoSlope(t);
    const Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
    slope += pace(t) / T * (-v_slope_ + (task_.gravity * up - by_time) * time_slope);
    return slope;
  }

 private:
  ByWindow3 velocitySlope(const ByWindow3& p_slope, double t) {
    const AimedVelocity::Slopes slopes = velocity_.slopes();
    return slopes.by_position * p_slope + slopes.by_time * timeToGoSlope(t);
  }

  const WindowTask& task_;
  const ReleaseWindow& window_;
  bool with_slopes_;
  AimedVelocity velocity_;
  Eigen::Vector3d p_W_, v_W_;
  ByWindow3 p_slope_ = ByWindow3::Zero(), v_slope_ = ByWindow3::Zero();
};

/// Joints 1, 2 and 4 to the path, joint 3 as given in `motion`. `inverse`: of the Jacobian of joints 1, 2 and 4.
bool followPath(const WindowTask& task,
                const model::BallState& ball,
                const Eigen::Vector3d& a_W,
                model::ArmMotion& motion,
                Eigen::Matrix3d& inverse) {
  const model::Arm& arm = *task.arm;
  for (int i = 0; i < kNewtonSteps; ++i) {
    const model::Jacobian J = arm.pointJacobian(motion.q, task.p_TBall);
    Eigen::Matrix3d J_124;
    J_124 << J.col(0), J.col(1), J.col(3);
    if (!(std::abs(J_124.determinant()) > kLeastPivot))
      return false;
    inverse = J_124.inverse();
    const Eigen::Vector3d gap = ball.p_WBall - arm.p_WPoint(motion.q, task.p_TBall);
    const Eigen::Vector3d step = inverse * gap;
    motion.q += Eigen::Vector4d(step[0], step[1], 0, step[2]);
    if (gap.norm() > kPathAccuracy)
      continue;
    const Eigen::Vector3d rate = inverse * (ball.v_WBall - J.col(2) * motion.qd[2]);
    motion.qd = {rate[0], rate[1], motion.qd[2], rate[2]};
    const Eigen::Vector4d joint3(0, 0, motion.qdd[2], 0);
    const Eigen::Vector3d bias = arm.pointAcceleration(motion.q, motion.qd, joint3, task.p_TBall);
    const Eigen::Vector3d acceleration = inverse * (a_W - bias);
    motion.qdd = {acceleration[0], acceleration[1], motion.qdd[2], acceleration[2]};
    return motion.qdd.allFinite();
  }
  return false;
}

/// Puts rows for joints 1, 2, 4 and 3 in their places.
void setJoints(Eigen::Ref<Eigen::Matrix<double, 4, kWindowParameters>> rows,
               const ByWindow3& joints_124,
               const ByWindow1& joint_3) {
  rows.row(0) = joints_124.row(0);
  rows.row(1) = joints_124.row(1);
  rows.row(2) = joint_3;
  rows.row(3) = joints_124.row(2);
}

/// Derivatives of a sample: of p = p(q), v = J qd, a = J qdd + dJ/dt qd, solved for joints 1, 2 and 4.
ByWindow sampleSlopes(const WindowTask& task,
                      Path& path,
                      const model::ArmMotion& motion,
                      const Eigen::Matrix3d& inverse,
                      double t) {
  const model::PointMotion point =
      task.arm->pointMotion(motion.q, motion.qd, motion.qdd, task.p_TBall);
  ByWindow1 q3 = ByWindow1::Zero(), qd3 = q3, qdd3 = q3;
  q3[kStart + 2] = 1;
  q3.segment<3>(kJoint3) << t, t * t / 2, t * t * t / 6;
  qd3.segment<3>(kJoint3) << 1, t, t * t / 2;
  qdd3.segment<3>(kJoint3) << 0, 1, t;
  const auto J_3 = point.J.col(2);
  ByWindow slopes;
  setJoints(slopes.topRows<4>(), inverse * (path.positionSlope() - J_3 * q3), q3);
  setJoints(slopes.middleRows<4>(4),
            inverse * (path.velocitySlope() - point.dv_dq * slopes.topRows<4>() - J_3 * qd3), qd3);
  setJoints(slopes.bottomRows<4>(),
            inverse * (path.accelerationSlope(t) - point.da_dq * slopes.topRows<4>() -
                       point.da_dqd * slopes.middleRows<4>(4) - J_3 * qdd3),
            qdd3);
  return slopes;
}

}  // namespace

bool windowMotion(const WindowTask& task,
                  const ReleaseWindow& window,
                  int steps,
                  WindowMotion& motion,
                  WindowSlopes* slopes) {
  motion = {};
  if (slopes != nullptr)
    *slopes = {};
  if (!(window.time_to_go > kShortest))
    return false;
  Path path(task, window, slopes != nullptr);
  model::ArmMotion arm;
  arm.q = window.q_start;
  const double h = window.length / steps;
  for (int i = 0; i <= steps; ++i) {
    const double t = i * h;
    if (!(path.timeToGo(t) > kShortest))
      return false;
    if (i > 0)
      path.advance(t - h, h);
    const model::BallState ball = path.ball();
    const Eigen::Vector3d push = path.push(t);
    const double rate = window.joint3[0], acceleration = window.joint3[1], jerk = window.joint3[2];
    arm.q[2] = window.q_start[2] + t * (rate + t * (acceleration / 2 + t * jerk / 6));
    arm.qd[2] = rate + t * (acceleration + t * jerk / 2);
    arm.qdd[2] = acceleration + t * jerk;
    Eigen::Matrix3d inverse;
    const Eigen::Vector3d free =
        model::flightAcceleration(ball.v_WBall, task.drag_per_metre, task.gravity);
    if (!followPath(task, ball, free + push, arm, inverse))
      return false;
    motion.samples.push_back(arm);
    motion.ball.push_back(ball);
    motion.residual = std::max(motion.residual, push.norm());
    if (slopes != nullptr) {
      slopes->samples.push_back(sampleSlopes(task, path, arm, inverse, t));
      slopes->v_WBall.push_back(path.velocitySlope());
    }
  }
  motion.time_to_go = path.timeToGo(window.length);
  if (slopes != nullptr)
    slopes->time_to_go = path.timeToGoSlope(window.length);
  return true;
}

}  // namespace fastball::planner
