#include "model/rolling_ball_3d.h"

#include <Eigen/QR>

#include "model/event_integration.h"

namespace fastball::model {
namespace {

using Eigen::Vector3d;

/// Entries of the state, in the world: place [m], velocity [m/s], spin [rad/s].
constexpr int kPlace = 0, kVelocity = 3, kSpin = 6, kEntries = 9;
/// Sliding slower than this [m/s] is the beginning or the end of it.
constexpr double kNoSlip = 1e-6;

/// Where the ball touches one surface.
struct Touch {
  Vector3d n_W, arm_W;  ///< normal; contact point from the ball's centre
  Vector3d u_W;         ///< velocity of the ball's surface on the finger's
  Vector3d du_W;        ///< its derivative were there no contact forces
  Vector3d dn_W;        ///< of the normal
};

class RollingBall3d {
 public:
  RollingBall3d(const BallParameters& ball,
                const FingerPair& fingers,
                const HandPath& hand_at,
                const RollingTask& task)
      : ball_(ball),
        fingers_(fingers),
        surfaces_(fingers.surfaces(ball.radius)),
        hand_at_(hand_at),
        task_(task) {}

  RollingMotion run() {
    double t = task_.t_start;
    const HandMotion hand = hand_at_(t);
    const Vector3d p_W = hand.X_WH * fingers_.X_HF.translation();
    Eigen::VectorXd y(kEntries);
    y << p_W, pointVelocity(hand, p_W), hand.w_WH;
    bool on = normalForce(t, y) > 0;
    begin(t, y);
    while (on && t < task_.t_end) {
      const EventEnd end = integrateToEvent(piece(), t, y, task_.t_end);
      t = end.t;
      y = end.y;
      on = end.event < 0 || end.event == 2;
      motion_.rolled_off = end.event == 1;
      if (end.event == 2)
        begin(t, y);
    }
    motion_.released = !on;
    motion_.t_release = t;
    motion_.samples.push_back(sampleAt(t, y));
    motion_.ball = {y.segment<3>(kPlace), y.segment<3>(kVelocity)};
    motion_.w_WBall = y.segment<3>(kSpin);
    return std::move(motion_);
  }

 private:
  bool canSlide() const { return surfaces_.size() == 1; }

  std::vector<Touch> touches(const HandMotion& hand, const Eigen::VectorXd& y) const {
    const Vector3d p = y.segment<3>(kPlace), v = y.segment<3>(kVelocity), w = y.segment<3>(kSpin);
    const Vector3d dv = flightAcceleration(v, ball_.dragPerMetre(), task_.gravity);
    std::vector<Touch> result;
    for (const FingerSurface& surface : surfaces_) {
      Touch touch;
      touch.n_W = hand.X_WH.linear() * meet(surface, hand.X_WH.inverse() * p).n_H;
      touch.arm_W = -ball_.radius * touch.n_W;
      const Vector3d p_C = p + touch.arm_W;
      touch.u_W = v + w.cross(touch.arm_W) - pointVelocity(hand, p_C);
      // The normal is fixed in the hand: the ball moves along planes and along the groove only.
      touch.dn_W = hand.w_WH.cross(touch.n_W);
      const Vector3d arm_dot = -ball_.radius * touch.dn_W;
      const Vector3d a_hand = hand.a_WH + hand.dw_WH.cross(p_C - hand.X_WH.translation()) +
                              hand.w_WH.cross(v + arm_dot - hand.v_WH);
      touch.du_W = dv + w.cross(arm_dot) - a_hand;
      result.push_back(touch);
    }
    return result;
  }

  /// What a force at one touch adds to du/dt at another.
  Eigen::Matrix3d response(const Touch& to, const Touch& from) const {
    const auto cross = [](const Vector3d& a) {
      Eigen::Matrix3d m;
      m << 0, -a.z(), a.y(), a.z(), 0, -a.x(), -a.y(), a.x(), 0;
      return m;
    };
    return Eigen::Matrix3d::Identity() / ball_.mass -
           cross(to.arm_W) * cross(from.arm_W) / ball_.inertia();
  }

  /// Forces that keep every u as it is; among those of two fingers the smallest.
  std::vector<Vector3d> rollingForces(const std::vector<Touch>& at) const {
    const auto n = static_cast<Eigen::Index>(3 * at.size());
    Eigen::MatrixXd A(n, n);
    Eigen::VectorXd b(n);
    for (std::size_t i = 0; i < at.size(); ++i) {
      b.segment<3>(3 * static_cast<Eigen::Index>(i)) = -at[i].du_W;
      for (std::size_t j = 0; j < at.size(); ++j)
        A.block<3, 3>(3 * static_cast<Eigen::Index>(i), 3 * static_cast<Eigen::Index>(j)) =
            response(at[i], at[j]);
    }
    const Eigen::VectorXd f = A.completeOrthogonalDecomposition().solve(b);
    std::vector<Vector3d> forces;
    for (std::size_t i = 0; i < at.size(); ++i)
      forces.push_back(f.segment<3>(3 * static_cast<Eigen::Index>(i)));
    return forces;
  }

  /// On a plane: the force that keeps the ball on it, d(n.u)/dt = 0, and resists the slip.
  Vector3d slidingForce(const Touch& at) const {
    const double speed = at.u_W.norm();
    const Vector3d direction = speed > kNoSlip ? Vector3d(at.u_W / speed) : first_slip_W_;
    const Vector3d per_newton = at.n_W - ball_.friction * direction;
    return -(at.n_W.dot(at.du_W) + at.dn_W.dot(at.u_W)) /
           at.n_W.dot(response(at, at) * per_newton) * per_newton;
  }

  std::vector<Vector3d> forces(const std::vector<Touch>& at) const {
    return slides_ ? std::vector<Vector3d>{slidingForce(at[0])} : rollingForces(at);
  }

  /// mu N less the friction that rolling needs [N]; on a plane.
  double rollingMargin(const std::vector<Touch>& at) const {
    const Vector3d f = rollingForces(at)[0];
    const double normal = at[0].n_W.dot(f);
    return ball_.friction * normal - (f - normal * at[0].n_W).norm();
  }

  double normalForce(double t, const Eigen::VectorXd& y) const {
    const HandMotion hand = hand_at_(t);
    return (hand.X_WH.linear() * fingers_.X_HF.linear().col(1)).dot(sum(forces(touches(hand, y))));
  }

  static Vector3d sum(const std::vector<Vector3d>& forces) {
    Vector3d total = Vector3d::Zero();
    for (const Vector3d& force : forces)
      total += force;
    return total;
  }

  void begin(double t, const Eigen::VectorXd& y) {
    if (!canSlide())
      return;
    const std::vector<Touch> at = touches(hand_at_(t), y);
    slides_ = rollingMargin(at) <= 0;
    if (!slides_)
      return;
    const Vector3d f = rollingForces(at)[0];
    first_slip_W_ = -(f - at[0].n_W.dot(f) * at[0].n_W).normalized();
    if (motion_.t_slip < 0)
      motion_.t_slip = t;
  }

  Eigen::VectorXd rate(double t, const Eigen::VectorXd& y) const {
    const std::vector<Touch> at = touches(hand_at_(t), y);
    const std::vector<Vector3d> f = forces(at);
    const Vector3d v = y.segment<3>(kVelocity);
    Vector3d dv = flightAcceleration(v, ball_.dragPerMetre(), task_.gravity);
    Vector3d dw = Vector3d::Zero();
    for (std::size_t i = 0; i < at.size(); ++i) {
      dv += f[i] / ball_.mass;
      dw += at[i].arm_W.cross(f[i]) / ball_.inertia();
    }
    Eigen::VectorXd dy(kEntries);
    dy << v, dv, dw;
    return dy;
  }

  /// Until the ball leaves (event 0), comes to the fingertips (event 1), or slips or stops slipping (event 2).
  EventTask piece() {
    EventTask piece;
    piece.derivative = [this](double t, const Eigen::VectorXd& y) { return rate(t, y); };
    piece.events = {[this](double t, const Eigen::VectorXd& y) { return normalForce(t, y); },
                    [this](double t, const Eigen::VectorXd& y) {
                      const Eigen::Isometry3d X_WF = hand_at_(t).X_WH * fingers_.X_HF;
                      return task_.fingertip -
                             (X_WF.inverse() * Vector3d(y.segment<3>(kPlace))).x();
                    }};
    if (canSlide()) {
      piece.events.push_back([this](double t, const Eigen::VectorXd& y) {
        const std::vector<Touch> at = touches(hand_at_(t), y);
        return slides_ ? at[0].u_W.norm() - kNoSlip : rollingMargin(at);
      });
    }
    piece.sample = [this](double t, const Eigen::VectorXd& y) {
      motion_.samples.push_back(sampleAt(t, y));
    };
    piece.sample_step = task_.sample_step;
    piece.tolerance = task_.tolerance;
    return piece;
  }

  RollingSample sampleAt(double t, const Eigen::VectorXd& y) const {
    const HandMotion hand = hand_at_(t);
    const Vector3d p_W = y.segment<3>(kPlace), v_W = y.segment<3>(kVelocity);
    const Eigen::Matrix3d R_FW = (hand.X_WH.linear() * fingers_.X_HF.linear()).transpose();
    return {t, (hand.X_WH * fingers_.X_HF).inverse() * p_W, R_FW * (v_W - pointVelocity(hand, p_W)),
            R_FW * sum(forces(touches(hand, y))), slides_};
  }

  const BallParameters& ball_;
  const FingerPair& fingers_;
  std::vector<FingerSurface> surfaces_;
  const HandPath& hand_at_;
  const RollingTask& task_;
  bool slides_ = false;
  Vector3d first_slip_W_ = Vector3d::Zero();
  RollingMotion motion_;
};

}  // namespace

RollingMotion rollOnFingers3d(const BallParameters& ball,
                              const FingerPair& fingers,
                              const HandPath& hand_at,
                              const RollingTask& task) {
  requireRolling(ball, task);
  return RollingBall3d(ball, fingers, hand_at, task).run();
}

}  // namespace fastball::model
