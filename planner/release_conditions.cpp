#include "planner/release_conditions.h"

#include "planner/held_ball.h"

namespace fastball::planner {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kLeadScale = 0.05;   // [s^2/m]
constexpr double kFlightStep = 0.05;  // [s], right to a micrometre

/// Hand and ball at the release, with derivatives.
class Release {
 public:
  Release(const SwingTask& task, const SwingVector& x, const model::ArmMotion& motion)
      : arm_(*task.arm),
        motion_(motion),
        held_(*task.hand, x[kWristRoll], x[kWristFlexion]),
        R_WT_(arm_.X_WT(motion.q).linear()),
        axes_W_(arm_.rotationJacobian(motion.q)),
        ball_(arm_.pointMotion(motion.q, motion.qd, motion.qdd, held_.p_TBall)),
        g_W_(0, 0, -arm_.parameters().gravity) {
    for (int i = 0; i < model::kArmJoints; ++i) {
      const Vector3d axis = axes_W_.col(i);
      dw_W_ += axis * motion.qdd[i] + w_W_.cross(axis) * motion.qd[i];
      w_W_ += axis * motion.qd[i];
    }
  }

  const model::PointMotion& ball() const { return ball_; }
  Vector3d handAxis(int k) const { return R_WT_ * held_.R_TH.col(k); }
  double speedAlong(int k) const { return handAxis(k).dot(ball_.v); }
  double lead() const { return kLeadScale * handAxis(1).dot(ball_.a - g_W_); }

  /// A number's derivatives by the arm's motion and the wrist's angles.
  struct Gradient {
    MotionGradient motion;
    double roll = 0, flexion = 0;
  };
  /// Of by_p . p + by_v . v + by_a . a, with constant factors.
  Gradient ballGradient(const Vector3d& by_p, const Vector3d& by_v, const Vector3d& by_a) const {
    Gradient g;
    g.motion.q = ball_.J.transpose() * by_p + ball_.dv_dq.transpose() * by_v +
                 ball_.da_dq.transpose() * by_a;
    g.motion.qd = ball_.J.transpose() * by_v + ball_.da_dqd.transpose() * by_a;
    g.motion.qdd = ball_.J.transpose() * by_a;
    const auto byShift = [&](const Vector3d& p_T) {
      const Vector3d d = R_WT_ * p_T;
      return by_p.dot(d) + by_v.dot(w_W_.cross(d)) +
             by_a.dot(dw_W_.cross(d) + w_W_.cross(w_W_.cross(d)));
    };
    g.roll = byShift(held_.p_by_roll);
    g.flexion = byShift(held_.p_by_flexion);
    return g;
  }
  /// Adds that of (axis k of H) . u, u constant.
  void addAxisGradient(int k, const Vector3d& u, Gradient& g) const {
    const Vector3d e = handAxis(k);
    for (int i = 0; i < model::kArmJoints; ++i)
      g.motion.q[i] += axes_W_.col(i).cross(e).dot(u);
    g.roll += u.dot(R_WT_ * held_.R_by_roll.col(k));
    g.flexion += u.dot(R_WT_ * held_.R_by_flexion.col(k));
  }
  Gradient speedAlongGradient(int k) const {
    Gradient g = ballGradient(Vector3d::Zero(), handAxis(k), Vector3d::Zero());
    addAxisGradient(k, ball_.v, g);
    return g;
  }
  Gradient leadGradient() const {
    Gradient g = ballGradient(Vector3d::Zero(), Vector3d::Zero(), kLeadScale * handAxis(1));
    addAxisGradient(1, kLeadScale * (ball_.a - g_W_), g);
    return g;
  }

 private:
  const model::Arm& arm_;
  const model::ArmMotion& motion_;
  HeldBall held_;
  Matrix3d R_WT_;
  model::Jacobian axes_W_;
  model::PointMotion ball_;
  Vector3d g_W_, w_W_ = Vector3d::Zero(), dw_W_ = Vector3d::Zero();
};

/// Rows: the numbers that the landing's equalities are made of, by the ball's position.
Matrix3d targetAxes(const model::Target& target) {
  Matrix3d axes;
  axes << target.n_WTarget.transpose(), target.rightAxis().transpose(), target.upAxis().transpose();
  return axes;
}

SwingVector pulled(const Release::Gradient& g, const SwingDerivatives& at_release) {
  SwingVector gradient = SwingVector::Zero();
  at_release.pull(g.motion, gradient);
  gradient[kWristRoll] = g.roll;
  gradient[kWristFlexion] = g.flexion;
  return gradient;
}

}  // namespace

model::FlightDerivatives ReleaseConditions::flight(const model::PointMotion& ball,
                                                   double duration) const {
  return model::flyWithDerivatives({ball.p, ball.v}, duration, task_.ball.dragPerMetre(),
                                   task_.arm->parameters().gravity, kFlightStep);
}

ReleaseConditions::Values ReleaseConditions::values(const SwingVector& x,
                                                    const model::ArmMotion& motion) const {
  const Release release(task_, x, motion);
  const model::PointMotion& ball = release.ball();
  Values values;
  values.speed = ball.v.norm();
  values.hand_lead = release.lead();
  values.equalities.setZero();
  values.equalities[0] = release.speedAlong(0);
  values.equalities[1] = release.speedAlong(2);
  if (task_.must_land) {
    const model::BallState end = flight(ball, x[kFlightTime]).state;
    const Vector3d& p_W = end.p_WBall;
    values.grazing = task_.steepness + task_.target.n_WTarget.dot(end.v_WBall.normalized());
    values.equalities[2] = task_.target.distance(p_W);
    values.equalities.tail<2>() = task_.target.planeCoordinates(p_W) - task_.aim;
  }
  return values;
}

ReleaseConditions::Gradients ReleaseConditions::gradients(
    const SwingVector& x,
    const SwingDerivatives& at_release) const {
  const model::ArmMotion motion = at_release.motion();
  const Release release(task_, x, motion);
  const model::PointMotion& ball = release.ball();
  Gradients result;
  result.speed = pulled(
      release.ballGradient(Vector3d::Zero(), ball.v.normalized(), Vector3d::Zero()), at_release);
  result.hand_lead = pulled(release.leadGradient(), at_release);
  result.grazing.setZero();
  result.equalities.setZero();
  result.equalities.row(0) = pulled(release.speedAlongGradient(0), at_release);
  result.equalities.row(1) = pulled(release.speedAlongGradient(2), at_release);
  if (task_.must_land) {
    const model::FlightDerivatives end = flight(ball, x[kFlightTime]);
    const Matrix3d axes = targetAxes(task_.target);
    for (int k = 0; k < 3; ++k) {
      const Vector3d by_p = axes.row(k).transpose();
      SwingVector row = pulled(
          release.ballGradient(by_p, end.dp_dv.transpose() * by_p, Vector3d::Zero()), at_release);
      row[kFlightTime] = by_p.dot(end.state.v_WBall);
      result.equalities.row(kDirectionEqualities + k) = row;
    }
    const Vector3d &v_land = end.state.v_WBall, n = task_.target.n_WTarget;
    const Vector3d e = v_land.normalized();
    const Vector3d by_v = (n - n.dot(e) * e) / v_land.norm();
    result.grazing = pulled(
        release.ballGradient(Vector3d::Zero(), end.dv_dv.transpose() * by_v, Vector3d::Zero()),
        at_release);
    result.grazing[kFlightTime] = by_v.dot(model::flightAcceleration(
        v_land, task_.ball.dragPerMetre(), task_.arm->parameters().gravity));
  }
  return result;
}

}  // namespace fastball::planner
