#include "hand_server/opening_trial.h"

#include <algorithm>

#include "model/contact.h"

namespace fastball::hand_server {
namespace {

constexpr double kTick = 1e-3;  // [s]
/// Share of a joint's motion that its command must explain.
constexpr double kAlike = 0.9;

}  // namespace

DeadTimes promptFingers(const model::GraspGeometry& grasp,
                        const model::BallParameters& ball,
                        const model::HandVector& kp,
                        double actuator_lag) {
  DeadTimes late{};
  const model::HandVector tau = grasp.torques();
  for (const model::Finger finger : {model::kFingerA, model::kThumb, model::kFingerB}) {
    const int proximal = model::Hand::proximalJoint(finger);
    const model::FingerGrasp& pressed = grasp.fingers[finger];
    const double lever = tau[proximal] / pressed.force;
    const double k = model::elasticStiffness(ball, pressed.deformation) * lever * lever;
    late[finger] = kTick / 2 + actuator_lag * k / (kp[proximal] + k);
  }
  return late;
}

double OpeningTrial::way(double t) const {
  const double s = std::clamp(t / settings_.duration, 0.0, 1.0);
  return settings_.share * 16 * s * s * (1 - s) * (1 - s);
}

double OpeningTrial::rate(double t) const {
  const double s = std::clamp(t / settings_.duration, 0.0, 1.0);
  return settings_.share * 32 * s * (1 - s) * (1 - 2 * s) / settings_.duration;
}

void OpeningTrial::tell(double t, model::JointTargets& targets) const {
  for (const model::Finger finger : {model::kFingerA, model::kThumb, model::kFingerB})
    retreat_.tell(finger, way(t), rate(t), targets);
}

void OpeningTrial::feel(double t, const model::HandVector& q) {
  if (samples_ == kMostSamples)
    return;
  t_[samples_] = t;
  for (const model::Finger finger : {model::kFingerA, model::kThumb, model::kFingerB})
    q_[finger][samples_] = q[model::Hand::proximalJoint(finger)];
  ++samples_;
}

/// Share of the joint's variance that the command, so much later, explains; 0 if the joint moved the other way.
double OpeningTrial::likeness(model::Finger finger, double dead_time) const {
  double sum_w = 0, sum_q = 0, sum_ww = 0, sum_qq = 0, sum_wq = 0;
  const double q0 = q_[finger][0];
  for (int k = 0; k < samples_; ++k) {
    const double w = way(t_[k] - dead_time), q = q0 - q_[finger][k];
    sum_w += w;
    sum_q += q;
    sum_ww += w * w;
    sum_qq += q * q;
    sum_wq += w * q;
  }
  const double covariance = sum_wq - sum_w * sum_q / samples_;
  const double variances =
      (sum_ww - sum_w * sum_w / samples_) * (sum_qq - sum_q * sum_q / samples_);
  return covariance > 0 && variances > 0 ? covariance * covariance / variances : 0;
}

std::optional<DeadTimes> OpeningTrial::deadTimes() const {
  DeadTimes found{};
  for (const model::Finger finger : {model::kFingerA, model::kThumb, model::kFingerB}) {
    double best = 0;
    const auto search = [&](double from, double to, double step) {
      double likest = -1;
      for (double dead_time = from; dead_time <= to; dead_time += step) {
        const double alike = likeness(finger, dead_time);
        if (alike > likest) {
          likest = alike;
          best = dead_time;
        }
      }
      return likest;
    };
    search(0, settings_.longest, 1e-3);
    search(best - 1e-3, best + 1e-3, 1e-4);
    if (search(best - 1e-4, best + 1e-4, 1e-5) < kAlike)
      return {};
    found[finger] = std::max(best - prompt_[finger], 0.0);
  }
  return found;
}

}  // namespace fastball::hand_server
