#include "model/elastic_ball.h"

#include <algorithm>
#include <cmath>

#include "model/contact.h"
#include "model/event_integration.h"

namespace fastball::model {
namespace {

using Eigen::Vector3d;
using State = Eigen::VectorXd;

/// Entries of the state, in the world: place [m], velocity [m/s], spin [rad/s], work [J], a bristle [m] for each finger.
constexpr int kPlace = 0, kVelocity = 3, kSpin = 6, kWork = 9, kBristles = 10;
constexpr double kQuietTime = 3e-3;  // [s] without touch after which the ball has left
constexpr double kTouch = 1e-12;     // [m], a gap of rounding errors
constexpr double kStill = 1e-12;     // [m/s], a speed of rounding errors

/// One finger at one time.
struct Press {
  Vector3d n_W, arm_W;  ///< normal; contact point from the ball's centre
  double y = 0;         ///< [m]
  /// [N], Eq. (27) and damping, before it is kept from pulling; below zero also when apart.
  double push = 0;
  Vector3d friction_W = Vector3d::Zero();  ///< [N]
  Vector3d u_W;                            ///< [m/s], of the ball's material point on the finger's
  Vector3d bristle_rate_W = Vector3d::Zero();
  bool slipping = false;

  Vector3d force() const { return std::max(0.0, push) * n_W + friction_W; }
};

class ElasticBall {
 public:
  ElasticBall(const BallParameters& ball,
              const FingerPair& fingers,
              const HandPath& hand_at,
              const RollingTask& task)
      : ball_(ball),
        fingers_(fingers),
        surfaces_(fingers.surfaces(ball.radius)),
        hand_at_(hand_at),
        task_(task) {}

  ElasticMotion run(const ElasticStart& start) {
    double t = task_.t_start;
    State y = startState(start);
    bool touching = presses(t, y);
    leave(t, y);
    const int tip = static_cast<int>(surfaces_.size()) + 1;
    while (t < task_.t_end && !motion_.rolled_off &&
           (touching || t < motion_.t_release + kQuietTime)) {
      const double end_of_piece =
          touching ? task_.t_end : std::min(task_.t_end, motion_.t_release + kQuietTime);
      const EventEnd end = integrateToEvent(piece(touching), t, y, end_of_piece);
      t = end.t;
      y = end.y;
      if (end.event == 0 || touching)
        leave(t, y);
      if (end.event == 0)
        touching = !touching;
      if (end.event > 0 && end.event < tip)
        y.segment<3>(bristle(end.event - 1)).setZero();
      motion_.rolled_off = end.event == tip && touching;
    }
    motion_.released = motion_.rolled_off || (!touching && t >= motion_.t_release + kQuietTime);
    if (!motion_.released)
      leave(t, y);
    motion_.elastic.push_back(sampleAt(t, y));
    return std::move(motion_);
  }

 private:
  static int bristle(int finger) { return kBristles + 3 * finger; }

  State startState(const ElasticStart& start) const {
    const HandMotion hand = hand_at_(task_.t_start);
    const Eigen::Isometry3d X_WF = hand.X_WH * fingers_.X_HF;
    const Vector3d p_W = X_WF * start.p_FBall;
    State y = State::Zero(bristle(static_cast<int>(surfaces_.size())));
    y.segment<3>(kPlace) = p_W;
    y.segment<3>(kVelocity) = pointVelocity(hand, p_W) + X_WF.linear() * start.v_FBall;
    y.segment<3>(kSpin) = hand.w_WH + X_WF.linear() * start.w_F;
    return y;
  }

  /// Takes the ball as it is for how it leaves.
  void leave(double t, const State& y) {
    motion_.t_release = t;
    motion_.ball = {y.segment<3>(kPlace), y.segment<3>(kVelocity)};
    motion_.w_WBall = y.segment<3>(kSpin);
  }

  Press press(int finger, const HandMotion& hand, const State& state) const {
    const Vector3d p = state.segment<3>(kPlace), s = state.segment<3>(bristle(finger));
    const SurfaceMeeting meeting = meet(surfaces_[finger], hand.X_WH.inverse() * p);
    Press at;
    at.n_W = hand.X_WH.linear() * meeting.n_H;
    at.y = ball_.radius - meeting.distance;
    at.arm_W = -(ball_.radius - at.y) * at.n_W;
    at.u_W = state.segment<3>(kVelocity) + state.segment<3>(kSpin).cross(at.arm_W) -
             pointVelocity(hand, p + at.arm_W);
    const double dy = -at.n_W.dot(at.u_W);
    if (at.y <= 0) {
      at.push = ball_.youngs_modulus * ball_.radius * at.y;  // any measure of being apart
      return at;
    }
    const double stiffness = elasticStiffness(ball_, at.y);
    at.push = elasticForce(ball_, at.y) +
              2 * ball_.damping_ratio * std::sqrt(stiffness * ball_.mass) * dy;
    const Vector3d slip = at.u_W + dy * at.n_W;
    Vector3d pull = ball_.bristle_stiffness * s + ball_.bristle_damping * slip;
    const double limit = ball_.friction * std::max(0.0, at.push);
    at.slipping = pull.norm() > limit;
    if (at.slipping)
      pull *= limit / pull.norm();
    at.friction_W = -pull;
    // The normal turns with the hand, and as the ball moves about a round finger; the bristle stays across it.
    const Vector3d dn =
        hand.w_WH.cross(at.n_W) + normalRate(surfaces_[finger], hand, state, at.n_W);
    at.bristle_rate_W =
        (pull - ball_.bristle_stiffness * s) / ball_.bristle_damping - dn.dot(s) * at.n_W;
    return at;
  }

  /// dn/dt in the hand of a ball that moves about a round finger, turned into the world.
  Vector3d normalRate(const FingerSurface& surface,
                      const HandMotion& hand,
                      const State& state,
                      const Vector3d& n_W) const {
    if (surface.radius == 0)
      return Vector3d::Zero();
    const Vector3d p = state.segment<3>(kPlace);
    const Vector3d v = state.segment<3>(kVelocity) - pointVelocity(hand, p);
    const Vector3d axis_W = hand.X_WH.linear() * surface.direction_H;
    const Vector3d across = v - axis_W.dot(v) * axis_W - n_W.dot(v) * n_W;
    return across / n_W.dot(p - hand.X_WH * surface.p_H);
  }

  /// [N], of the finger that presses most.
  double push(double t, const State& y) const {
    const HandMotion hand = hand_at_(t);
    double most = press(0, hand, y).push;
    for (std::size_t i = 1; i < surfaces_.size(); ++i)
      most = std::max(most, press(static_cast<int>(i), hand, y).push);
    return most;
  }

  /// Whether a finger presses or is about to: touches a ball that comes nearer.
  bool presses(double t, const State& y) const {
    const HandMotion hand = hand_at_(t);
    bool any = false;
    for (std::size_t i = 0; i < surfaces_.size(); ++i) {
      const Press at = press(static_cast<int>(i), hand, y);
      any |= at.y > kTouch ? at.push > 0 : at.y > -kTouch && at.n_W.dot(at.u_W) < -kStill;
    }
    return any;
  }

  State rate(double t, const State& y) const {
    const HandMotion hand = hand_at_(t);
    const Vector3d v = y.segment<3>(kVelocity);
    State dy = State::Zero(y.size());
    dy.segment<3>(kPlace) = v;
    dy.segment<3>(kVelocity) = flightAcceleration(v, ball_.dragPerMetre(), task_.gravity);
    for (std::size_t i = 0; i < surfaces_.size(); ++i) {
      const Press at = press(static_cast<int>(i), hand, y);
      const Vector3d force = at.force();
      dy.segment<3>(kVelocity) += force / ball_.mass;
      dy.segment<3>(kSpin) += at.arm_W.cross(force) / ball_.inertia();
      dy[kWork] += force.dot(at.u_W);
      dy.segment<3>(bristle(static_cast<int>(i))) = at.bristle_rate_W;
    }
    return dy;
  }

  /// Until the last finger stops pressing or the first one starts (event 0), one comes apart (its number + 1), or the ball is at
  /// the fingertips (the event after those).
  EventTask piece(bool touching) {
    EventTask piece;
    piece.derivative = [this](double t, const State& y) { return rate(t, y); };
    piece.events = {
        [this, touching](double t, const State& y) { return touching ? push(t, y) : -push(t, y); }};
    for (std::size_t i = 0; i < surfaces_.size(); ++i) {
      piece.events.emplace_back([this, i](double t, const State& y) {
        return press(static_cast<int>(i), hand_at_(t), y).y;
      });
    }
    piece.events.emplace_back([this](double t, const State& y) {
      const Eigen::Isometry3d X_WF = hand_at_(t).X_WH * fingers_.X_HF;
      return task_.fingertip - (X_WF.inverse() * Vector3d(y.segment<3>(kPlace))).x();
    });
    piece.sample = [this](double t, const State& y) { motion_.elastic.push_back(sampleAt(t, y)); };
    piece.sample_step = task_.sample_step;
    piece.tolerance = task_.tolerance;
    return piece;
  }

  ElasticSample sampleAt(double t, const State& y) const {
    const HandMotion hand = hand_at_(t);
    const Eigen::Isometry3d X_WF = hand.X_WH * fingers_.X_HF;
    const Vector3d p = y.segment<3>(kPlace);
    ElasticSample sample;
    sample.t = t;
    sample.p_FBall = X_WF.inverse() * p;
    sample.v_FBall = X_WF.linear().transpose() * (y.segment<3>(kVelocity) - pointVelocity(hand, p));
    sample.work = y[kWork];
    for (std::size_t i = 0; i < surfaces_.size(); ++i) {
      const Press at = press(static_cast<int>(i), hand, y);
      sample.force_F += X_WF.linear().transpose() * at.force();
      sample.slipping |= at.slipping && at.push > 0;
      sample.normal.push_back(std::max(0.0, at.push));
      sample.deformation.push_back(at.y);
      const Vector3d s = y.segment<3>(bristle(static_cast<int>(i)));
      sample.stored += elasticEnergy(ball_, at.y) + ball_.bristle_stiffness * s.squaredNorm() / 2;
    }
    return sample;
  }

  const BallParameters& ball_;
  const FingerPair& fingers_;
  std::vector<FingerSurface> surfaces_;
  const HandPath& hand_at_;
  const RollingTask& task_;
  ElasticMotion motion_;
};

}  // namespace

ElasticMotion elasticOnFingers(const BallParameters& ball,
                               const FingerPair& fingers,
                               const HandPath& hand_at,
                               const ElasticStart& start,
                               const RollingTask& task) {
  requireRolling(ball, task);
  requireElastic(ball);
  return ElasticBall(ball, fingers, hand_at, task).run(start);
}

}  // namespace fastball::model
