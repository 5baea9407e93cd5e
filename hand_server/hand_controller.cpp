#include "hand_server/hand_controller.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "hand_server/release_condition.h"
#include "hand_server/wrist_load.h"
#include "model/contact.h"

namespace fastball::hand_server {
namespace {

using model::HandVector;

bool operator==(const ThrowOrder& a, const ThrowOrder& b) {
  return a.plan_id == b.plan_id && a.scene_id == b.scene_id && a.start_utime == b.start_utime;
}

int64_t microseconds(double seconds) {
  return std::llround(seconds * 1e6);
}

/// A relaxed wrist and fingers apart.
HandVector openPosture(const model::Hand& hand, double distance) {
  return hand.posture(0, 0, {distance, distance, distance});
}

}  // namespace

HandController::HandController(const model::Arm& arm,
                               const model::Hand& hand,
                               const model::BallParameters& ball,
                               const HandServerConfig& config)
    : arm_(arm),
      hand_(hand),
      ball_(ball),
      config_(config),
      q_open_(openPosture(hand, config.release.open_distance)),
      timing_(arm, hand.parameters().p_HBall, config) {}

bool HandController::offerPlan(const HandPlan& plan) {
  if (next_ && next_->plan == plan) {
    return true;
  }
  if (dropped_ && *dropped_ == plan) {
    refusePlan(plan.id,
               fmt::format("plan {}: it was interrupted by a stop, a new one is needed", plan.id));
    return false;
  }
  try {
    next_ = std::make_shared<const PlannedGrasp>(planGrasp(plan, hand_, ball_));
  } catch (const std::invalid_argument& e) {
    refusePlan(plan.id, e.what());
    return false;
  }
  plan_id_ = plan.id;
  order_.reset();
  refused_ = false;
  notice_.clear();
  return true;
}

void HandController::refusePlan(int64_t id, const std::string& why) {
  plan_id_ = id;
  next_.reset();
  order_.reset();
  refused_ = true;
  notice_ = why;
}

std::optional<std::string> HandController::orderFault(const ThrowOrder& order) const {
  if (!next_ || next_->plan.id != order.plan_id) {
    return fmt::format(
        "cannot start plan {}: {}", order.plan_id,
        next_ ? fmt::format("the plan held is {}", next_->plan.id) : "no plan is held");
  }
  if (!scene_ || order.scene_id > *scene_) {
    return {};
  }
  if (order.scene_id < *scene_ || order.start_utime <= last_.utime || run_ || kept_) {
    return fmt::format("cannot start plan {} in scene {} at {} us: scene {} is at {} us{}",
                       order.plan_id, order.scene_id, order.start_utime, *scene_, last_.utime,
                       run_ ? " and has had its throw" : "");
  }
  return {};
}

bool HandController::startThrow(const ThrowOrder& order) {
  if ((order_ && *order_ == order) || (run_ && run_order_ == order)) {
    return true;
  }
  if (auto fault = orderFault(order)) {
    // Why a plan was refused or the ball is kept is worth more than what follows from it.
    if (!refused_ && !kept_) {
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

void HandController::keep(const std::string& reason) {
  if (next_) {
    dropped_ = next_->plan;
  }
  next_.reset();
  order_.reset();
  refused_ = false;
  if (!kept_ || notice_.empty()) {
    notice_ = reason;
  }
  kept_ = true;
  if (preparation_)
    preparation_->end();
}

void HandController::watchArm(int64_t scene_id, int64_t utime, const Eigen::Vector4d& q) {
  if (!running() || scene_id != *scene_) {
    return;
  }
  int joint = 0;
  const double error =
      (run_->plan.arm.at(timing_.planTime(utime)).q - q).cwiseAbs().maxCoeff(&joint);
  if (error > config_.arm_bound) {
    keep(fmt::format(
        "kept the ball: joint {} of the arm is {:.3g} rad from plan {}, {:.3g} rad is allowed",
        joint + 1, error, run_->plan.id, config_.arm_bound));
  }
}

void HandController::beginScene(const HandSample& sample) {
  scene_ = sample.scene_id;
  run_.reset();
  preparation_.reset();
  if (!refused_) {
    notice_.clear();
  }
  kept_ = false;
  phase_ = Phase::kOpen;
  path_ = model::JointPath(sample.q, q_open_, sample.utime, config_.grasp_time);
  slip_watch_ = {};
  ball_watch_ = BallWatch(
      {config_.release.touch_force, config_.quiet_time, config_.force_noise, config_.force_delay});
  if (order_ && order_->scene_id == sample.scene_id) {
    beginThrow(sample);
  } else if (order_ && order_->scene_id < sample.scene_id) {
    order_.reset();
  }
}

void HandController::beginThrow(const HandSample& sample) {
  const ThrowOrder order = *order_;
  order_.reset();
  if (sample.utime > order.start_utime) {
    refusePlan(
        order.plan_id,
        fmt::format(
            "plan {}: it should have started at {} us, the first state of scene {} is of {} us",
            order.plan_id, order.start_utime, order.scene_id, sample.utime));
    return;
  }
  run_ = next_;
  run_order_ = order;
  phase_ = Phase::kGrasp;
  prepared_ = false;
  X_TH_ = hand_.X_TH(run_->plan.q_wrist[0], run_->plan.q_wrist[1]);
  path_ = model::JointPath(sample.q, run_->q, sample.utime, config_.grasp_time);
  timing_.beginThrow(run_, order.start_utime, X_TH_);
  grip_.reset();
  preparation_.emplace(run_, arm_, hand_, ball_, config_, sample.utime);
}

void HandController::releaseWhenDue(const HandSample& sample) {
  switch (timing_.decide(sample.utime)) {
    case ReleaseTiming::Decision::kWait:
      return;
    case ReleaseTiming::Decision::kRelease:
      beginRelease(sample);
      return;
    case ReleaseTiming::Decision::kMissed:
      keep(fmt::format(
          "kept the ball: the hand did not stop pushing (Eq. 24) within {:.3g} s of the planned "
          "release",
          config_.normal_force_window));
      return;
  }
}

void HandController::beginRelease(const HandSample& sample) {
  phase_ = Phase::kRelease;
  timing_.command(sample.utime);
  release_ = model::ReleaseMotion(hand_, preparation_->settled(), config_.release, timing_.mode(),
                                  timing_.fingerTimes());
  commanded_ = {sample.utime,
                run_->plan.id,
                ReleaseEvent::Kind::kCommanded,
                config_.release_by,
                timing_.plannedCommand(),
                timing_.predictedDeparture(),
                sample.force,
                grip_,
                timing_.deadTimes()};
}

/// Until the swing; says once, when it begins, if the thumb does not feel the grip it should have.
void HandController::prepareGrip(const HandSample& sample) {
  const double t = timing_.planTime(sample.utime);
  if (prepared_)
    return;
  if (t < run_->plan.t_swing) {
    preparation_->step(sample, 1e-6 * static_cast<double>(sample.utime - last_.utime), t);
    timing_.feel(preparation_->deadTimes());
    return;
  }
  prepared_ = true;
  preparation_->end();
  grip_ = preparation_->estimate(run_->plan.t_swing);
  if (sample.force[model::kThumb] < config_.grip_share * run_->plan.grip_force) {
    notice_ = fmt::format("the ball is not gripped: the thumb presses with {:.3g} N of {:.3g} N",
                          sample.force[model::kThumb], run_->plan.grip_force);
  }
}

std::optional<GripEstimate> HandController::gripBeforeStart() const {
  const bool before = preparation_ && !kept_ && timing_.planTime(last_.utime) < 0;
  return before ? preparation_->atRest() : std::nullopt;
}

/// Says once, during the swing, if the ball slips between the fingers.
void HandController::watchSlip(const HandSample& sample) {
  const double t = timing_.planTime(sample.utime);
  if (t < run_->plan.t_swing) {
    return;
  }
  const double felt_at = t - config_.force_delay - kHalfTick;
  const double needed =
      ball_.mass *
      carryingAcceleration(arm_, run_->plan.arm.at(felt_at), X_TH_, hand_.parameters().p_HBall).z();
  if (const auto slip = slip_watch_.step(needed, sample.tangential)) {
    notice_ = fmt::format(
        "the ball slips {:.3g} s into the swing: the fingers carry it with {:.3g} N of the {:.3g} "
        "N "
        "that its mass takes",
        t - run_->plan.t_swing, slip->carried, slip->needed);
  }
}

void HandController::watchBall(const HandSample& sample) {
  if (phase_ < Phase::kHold) {
    return;
  }
  if (const auto departure = ball_watch_.step(sample.utime, sample.force)) {
    sayDeparture(*departure);
  }
  if (const auto finger = ball_watch_.touchedAgain(sample.force)) {
    constexpr std::array<const char*, model::kFingers> kNames{"finger A", "the thumb", "finger B"};
    notice_ = fmt::format(
        "{} touched the ball again {:.3g} ms after it had left", kNames[*finger],
        1e3 * (1e-6 * static_cast<double>(sample.utime - ball_watch_.departure().utime) -
               config_.force_delay));
  }
}

void HandController::sayDeparture(const BallWatch::Departure& departure) {
  if (phase_ >= Phase::kRelease) {
    timing_.learn(departure.utime);
  }
  departed_ = {departure.utime,
               run_->plan.id,
               ReleaseEvent::Kind::kDeparted,
               config_.release_by,
               timing_.plannedDeparture(),
               phase_ >= Phase::kRelease ? timing_.predictedDeparture() : departure.utime,
               departure.force,
               grip_,
               timing_.deadTimes()};
}

void HandController::advancePhase(const HandSample& sample) {
  if (!run_) {
    return;
  }
  if (phase_ == Phase::kGrasp && path_.done(sample.utime)) {
    phase_ = Phase::kHold;
  }
  if (!kept_ && phase_ <= Phase::kHold) {
    prepareGrip(sample);
    watchSlip(sample);
    releaseWhenDue(sample);
  }
  watchBall(sample);
  const bool late = sample.utime - timing_.commanded() >= microseconds(config_.clear_delay);
  if (phase_ == Phase::kRelease && (ball_watch_.departed() || late)) {
    release_.open(sample.utime - timing_.commanded());
    phase_ = Phase::kClear;
  }
}

/// Share of its torque in the grasp that a finger at posture q should press with: that of the ball's deformation there.
double HandController::pressure(model::Finger finger, const HandVector& q) const {
  const model::FingerGrasp& grasp = run_->geometry.fingers[finger];
  const model::Segment distal = hand_.phalanges(finger, q)[1];
  const double distance = (distal.p_start + distal.p_end).head<2>().norm() / 2;
  const double y = ball_.radius + hand_.parameters().finger_radius - distance;
  return std::min(model::elasticForce(ball_, y) / grasp.force, 1.0);
}

void HandController::command(const HandSample& sample) {
  const model::JointPath::Point point = path_.at(sample.utime);
  answer_.q = point.q;
  answer_.qd = point.qd;
  answer_.tau.setZero();
  answer_.kp = config_.release.kp;
  answer_.kd = config_.release.kd;
  if (phase_ == Phase::kGrasp || phase_ == Phase::kHold) {
    answer_.tau = run_->tau;
  }
  if (phase_ == Phase::kGrasp) {
    for (const model::Finger finger : {model::kFingerA, model::kThumb, model::kFingerB}) {
      answer_.tau.segment<2>(model::Hand::proximalJoint(finger)) *= pressure(finger, point.q);
    }
  }
  if (preparation_ && (phase_ == Phase::kGrasp || phase_ == Phase::kHold)) {
    preparation_->apply(sample.utime, answer_);
  }
  if (phase_ >= Phase::kRelease) {
    release_.step(sample.utime - timing_.commanded(), sample.q, sample.qd, sample.force, answer_);
    phase_ = release_.opening() ? Phase::kClear : phase_;
  }
  if (run_) {
    answer_.tau.head<2>() =
        wristLoad(arm_, hand_.parameters(), run_->plan.arm.at(timing_.planTime(sample.utime)),
                  run_->plan.q_wrist);
  }
  answer_.plan_id = run_ ? run_->plan.id : 0;
  answer_.phase = phase_;
}

std::optional<HandAnswer> HandController::answer(const HandSample& sample) {
  const bool same_scene = scene_ && *scene_ == sample.scene_id;
  if (same_scene && sample.tick == last_.tick) {
    return answer_;
  }
  // A scene's first state opens it even if the scene's number is smaller: then the robot has been started again.
  const bool new_scene = !scene_ || sample.scene_id > *scene_ || (!same_scene && sample.tick == 0);
  if (!new_scene && (!same_scene || sample.tick < last_.tick)) {
    return {};
  }
  commanded_.reset();
  departed_.reset();
  if (new_scene) {
    beginScene(sample);
  }
  advancePhase(sample);
  command(sample);
  last_ = sample;
  return answer_;
}

std::optional<ReleaseEvent> HandController::takeEvent() {
  return std::exchange(commanded_ ? commanded_ : departed_, std::nullopt);
}

}  // namespace fastball::hand_server
