#include "controller/arm_controller.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace fastball::controller {
namespace {

constexpr int64_t kTickUs = 1000;

/// Divided, not multiplied: the quotient is the number that a time in seconds is written as.
double seconds(int64_t us) {
  return static_cast<double>(us) / 1e6;
}

bool operator==(const ThrowOrder& a, const ThrowOrder& b) {
  return a.plan_id == b.plan_id && a.scene_id == b.scene_id && a.start_utime == b.start_utime;
}

/// Falls smoothly from 1 to 0 as s goes from 0 to 1, with two continuous derivatives: value and derivatives by s.
Eigen::Vector3d fade(double s) {
  if (s <= 0)
    return {1, 0, 0};
  if (s >= 1)
    return {0, 0, 0};
  const double s2 = s * s;
  return {1 - s2 * s * (10 - 15 * s + 6 * s2), -30 * s2 * (1 - 2 * s + s2),
          -60 * s * (1 - 3 * s + 2 * s2)};
}

}  // namespace

ArmController::ArmController(const model::Arm& arm,
                             const model::Hand& hand,
                             const model::BallParameters& ball,
                             const ControllerConfig& config)
    : arm_(arm),
      config_(config),
      law_(arm, config.kp, config.kd),
      grip_correction_(arm, hand, ball),
      stop_(arm, config.brake_share) {}

bool ArmController::offerPlan(Plan plan) {
  if (plan_ && *plan_ == plan) {
    return true;
  }
  if (auto fault = planFault(arm_, plan)) {
    refusePlan(plan.id, *fault);
    return false;
  }
  if (dropped_ && *dropped_ == plan) {
    refusePlan(plan.id,
               fmt::format("plan {}: it was interrupted by a stop, a new one is needed", plan.id));
    return false;
  }
  plan_id_ = plan.id;
  plan_ = std::make_shared<const Plan>(std::move(plan));
  order_.reset();
  refused_ = false;
  notice_.clear();
  return true;
}

void ArmController::refusePlan(int64_t id, const std::string& why) {
  plan_id_ = id;
  plan_.reset();
  order_.reset();
  refused_ = true;
  notice_ = why;
}

bool ArmController::startThrow(const ThrowOrder& order) {
  if ((order_ && *order_ == order) || (run_plan_ && run_order_ == order)) {
    return true;
  }
  if (auto fault = orderFault(order)) {
    // Why a plan was refused or the arm stopped is worth more than what follows from it.
    if (!refused_ && !stopped_) {
      notice_ = *fault;
    }
    return false;
  }
  order_ = order;
  notice_.clear();
  if (scene_ && order.scene_id == *scene_) {
    beginThrow(last_);
  }
  return !refused_;
}

std::optional<std::string> ArmController::orderFault(const ThrowOrder& order) const {
  if (!plan_ || plan_->id != order.plan_id) {
    return fmt::format("cannot start plan {}: {}", order.plan_id,
                       plan_ ? fmt::format("the plan held is {}", plan_->id) : "no plan is held");
  }
  if (!scene_ || order.scene_id > *scene_) {
    return {};
  }
  const bool rests = phase_ == Phase::kIdle || phase_ == Phase::kHold;
  if (order.scene_id < *scene_ || order.start_utime <= last_.utime || stopped_ || !rests) {
    return fmt::format("cannot start plan {} in scene {} at {} us: scene {} is at {} us{}",
                       order.plan_id, order.scene_id, order.start_utime, *scene_, last_.utime,
                       stopped_ ? " and has been stopped" : "");
  }
  return {};
}

void ArmController::stop(const std::string& reason) {
  if (plan_) {
    dropped_ = plan_;
  }
  plan_.reset();
  order_.reset();
  refused_ = false;
  if (!stopped_ || notice_.empty()) {
    notice_ = reason;
  }
  stop_pending_ = stop_pending_ || !stopped_;
  stopped_ = true;
}

void ArmController::beginScene(const ArmSample& sample) {
  scene_ = sample.scene_id;
  run_plan_.reset();
  if (stopped_) {
    notice_.clear();
  }
  stopped_ = stop_pending_ = false;
  status_ = {};
  phase_ = Phase::kIdle;
  stop_.begin(sample.q, sample.qd);
  if (order_ && order_->scene_id == sample.scene_id) {
    beginThrow(sample);
  } else if (order_ && order_->scene_id < sample.scene_id) {
    order_.reset();
  }
}

/// Takes up the ordered plan from where the arm is.
void ArmController::beginThrow(const ArmSample& sample) {
  const ThrowOrder order = *order_;
  order_.reset();
  std::optional<std::string> fault = startFault(*plan_, sample.q, config_.start_tolerance);
  if (sample.utime > order.start_utime) {
    fault = fmt::format(
        "plan {}: it should have started at {} us, the first state of scene {} is of {} us",
        order.plan_id, order.start_utime, order.scene_id, sample.utime);
  }
  if (fault) {
    refusePlan(order.plan_id, *fault);
    return;
  }
  notice_.clear();
  run_plan_ = plan_;
  run_order_ = order;
  phase_ = Phase::kIdle;
  status_.q_error_max.setZero();
  offset_ = sample.q - plan_->trajectory.samples().front().q;
  offset_utime_ = sample.utime;
  correction_.setZero();
}

void ArmController::correctFor(int64_t plan_id, int64_t scene_id, const Eigen::Vector3d& p_HBall) {
  const bool in_time = run_plan_ && run_plan_->id == plan_id && run_order_.scene_id == scene_id &&
                       last_.utime < run_order_.start_utime;
  if (!in_time || run_plan_->t_swing < config_.blend_time)
    return;
  const Eigen::Vector4d change = grip_correction_.postureChange(*run_plan_, p_HBall);
  if (change.allFinite())
    correction_ =
        change * std::min(1.0, config_.grip_correction_max / change.cwiseAbs().maxCoeff());
}

void ArmController::beginStop(const ArmSample& sample, const std::string& reason) {
  if (!stopped_) {
    stop(reason);
  }
  stop_pending_ = false;
  run_plan_.reset();
  stop_.begin(sample.q, sample.qd);
  phase_ = Phase::kBrake;
}

/// Stops the arm if its state is beyond what may be.
void ArmController::checkState(const ArmSample& sample) {
  const model::ArmParameters& limits = arm_.parameters();
  for (int i = 0; i < model::kArmJoints; ++i) {
    if (sample.q[i] < limits.q_min[i] || sample.q[i] > limits.q_max[i]) {
      beginStop(
          sample,
          fmt::format("braked: joint {} is at {:.4g} rad, its stops are at {:.4g} and {:.4g} rad",
                      i + 1, sample.q[i], limits.q_min[i], limits.q_max[i]));
      return;
    }
  }
  const double speed = arm_.speedRatio(sample.qd);
  if (speed > config_.overspeed) {
    beginStop(
        sample,
        fmt::format("braked: the arm moves at {:.3g} times its speed limit, {:.3g} is allowed",
                    speed, config_.overspeed));
    return;
  }
  int joint = 0;
  const double error = status_.q_error.cwiseAbs().maxCoeff(&joint);
  if (error > config_.tracking_bound) {
    beginStop(
        sample,
        fmt::format("braked: joint {} is {:.3g} rad from where it should be, {:.3g} rad is allowed",
                    joint + 1, error, config_.tracking_bound));
  }
}

Phase ArmController::phaseAt(double t) const {
  if (t < 0)
    return Phase::kIdle;
  if (t < run_plan_->t_ready)
    return Phase::kApproach;
  if (t < run_plan_->t_swing)
    return Phase::kReady;
  if (t < run_plan_->t_swing_end)
    return Phase::kSwing;
  if (t < run_plan_->trajectory.duration())
    return Phase::kFollowThrough;
  return Phase::kHold;
}

model::ArmMotion ArmController::desiredMotion(int64_t utime) {
  if (!run_plan_) {
    return stop_.motion();
  }
  const double t = seconds(utime - run_order_.start_utime);
  model::ArmMotion desired = run_plan_->trajectory.at(t);
  const double rate = 1 / config_.blend_time;
  const Eigen::Vector3d left = fade(seconds(utime - offset_utime_) * rate);
  const Eigen::Vector3d to_come = fade(t * rate);
  desired.q += offset_ * left[0] + correction_ * (1 - to_come[0]);
  desired.qd += (offset_ * left[1] - correction_ * to_come[1]) * rate;
  desired.qdd += (offset_ * left[2] - correction_ * to_come[2]) * (rate * rate);
  phase_ = phaseAt(t);
  return desired;
}

void ArmController::watchError(const model::ArmMotion& desired, const ArmSample& sample) {
  status_.q_error = desired.q - sample.q;
  status_.qd_error = desired.qd - sample.qd;
  if (phase_ >= Phase::kSwing) {
    status_.q_error_max = status_.q_error_max.cwiseMax(status_.q_error.cwiseAbs());
  }
}

std::optional<Answer> ArmController::answer(const ArmSample& sample) {
  const bool same_scene = scene_ && *scene_ == sample.scene_id;
  if (same_scene && sample.tick == last_.tick) {
    return answer_;
  }
  // A scene's first state opens it even if the scene's number is smaller: then the robot has been started again.
  const bool new_scene = !scene_ || sample.scene_id > *scene_ || (!same_scene && sample.tick == 0);
  if (!new_scene && (!same_scene || sample.tick < last_.tick)) {
    ++status_.stale_states;
    return {};
  }
  if (new_scene) {
    beginScene(sample);
  }
  const int64_t gap = new_scene ? 0 : sample.utime - last_.utime;
  if (stop_pending_) {
    beginStop(sample, notice_);
  } else if (seconds(gap) > config_.stale_limit) {
    // Also while it brakes or rests: the robot may have braked by itself meanwhile, and rest elsewhere.
    ++status_.stale_states;
    beginStop(sample, fmt::format("braked: no state of the arm for {} ms, {:.3g} ms are allowed",
                                  gap / 1000, config_.stale_limit * 1000));
  } else {
    stop_.advance(static_cast<int>(std::clamp<int64_t>(gap / kTickUs, 0, 1000)));
  }
  watchError(desiredMotion(sample.utime), sample);
  if (!stopped_) {
    checkState(sample);
  } else if (status_.q_error.cwiseAbs().maxCoeff() > config_.tracking_bound) {
    // An arm that did not hear the commands is not pulled to where they would have brought it.
    beginStop(sample, notice_);
  }
  const model::ArmMotion desired = desiredMotion(sample.utime);
  const ControlLaw::Torque torque =
      law_.torque(stopped_ ? Law::kFeedForward : config_.law, desired, sample.q, sample.qd);
  status_.saturations += torque.clipped ? 1 : 0;
  answer_.plan_id = run_plan_ ? run_plan_->id : 0;
  answer_.phase = phase_;
  answer_.tau = torque.tau;
  last_ = sample;
  return answer_;
}

}  // namespace fastball::controller
