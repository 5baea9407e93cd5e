#include "hand_server/grip_preparation.h"

#include <utility>

namespace fastball::hand_server {
namespace {

/// [s] before a plan starts, in which the hand says how the ball lies: 20 ticks, of which one must be heard.
constexpr double kGripTime = 0.02;

}  // namespace

GripPreparation::GripPreparation(std::shared_ptr<const PlannedGrasp> planned,
                                 const model::Arm& arm,
                                 const model::Hand& hand,
                                 const model::BallParameters& ball,
                                 const HandServerConfig& config,
                                 int64_t since)
    : planned_(std::move(planned)),
      arm_(arm),
      hand_(hand),
      ball_(ball),
      grasp_time_(config.grasp_time),
      settle_time_(config.settle_time),
      trial_settings_(config.trial),
      kp_(config.release.kp),
      since_(since),
      tries_(planned_->plan.adapts && config.release_by == ReleaseBy::kPlanTime),
      settling_(planned_->geometry, ball, hand.parameters(), config.settle_constant) {}

double GripPreparation::closed(int64_t utime) const {
  return 1e-6 * static_cast<double>(utime - since_) - grasp_time_;
}

void GripPreparation::step(const HandSample& sample, double dt, double t) {
  feeling_.step(sample, dt);
  if (closed(sample.utime) < settle_time_)
    settling_.step(sample.force, closed(sample.utime) < 0, dt);
  else
    tryOpening(sample, t);
  if (planned_->plan.adapts && !at_rest_ && t >= -kGripTime && t < 0)
    at_rest_ = estimate(t);
}

void GripPreparation::tryOpening(const HandSample& sample, double t) {
  if (tries_ && closed(sample.utime) >= trial_settings_.begin) {
    tries_ = false;
    trying_ = planned_->plan.t_swing - t > trial_settings_.length();
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

std::optional<GripEstimate> GripPreparation::estimate(double t) const {
  if (trying_)
    return {};
  const HandPlan& plan = planned_->plan;
  const Eigen::Matrix3d R_WH =
      arm_.X_WT(plan.arm.at(t).q).linear() * hand_.X_TH(plan.q_wrist[0], plan.q_wrist[1]).linear();
  return feeling_.estimate(hand_, ball_, -arm_.parameters().gravity * R_WH.transpose().col(2));
}

}  // namespace fastball::hand_server
