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
                             ReleaseMode mode)
    : mode_(mode),
      settings_(settings),
      base_radius_(hand.parameters().base_radius),
      proximal_length_(hand.parameters().proximal_length),
      distance_(grasp.distances()),
      q_grasp_(grasp.q),
      tau_grasp_(grasp.torques()),
      q_open_(
          hand.posture(0,
                       0,
                       {settings.open_distance, settings.open_distance, settings.open_distance})),
      thumb_(settings.thumb, hand.parameters().finger_torque_max) {
  for (const Finger finger : kEachFinger)
    deformation_[finger] = grasp.fingers[finger].deformation;
}

void ReleaseMotion::open(int64_t t_us) {
  if (open_us_)
    return;
  JointTargets at;
  relax(1e-6 * static_cast<double>(t_us), at);
  path_ = JointPath(at.q, q_open_, t_us, settings_.clear_time);
  open_us_ = t_us;
}

void ReleaseMotion::step(int64_t t_us,
                         const HandVector& q,
                         const HandVector& qd,
                         const FingerForces& force,
                         JointTargets& targets) {
  constexpr int kJoints = kHandJoints - kSpreadA;
  if (smooth() && t_us >= microseconds(settings_.relax_time + settings_.open_delay))
    open(t_us);
  JointTargets own;
  own.kp = settings_.kp;
  own.kd = settings_.kd;
  if (open_us_) {
    const JointPath::Point point = path_.at(t_us);
    own.q = point.q;
    own.qd = point.qd;
  } else {
    relax(1e-6 * static_cast<double>(t_us), own);
  }
  const bool lost = *std::min_element(force.begin(), force.end()) < settings_.touch_force;
  thumb_opens_ = thumb_opens_ || !smooth() || open_us_ || (t_us > 0 && lost);
  if (thumb_opens_)
    openThumb(t_us, q, qd, own);
  targets.q.tail<kJoints>() = own.q.tail<kJoints>();
  targets.qd.tail<kJoints>() = own.qd.tail<kJoints>();
  targets.tau.tail<kJoints>() = own.tau.tail<kJoints>();
  targets.kp.tail<kJoints>() = own.kp.tail<kJoints>();
  targets.kd.tail<kJoints>() = own.kd.tail<kJoints>();
}

/// Of the fingers that still hold, t [s] after the command.
void ReleaseMotion::relax(double t, JointTargets& targets) const {
  const double s = t / settings_.relax_time;
  targets.q = q_grasp_;
  targets.qd.setZero();
  targets.tau = tau_grasp_;
  if (mode_ == ReleaseMode::kThumbFade) {
    const double left = 1 - smoothStep(s);
    targets.tau.segment<2>(kProximalThumb) *= left * left;
    targets.kp[kProximalThumb] = targets.kd[kProximalThumb] = 0;  // nothing but its force
  }
  if (mode_ != ReleaseMode::kSyncRetreat)
    return;
  const double way = settings_.retreat_ratio * smoothStep(s);
  const double rate = settings_.retreat_ratio * smoothStepRate(s) / settings_.relax_time;
  const double left = std::max(0.0, 1 - way);
  targets.tau *= left * left;
  for (const Finger finger : kEachFinger) {
    // As Hand::parallelFinger(): the distal phalanx stays parallel to z.
    const double inward =
        (base_radius_ - distance_[finger] - way * deformation_[finger]) / proximal_length_;
    const double angle = std::asin(std::clamp(inward, -1.0, 1.0));
    const double turning = -rate * deformation_[finger] / (proximal_length_ * std::cos(angle));
    const int proximal = Hand::proximalJoint(finger);
    targets.q.segment<2>(proximal) << angle, -angle;
    targets.qd.segment<2>(proximal) << turning, -turning;
  }
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
  targets.q[kDistalThumb] = q_grasp_[kDistalThumb];
  targets.qd[kDistalThumb] = targets.tau[kDistalThumb] = 0;
}

}  // namespace fastball::model
