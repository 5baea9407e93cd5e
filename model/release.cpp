#include "model/release.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include "model/contact.h"
#include "model/grasp.h"

namespace fastball::model {
namespace {

// [s] before the command, in which ball and fingers find their balance
constexpr double kSettleTime = 0.06;
constexpr double kSettleDragTime = 0.03;   // [s] of that with the drag below; the rest without
constexpr double kSettleDrag = 500;        // [1/s], slows the ball in the hand while it settles
constexpr double kQuietTime = 3e-3;        // [s] without touch after which the ball has left
constexpr double kTouchForce = 1e-6;       // [N], less is rounding error, not touch
constexpr double kThumbTravel = M_PI / 2;  // [rad]; the open thumb stops out of the ball's way

constexpr int kPalm = kFingers;  // index of the palm among the things that can touch the ball
constexpr int kBodies = kFingers + 1;

/// How far [rad] and how fast [rad/s] the thumb has opened t [s] after the command.
struct Opening {
  double angle = 0, rate = 0;
};

Opening thumbOpening(const ReleaseCommand& command, double t) {
  const double moving = t - command.thumb_delay;
  if (!(moving > 0))
    return {};
  const double acceleration = command.thumb_acceleration, speed = command.thumb_speed;
  Opening opening{acceleration * moving * moving / 2, acceleration * moving};
  if (opening.rate > speed)
    opening = {speed * (moving - speed / acceleration / 2), speed};
  return opening.angle < kThumbTravel ? opening : Opening{kThumbTravel, 0};
}

/// Where a finger or the palm meets the ball; vectors in H.
struct Meeting {
  Eigen::Vector3d n_H = Eigen::Vector3d::UnitZ();  ///< from the body to the ball's centre
  double overlap = -1;                             ///< [m], of the undeformed shapes
};

Eigen::Vector3d nearestPoint(const Segment& segment, const Eigen::Vector3d& p) {
  const Eigen::Vector3d along = segment.p_end - segment.p_start;
  const double part = (p - segment.p_start).dot(along) / along.squaredNorm();
  return segment.p_start + std::clamp(part, 0.0, 1.0) * along;
}

Meeting meetFinger(const std::array<Segment, 2>& phalanges,
                   const Eigen::Vector3d& p_HBall,
                   double radii) {
  Meeting deepest;
  for (const Segment& phalanx : phalanges) {
    const Eigen::Vector3d offset = p_HBall - nearestPoint(phalanx, p_HBall);
    const double overlap = radii - offset.norm();
    if (overlap > deepest.overlap)
      deepest = {offset.normalized(), overlap};
  }
  return deepest;
}

/// Deformation y of the ball when it and a spring in series share the overlap: y + F(y) / stiffness
/// = overlap.
double sharedDeformation(const BallParameters& ball, double stiffness, double overlap) {
  if (!(overlap > 0))
    return overlap;
  double low = 0, high = overlap, y = overlap / 2;
  for (int i = 0; i < 60 && high - low > 1e-13; ++i) {
    const double error = y + elasticForce(ball, y) / stiffness - overlap;
    (error < 0 ? low : high) = y;
    const double newton = y - error / (1 + elasticStiffness(ball, y) / stiffness);
    const double next = newton > low && newton < high ? newton : (low + high) / 2;
    if (std::abs(next - y) < 1e-14)
      break;
    y = next;
  }
  return y;
}

/// The ball among the fingers of a moving hand.
class BallInHand {
 public:
  BallInHand(const BallParameters& ball,
             const Hand& hand,
             const ReleaseCommand& command,
             double gravity)
      : ball_(ball),
        hand_(hand),
        command_(command),
        gravity_(gravity),
        grasp_(grasp(ball, hand, command.grip_force)) {
    for (const Finger finger : {kFingerA, kThumb, kFingerB})
      phalanges_[finger] = hand.phalanges(finger, grasp_.q);
    const double azimuth = hand.parameters().azimuth[kThumb];
    thumb_axis_H_ =
        Eigen::Vector3d(std::cos(azimuth), std::sin(azimuth), 0).cross(Eigen::Vector3d::UnitZ());
  }

  /// At rest in the hand, at its nominal place.
  void place(const HandMotion& motion) {
    const Eigen::Vector3d arm = motion.X_WH.linear() * hand_.parameters().p_HBall;
    state_.p_WBall = motion.X_WH.translation() + arm;
    state_.v_WBall = motion.v_WH + motion.w_WH.cross(arm);
    w_WBall_ = motion.w_WH;
  }

  /// Advances by dt from time t (semi-implicit Euler); `drag` [1/s] against motion in the hand.
  /// @return whether something presses on the ball.
  bool step(const HandMotion& motion, double t, double dt, double drag) {
    moveThumb(t);
    const Eigen::Vector3d p_HBall = motion.X_WH.inverse() * state_.p_WBall;
    force_.setZero();
    moment_.setZero();
    bool touched = false;
    for (int body = 0; body < kBodies; ++body)
      touched |= touch(body, meet(body, p_HBall), motion, dt);
    const Eigen::Vector3d v_hand =
        motion.v_WH + motion.w_WH.cross(state_.p_WBall - motion.X_WH.translation());
    const Eigen::Vector3d a_drag = -drag * (state_.v_WBall - v_hand);
    const Eigen::Vector3d dw_drag = -drag * (w_WBall_ - motion.w_WH);
    state_.v_WBall += dt * (force_ / ball_.mass + a_drag +
                            flightAcceleration(state_.v_WBall, ball_.dragPerMetre(), gravity_));
    w_WBall_ += dt * (moment_ / ball_.inertia() + dw_drag);
    state_.p_WBall += dt * state_.v_WBall;
    return touched;
  }

  const BallState& state() const { return state_; }
  const Eigen::Vector3d& spin() const { return w_WBall_; }

 private:
  void moveThumb(double t) {
    const Opening opening = thumbOpening(command_, t);
    thumb_rate_ = opening.rate;
    HandVector q = grasp_.q;
    q[kProximalThumb] -= opening.angle;
    phalanges_[kThumb] = hand_.phalanges(kThumb, q);
  }

  Meeting meet(int body, const Eigen::Vector3d& p_HBall) const {
    const HandParameters& parameters = hand_.parameters();
    if (body != kPalm)
      return meetFinger(phalanges_[body], p_HBall, ball_.radius + parameters.finger_radius);
    if (p_HBall.head<2>().norm() > parameters.palm_radius)
      return {};
    return {Eigen::Vector3d::UnitZ(), ball_.radius + parameters.palm_distance - p_HBall.z()};
  }

  /// Velocity [m/s] in the world of the point of a body that lies at p_W.
  Eigen::Vector3d bodyVelocity(int body,
                               const HandMotion& motion,
                               const Eigen::Vector3d& p_W) const {
    Eigen::Vector3d v = motion.v_WH + motion.w_WH.cross(p_W - motion.X_WH.translation());
    if (body != kThumb)
      return v;
    const Eigen::Vector3d from_base = motion.X_WH.inverse() * p_W - phalanges_[kThumb][0].p_start;
    v += motion.X_WH.linear() * (-thumb_rate_ * thumb_axis_H_).cross(from_base);
    return v;
  }

  bool touch(int body, const Meeting& meeting, const HandMotion& motion, double dt) {
    double y = meeting.overlap, share = 1;
    const bool rear = body == kFingerA || body == kFingerB;
    if (rear && command_.finger_stiffness > 0) {
      // The drive of a rear finger carries the grip in its nominal place and gives way from there.
      const double slack = grasp_.fingers[body].force / command_.finger_stiffness;
      y = sharedDeformation(ball_, command_.finger_stiffness, meeting.overlap + slack);
      share = 1 / (1 + elasticStiffness(ball_, y) / command_.finger_stiffness);
    }
    const Eigen::Vector3d n_W = motion.X_WH.linear() * meeting.n_H;
    const Eigen::Vector3d arm = -(ball_.radius - y) * n_W;
    Eigen::Vector3d v =
        state_.v_WBall + w_WBall_.cross(arm) - bodyVelocity(body, motion, state_.p_WBall + arm);
    // In series with the finger the ball deforms at `share` of the speed, and of its damping force the finger passes on the same
    // share.
    v -= (1 - share * share) * n_W.dot(v) * n_W;
    const Eigen::Vector3d force = contacts_[body].step(ball_, n_W, y, v, dt);
    force_ += force;
    moment_ += arm.cross(force);
    return n_W.dot(force) > kTouchForce;
  }

  const BallParameters& ball_;
  const Hand& hand_;
  const ReleaseCommand& command_;
  double gravity_;
  GraspGeometry grasp_;
  std::array<std::array<Segment, 2>, kFingers> phalanges_;
  Eigen::Vector3d thumb_axis_H_;
  double thumb_rate_ = 0;
  std::array<Contact, kBodies> contacts_;
  BallState state_;
  Eigen::Vector3d w_WBall_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d force_ = Eigen::Vector3d::Zero(), moment_ = Eigen::Vector3d::Zero();
};

void requirePositive(double value, const char* name) {
  if (value > 0)
    return;
  std::ostringstream message;
  message << "release: " << name << " is " << value << ", it must be positive";
  throw std::invalid_argument(message.str());
}

}  // namespace

Departure predictDeparture(const BallParameters& ball,
                           const Hand& hand,
                           const ReleaseCommand& command,
                           const std::function<HandMotion(double)>& hand_at,
                           double gravity,
                           double time_step,
                           double max_time) {
  requirePositive(ball.mass, "the ball's mass [kg]");
  requirePositive(time_step, "the time step [s]");
  BallInHand held(ball, hand, command, gravity);
  held.place(hand_at(-kSettleTime));

  const auto settle_steps = std::lround(kSettleTime / time_step);
  const auto steps = settle_steps + std::lround(max_time / time_step);
  Departure last;  // at the last touch; without any touch before it, at the command
  bool touched_before = false;
  for (long i = 0; i < steps; ++i) {
    const double t = static_cast<double>(i - settle_steps) * time_step;
    if (i == settle_steps && !touched_before)
      last = {false, 0, held.state(), held.spin()};
    if (t >= 0 && t - last.time >= kQuietTime) {
      last.departed = true;
      return last;
    }
    const double drag = t < kSettleDragTime - kSettleTime ? kSettleDrag : 0;
    if (held.step(hand_at(t), t, time_step, drag)) {
      last = {false, t + time_step, held.state(), held.spin()};
      touched_before = true;
    }
  }
  return {false, max_time, held.state(), held.spin()};
}

}  // namespace fastball::model
