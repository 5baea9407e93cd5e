#include "hand_server/grip_preparation.h"

namespace fastball::hand_server {

GripPreparation::GripPreparation(const PlannedGrasp& planned,
                                 const model::Hand& hand,
                                 const model::BallParameters& ball,
                                 const HandServerConfig& config,
                                 int64_t since)
    : hand_(hand),
      ball_(ball),
      grasp_time_(config.grasp_time),
      settle_time_(config.settle_time),
      trial_settings_(config.trial),
      kp_(config.release.kp),
      since_(since),
      tries_(planned.plan.adapts && config.release_by == ReleaseBy::kPlanTime),
      settling_(planned.geometry, ball, hand.parameters(), config.settle_constant) {}

double GripPreparation::closed(int64_t utime) const {
  return 1e-6 * static_cast<double>(utime - since_) - grasp_time_;
}

void GripPreparation::step(const HandSample& sample, double dt, double to_swing) {
  feeling_.step(sample, dt);
  if (closed(sample.utime) < settle_time_)
    settling_.step(sample.force, closed(sample.utime) < 0, dt);
  else
    tryOpening(sample, to_swing);
}

void GripPreparation::tryOpening(const HandSample& sample, double to_swing) {
  if (tries_ && closed(sample.utime) >= trial_settings_.begin) {
    tries_ = false;
    trying_ = to_swing > trial_settings_.length();
    trial_begin_ = closed(sample.utime);
    trial_ = OpeningTrial(model::FingerRetreat(hand_, settled()), trial_settings_,
                          promptFingers(settled(), ball_, kp_, hand_.parameters().actuator_lag));
  }
  if (!trying_)
    return;
  trial_.feel(trialTime(sample.utime), sample.q);
  if (trialTime(sample.utime) >= trial_settings_.length()) {
    trying_ = false;
    dead_times_ = trial_.deadTimes();
    feeling_ = {};  // the trial was no rest
  }
}

void GripPreparation::apply(int64_t utime, model::JointTargets& targets) const {
  settling_.apply(targets.q);
  if (trying_)
    trial_.tell(trialTime(utime), targets);
}

std::optional<GripEstimate> GripPreparation::estimate(const Eigen::Vector3d& g_H) const {
  if (trying_)
    return {};
  return feeling_.estimate(hand_, ball_, g_H);
}

}  // namespace fastball::hand_server
