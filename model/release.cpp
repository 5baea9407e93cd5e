#include "model/release.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include "model/contact.h"
#include "model/finger_body.h"
#include "model/grasp.h"

namespace fastball::model {
namespace {

// [s] before the command, in which ball and fingers find their balance
constexpr double kSettleTime = 0.06;
constexpr double kSettleDragTime = 0.03;  // [s] of that with the drag below; the rest without
constexpr double kSettleDrag = 500;       // [1/s], slows the ball in the hand while it settles
constexpr double kQuietTime = 3e-3;       // [s] without touch after which the ball has left
constexpr double kTouchForce = 1e-6;      // [N], less is rounding error, not touch
constexpr double kTick = 1e-3;            // [s], the hand is commanded once a tick
constexpr double kWatchStep =
    5e-4;  // [s], while nothing is touched: the fingers' drives need no finer one

constexpr int kPalm = kFingers;  // index of the palm among the things that can touch the ball
constexpr int kBodies = kFingers + 1;

/// Where a finger or the palm meets the ball; vectors in H.
struct Meeting {
  Eigen::Vector3d n_H = Eigen::Vector3d::UnitZ();  ///< from the body to the ball's centre
  double overlap = -1;                             ///< [m], of the undeformed shapes
  int phalanx = 0;                                 ///< of the finger
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
  for (int i = 0; i < 2; ++i) {
    const Eigen::Vector3d offset = p_HBall - nearestPoint(phalanges[i], p_HBall);
    const double overlap = radii - offset.norm();
    if (overlap > deepest.overlap)
      deepest = {offset.normalized(), overlap, i};
  }
  return deepest;
}

/// The ball among the fingers of a moving hand.
class BallInHand {
 public:
  BallInHand(const BallParameters& ball,
             const Hand& hand,
             const ReleaseCommand& command,
             const HandSupport* support,
             double gravity)
      : ball_(ball),
        hand_(hand),
        command_(command),
        gravity_(gravity),
        grasp_(grasp(ball, hand, command.grip_force)),
        fingers_{body(kFingerA), body(kThumb), body(kFingerB)},
        release_(hand, grasp_, command.settings, command.mode),
        supported_(support) {
    targets_.q = grasp_.q;
    targets_.tau = grasp_.torques();
    targets_.kp = command.settings.kp;
    targets_.kd = command.settings.kd;
  }

  /// At rest in the hand, at its nominal place.
  void place(const HandMotion& motion) {
    const Eigen::Vector3d arm = motion.X_WH.linear() * hand_.parameters().p_HBall;
    state_.p_WBall = motion.X_WH.translation() + arm;
    state_.v_WBall = motion.v_WH + motion.w_WH.cross(arm);
    w_WBall_ = motion.w_WH;
  }

  /// What the fingers are told t [s] after the command.
  void command(double t) {
    HandVector q = targets_.q, qd = targets_.qd;
    for (const Finger finger : {kFingerA, kThumb, kFingerB}) {
      q.segment<2>(Hand::proximalJoint(finger)) = fingers_[finger].q();
      qd.segment<2>(Hand::proximalJoint(finger)) = fingers_[finger].qd();
    }
    FingerForces felt{};
    for (int i = 0; i < kFingers; ++i)
      felt[i] = felt_steps_ > 0 ? felt_[i] / felt_steps_ : 0;
    felt_ = {};
    felt_steps_ = 0;
    release_.step(std::llround(1e6 * t), q, qd, felt, targets_);
    released_ = true;
  }

  /// Advances by dt (semi-implicit Euler); `drag` [1/s] against motion in the hand.
  /// @return whether something presses on the ball.
  bool step(const HandMotion& planned, double dt, double drag) {
    const HandMotion motion = supported_.moved(planned);
    const Eigen::Vector3d p_HBall = motion.X_WH.inverse() * state_.p_WBall;
    force_.setZero();
    moment_.setZero();
    bool touched = false;
    for (int body = 0; body < kBodies; ++body)
      touched |= touch(body, meet(body, p_HBall), motion, dt);
    ++felt_steps_;
    moveHand(planned, motion, dt);
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

  /// The ball has left: all fingers open, t [s] after the command.
  void open(double t) { release_.open(std::llround(1e6 * t)); }

  const BallState& state() const { return state_; }
  const Eigen::Vector3d& spin() const { return w_WBall_; }

 private:
  FingerBody body(Finger finger) const {
    return FingerBody(hand_, finger, grasp_.q, grasp_.torques());
  }

  /// Fingers, and what carries the hand.
  void moveHand(const HandMotion& planned, const HandMotion& motion, double dt) {
    HandWrench load;
    for (FingerBody& finger : fingers_) {
      if (command_.ideal_drives) {
        finger.follow(targets_);
        continue;
      }
      finger.step(targets_, motion, gravity_, dt);
      load.force += finger.reaction().force;
      load.moment += finger.reaction().moment;
    }
    if (!released_)
      return;
    // The plan has the arm carry the ball as a part of the hand; the fingers carry it as it is.
    const Eigen::Matrix3d R_HW = motion.X_WH.linear().transpose();
    const Eigen::Vector3d& p_H = hand_.parameters().p_HBall;
    const Eigen::Vector3d r_W = planned.X_WH.linear() * p_H;
    const Eigen::Vector3d a_W = planned.a_WH + planned.dw_WH.cross(r_W) +
                                planned.w_WH.cross(planned.w_WH.cross(r_W)) +
                                gravity_ * Eigen::Vector3d::UnitZ();
    const Eigen::Vector3d missing = R_HW * (ball_.mass * a_W - force_);
    load.force += missing;
    load.moment += p_H.cross(missing);
    supported_.step(load, motion.X_WH.linear(), dt);
  }

  Meeting meet(int body, const Eigen::Vector3d& p_HBall) const {
    const HandParameters& parameters = hand_.parameters();
    const bool gone = command_.ideal_drives && released_ && body == kThumb &&
                      command_.mode == ReleaseMode::kAbrupt;
    if (gone)
      return {};
    if (body != kPalm) {
      return meetFinger(fingers_[body].phalanges(), p_HBall,
                        ball_.radius + parameters.finger_radius);
    }
    if (p_HBall.head<2>().norm() > parameters.palm_radius)
      return {};
    return {Eigen::Vector3d::UnitZ(), ball_.radius + parameters.palm_distance - p_HBall.z()};
  }

  bool touch(int body, const Meeting& meeting, const HandMotion& motion, double dt) {
    const Eigen::Matrix3d& R_WH = motion.X_WH.linear();
    const Eigen::Vector3d n_W = R_WH * meeting.n_H;
    const Eigen::Vector3d arm = -(ball_.radius - meeting.overlap) * n_W;
    const Eigen::Vector3d r_W = state_.p_WBall + arm - motion.X_WH.translation();
    const Eigen::Vector3d p_H = R_WH.transpose() * r_W;
    Eigen::Vector3d v_body = motion.v_WH + motion.w_WH.cross(r_W);
    if (body != kPalm)
      v_body += R_WH * fingers_[body].velocityAt(meeting.phalanx, p_H);
    const Eigen::Vector3d v = state_.v_WBall + w_WBall_.cross(arm) - v_body;
    const Eigen::Vector3d force = contacts_[body].step(ball_, n_W, meeting.overlap, v, dt);
    force_ += force;
    moment_ += arm.cross(force);
    if (body != kPalm) {
      felt_[body] += n_W.dot(force);
      fingers_[body].push(meeting.phalanx, p_H, -(R_WH.transpose() * force));
    }
    return n_W.dot(force) > kTouchForce;
  }

  const BallParameters& ball_;
  const Hand& hand_;
  const ReleaseCommand& command_;
  double gravity_;
  GraspGeometry grasp_;
  std::array<FingerBody, kFingers> fingers_;
  ReleaseMotion release_;
  JointTargets targets_;
  SupportedHand supported_;
  bool released_ = false;
  FingerForces felt_{};  ///< [N], sums since the last command
  int felt_steps_ = 0;
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

struct WatchedTime {
  double from, to, step;  ///< [s]
};

/// Time [s] at which the hand touches the free ball again, or a negative one. `tick`: steps between two commands.
double watch(BallInHand& held,
             const std::function<HandMotion(double)>& hand_at,
             const WatchedTime& time,
             long tick) {
  held.open(time.from);
  for (long i = 0;; ++i) {
    const double t = time.from + static_cast<double>(i) * time.step;
    if (t >= time.to)
      return -1;
    if (t >= 0 && i % tick == 0)
      held.command(t);
    if (held.step(hand_at(t), time.step, 0))
      return t;
  }
}

}  // namespace

Departure predictDeparture(const BallParameters& ball,
                           const Hand& hand,
                           const ReleaseCommand& command,
                           const std::function<HandMotion(double)>& hand_at,
                           double gravity,
                           const HandSupport* support,
                           double time_step,
                           double max_time,
                           double watch_time) {
  requirePositive(ball.mass, "the ball's mass [kg]");
  requirePositive(time_step, "the time step [s]");
  BallInHand held(ball, hand, command, support, gravity);
  held.place(hand_at(-kSettleTime));

  const auto settle_steps = std::lround(kSettleTime / time_step);
  const auto steps = settle_steps + std::lround(max_time / time_step);
  const auto tick = command.ideal_drives ? 1L : std::max(1L, std::lround(kTick / time_step));
  Departure last;  // at the last touch; without any touch before it, at the command
  bool touched_before = false;
  for (long i = 0; i < steps; ++i) {
    const double t = static_cast<double>(i - settle_steps) * time_step;
    if (i == settle_steps && !touched_before)
      last = {false, 0, held.state(), held.spin()};
    if (t >= 0 && t - last.time >= kQuietTime) {
      last.departed = true;
      last.touched_again = watch(held, hand_at, {t, last.time + watch_time, kWatchStep},
                                 std::lround(kTick / kWatchStep));
      return last;
    }
    if (i >= settle_steps && (i - settle_steps) % tick == 0)
      held.command(t);
    const double drag = t < kSettleDragTime - kSettleTime ? kSettleDrag : 0;
    if (held.step(hand_at(t), time_step, drag)) {
      last = {false, t + time_step, held.state(), held.spin()};
      touched_before = true;
    }
  }
  return {false, max_time, held.state(), held.spin()};
}

}  // namespace fastball::model
