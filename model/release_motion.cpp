#include "model/release_motion.h"

#include <algorithm>
#include <cmath>

namespace fastball::model {
namespace {

constexpr std::array<Finger, kFingers> kEachFinger{kFingerA, kThumb, kFingerB};

int64_t microseconds(double seconds) {
  return std::llround(1e6 * seconds);
}

/// s at which the quintic has gone `share` of its way.
double whereSmoothStepIs(double share) {
  double low = 0, high = 1;
  for (int i = 0; i < 40; ++i) {
    const double middle = (low + high) / 2;
    (smoothStep(middle) < share ? low : high) = middle;
  }
  return low;
}

}  // namespace

double smoothStep(double s) {
  s = std::clamp(s, 0.0, 1.0);
  return s * s * s * (10 - 15 * s + 6 * s * s);
}

double smoothStepRate(double s) {
  s = std::clamp(s, 0.0, 1.0);
  return 30 * s * s * (1 - 2 * s + s * s);
}

double ReleaseSettings::delayOf(ReleaseMode mode) const {
  constexpr double kAbruptDelay = 0.008;  // [s], of a foam ball under some newtons
  switch (mode) {
    case ReleaseMode::kAbrupt:
      return kAbruptDelay;
    case ReleaseMode::kThumbFade:
      return relax_time;
    case ReleaseMode::kSyncRetreat:
      break;
  }
  return relax_time * whereSmoothStepIs(1 / retreat_ratio);
}

ReleaseMotion::ReleaseMotion(const Hand& hand,
                             const GraspGeometry& grasp,
                             const ReleaseSettings& settings,
                             ReleaseMode mode,
                             const FingerTimes& later_us)
    : mode_(mode),
      settings_(settings),
      later_us_(later_us),
      retreat_(hand, grasp),
      q_open_(
          hand.posture(0,
                       0,
                       {settings.open_distance, settings.open_distance, settings.open_distance})),
      thumb_(settings.thumb, hand.parameters().finger_torque_max) {}

void ReleaseMotion::open(int64_t t_us) {
  if (open_us_)
    return;
  JointTargets at;
  at.q = retreat_.q_grasp();
  for (const Finger finger : kEachFinger)
    relax(finger, t_us, at);
  path_ = JointPath(at.q, q_open_, t_us, settings_.clear_time);
  open_us_ = t_us;
}

bool ReleaseMotion::thumbMustOpen(int64_t t_us, const FingerForces& force) const {
  const int64_t own_us = ownTime(kThumb, t_us);
  if (smooth()) {
    const bool lost = *std::min_element(force.begin(), force.end()) < settings_.touch_force;
    return (t_us > 0 && lost) || (open_us_ && own_us >= *open_us_);
  }
  return own_us >= 0;
}

void ReleaseMotion::step(int64_t t_us,
                         const HandVector& q,
                         const HandVector& qd,
                         const FingerForces& force,
                         JointTargets& targets) {
  constexpr int kJoints = kHandJoints - kSpreadA;
  if (smooth() && t_us >= microseconds(settings_.relax_time + settings_.open_delay))
    open(microseconds(settings_.relax_time + settings_.open_delay));
  JointTargets own;
  own.q = retreat_.q_grasp();
  own.tau = retreat_.tau_grasp();
  own.kp = settings_.kp;
  own.kd = settings_.kd;
  for (const Finger finger : kEachFinger) {
    const int64_t own_us = ownTime(finger, t_us);
    if (open_us_ && own_us >= *open_us_)
      follow(finger, own_us, own);
    else
      relax(finger, own_us, own);
  }
  thumb_opens_ = thumb_opens_ || thumbMustOpen(t_us, force);
  if (thumb_opens_)
    openThumb(t_us, q, qd, own);
  targets.q.tail<kJoints>() = own.q.tail<kJoints>();
  targets.qd.tail<kJoints>() = own.qd.tail<kJoints>();
  targets.tau.tail<kJoints>() = own.tau.tail<kJoints>();
  targets.kp.tail<kJoints>() = own.kp.tail<kJoints>();
  targets.kd.tail<kJoints>() = own.kd.tail<kJoints>();
}

/// Of one that still holds, at its own time [us].
void ReleaseMotion::relax(Finger finger, int64_t own_us, JointTargets& targets) const {
  const double s = 1e-6 * static_cast<double>(own_us) / settings_.relax_time;
  if (mode_ == ReleaseMode::kSyncRetreat) {
    retreat_.tell(finger, settings_.retreat_ratio * smoothStep(s),
                  settings_.retreat_ratio * smoothStepRate(s) / settings_.relax_time, targets);
  } else if (mode_ == ReleaseMode::kThumbFade && finger == kThumb && own_us >= 0) {
    const double left = 1 - smoothStep(s);
    targets.tau.segment<2>(kProximalThumb) *= left * left;
    targets.kp[kProximalThumb] = targets.kd[kProximalThumb] = 0;  // nothing but its force
  }
}

/// Of one that opens, at its own time [us].
void ReleaseMotion::follow(Finger finger, int64_t own_us, JointTargets& targets) const {
  const JointPath::Point point = path_.at(own_us);
  const auto [first, joints] = Hand::jointsOf(finger);
  targets.q.segment(first, joints) = point.q.segment(first, joints);
  targets.qd.segment(first, joints) = point.qd.segment(first, joints);
  targets.tau.segment(first, joints).setZero();
}

void ReleaseMotion::openThumb(int64_t t_us,
                              const HandVector& q,
                              const HandVector& qd,
                              JointTargets& targets) {
  const ThumbOpening::Drive drive = thumb_.step(t_us, q[kProximalThumb], qd[kProximalThumb]);
  targets.q[kProximalThumb] = drive.q;
  targets.qd[kProximalThumb] = drive.qd;
  targets.tau[kProximalThumb] = drive.tau;
  targets.kp[kProximalThumb] = drive.guided ? settings_.kp[kProximalThumb] : 0;
  targets.kd[kProximalThumb] = drive.guided ? settings_.kd[kProximalThumb] : 0;
  targets.q[kDistalThumb] = retreat_.q_grasp()[kDistalThumb];
  targets.qd[kDistalThumb] = targets.tau[kDistalThumb] = 0;
}

}  // namespace fastball::model
