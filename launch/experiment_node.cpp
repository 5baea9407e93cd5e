#include "launch/experiment_node.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace fastball::launch {
namespace {

constexpr double kMicro = 1e6;
constexpr const char* kAdaptive = "adaptive";
const std::vector<std::string> kAll = {"planner",    "controller",     "hand_server",
                                       "sim_bullet", "vision_tracker", "logger"};

int64_t microseconds(double seconds) {
  return std::llround(seconds * kMicro);
}

}  // namespace

ExperimentNode::ExperimentNode(messaging::Endpoint& endpoint,
                               const messaging::Clock& clock,
                               const Roster& roster,
                               RunSettings settings)
    : endpoint_(endpoint),
      clock_(clock),
      roster_(roster),
      settings_(std::move(settings)),
      plan_requests_(endpoint, messaging::kPlanRequest),
      throw_starts_(endpoint, messaging::kThrowStart),
      scenes_(endpoint, messaging::kScene),
      estops_(endpoint, messaging::kEstop),
      aim_(settings_.config.adaptive) {
  if (settings_.strategy == kAdaptive && !settings_.learned.empty())
    aim_.load(settings_.learned);
  endpoint_.subscribe<swing_plan_t>(messaging::kSwingPlan, [this](const auto& m) { hear(m); });
  endpoint_.subscribe<landing_t>(messaging::kLanding, [this](const auto& m) { hear(m); });
  endpoint_.subscribe<controller_status_t>(messaging::kControllerStatus,
                                           [this](const auto& m) { hear(m); });
  endpoint_.subscribe<ball_observation_t>(messaging::kBallObservation, [this](const auto& m) {
    if (m.request_id == id())
      heardProgress();
  });
}

void ExperimentNode::hear(const swing_plan_t& plan) {
  if (phase_ == Phase::kPlanning && plan.plan_id == id() && !plan_)
    take(plan);
}

void ExperimentNode::take(const swing_plan_t& plan) {
  plan_ = plan;
  if (plan.status == swing_plan_t::REFUSED) {
    fail(fmt::format("throw {}: the planner refused: {}", number_, plan.message));
    return;
  }
  try {
    scene_ = scene(settings_, number_, plan);
    if (const auto broken = messaging::fault(scene_))
      fail(fmt::format("throw {}: its plan makes no scene: {}", number_, *broken));
  } catch (const std::runtime_error& e) {
    fail(e.what());
  }
}

void ExperimentNode::hear(const landing_t& landing) {
  if (landing.request_id == id() && !landing_)
    landing_ = landing;
}

void ExperimentNode::hear(const controller_status_t& status) {
  if (status.scene_id != id())
    return;
  if (status.utime != status_.utime)
    heardProgress();
  status_ = status;
  if (status.phase == arm_command_t::BRAKE && brake_message_.empty()) {
    brake_message_ = "the arm " + status.message;
  }
}

void ExperimentNode::heardProgress() {
  if (phase_ == Phase::kThrowing) {
    give_up_us_ = clock_.monotonicUs() + microseconds(settings_.config.answer_timeout);
  }
}

void ExperimentNode::step() {
  if (finished())
    return;
  if (give_up_us_ == INT64_MAX)
    enter(Phase::kPlanning);
  while (!finished() && !anyFailed() && advance()) {
  }
  if (finished())
    return;
  const int64_t now = clock_.monotonicUs();
  if (now >= give_up_us_) {
    giveUpWaiting();
  } else if (now >= next_say_us_) {
    say();
  }
}

bool ExperimentNode::anyFailed() {
  for (const std::string& process : kAll) {
    const heartbeat_t* heartbeat = roster_.newest(process);
    if (heartbeat == nullptr)
      continue;
    if (heartbeat->state == "failed") {
      fail(fmt::format("{} failed: {}", process, heartbeat->detail));
      return true;
    }
    if (roster_.holds(process, id(), "refused")) {
      fail(fmt::format("throw {}: {} refused: {}", number_, process, heartbeat->detail));
      return true;
    }
  }
  return false;
}

bool ExperimentNode::advance() {
  switch (phase_) {
    case Phase::kPlanning:
      if (!planAnswered())
        return false;
      enter(Phase::kArming);
      return true;
    case Phase::kArming:
      if (!withoutOrder().empty())
        return false;
      enter(Phase::kStarting);
      return true;
    case Phase::kStarting:
      if (!sceneStarted())
        return false;
      enter(Phase::kThrowing);
      return true;
    case Phase::kThrowing:
      if (!landing_ || !sceneFinished())
        return false;
      finishThrow();
      return true;
    case Phase::kDone:
    case Phase::kFailed:
      break;
  }
  return false;
}

bool ExperimentNode::planAnswered() {
  return plan_ && withoutPlan().empty();
}

bool ExperimentNode::sceneStarted() const {
  return status_.scene_id == id() || roster_.holds("sim_bullet", id(), "running") ||
         sceneFinished();
}

bool ExperimentNode::sceneFinished() const {
  return roster_.holds("sim_bullet", id(), "finished");
}

void ExperimentNode::enter(Phase phase) {
  phase_ = phase;
  const int64_t now = clock_.monotonicUs();
  if (phase == Phase::kPlanning)
    throw_began_us_ = now;
  // A LANDING comes unasked.
  next_say_us_ =
      now + (phase == Phase::kThrowing ? microseconds(settings_.config.repeat_interval) : 0);
  give_up_us_ = now + microseconds(settings_.config.answer_timeout);
}

void ExperimentNode::say() {
  next_say_us_ = clock_.monotonicUs() + microseconds(settings_.config.repeat_interval);
  switch (phase_) {
    case Phase::kPlanning: {
      plan_request_t message = planRequest(settings_, number_);
      Eigen::Map<model::LandingBiases>(message.biases) = aim_.biases();
      plan_requests_.publish(message);
      break;
    }
    case Phase::kArming: {
      throw_start_t message = throwStart(settings_, number_);
      throw_starts_.publish(message);
      break;
    }
    case Phase::kStarting:
      scenes_.publish(scene_);
      break;
    case Phase::kThrowing:
      // UDP may have lost the LANDING, which is said once: whoever measured it answers the SCENE again.
      if (sceneFinished() && !landing_)
        scenes_.publish(scene_);
      break;
    default:
      next_say_us_ = INT64_MAX;
  }
}

void ExperimentNode::finishThrow() {
  const Eigen::Map<const Eigen::Vector3d> v_WBall(plan_->v_WBall_release);
  Throw seen;
  seen.number = number_;
  seen.scene_id = id();
  seen.plan_ms = plan_->plan_ms;
  seen.planned_speed = v_WBall.norm();
  seen.duration = scene_.duration;
  seen.note = brake_message_;
  const auto note = [&seen](const std::string& what) {
    seen.note += (seen.note.empty() ? "" : "; ") + what;
  };
  if (roster_.holds("hand_server", id(), "holding"))
    note("the hand " + roster_.newest("hand_server")->detail);
  if (landing_ && landing_->measured == 1) {
    seen.measured = true;
    seen.landing = {landing_->landing[0], landing_->landing[1]};
    seen.landing_sigma = {std::sqrt(landing_->cov_landing[0]), std::sqrt(landing_->cov_landing[2])};
  } else {
    note(landing_ ? landing_->message : "the tracker said no LANDING");
  }
  throws_.push_back(seen);
  // A throw that was cut short says nothing of what the set-up adds to a throw.
  if (settings_.strategy == kAdaptive && seen.measured && brake_message_.empty())
    learn();
  throw_wall_s_.push_back(static_cast<double>(clock_.monotonicUs() - throw_began_us_) / kMicro);
  plan_.reset();
  landing_.reset();
  brake_message_.clear();
  if (number_ == settings_.throws) {
    phase_ = Phase::kDone;
    return;
  }
  ++number_;
  enter(Phase::kPlanning);
}

void ExperimentNode::learn() {
  const model::BallState release{Eigen::Map<const Eigen::Vector3d>(plan_->p_WBall_release),
                                 Eigen::Map<const Eigen::Vector3d>(plan_->v_WBall_release)};
  const double* cov = landing_->cov_landing;
  const Eigen::Matrix2d covariance =
      (Eigen::Matrix2d() << cov[0], cov[1], cov[1], cov[2]).finished();
  aim_.observe(model::landingJacobian(release, settings_.target, settings_.ball, settings_.gravity),
               Eigen::Map<const Eigen::Vector2d>(plan_->landing),
               Eigen::Map<const Eigen::Vector2d>(landing_->landing), covariance);
  if (!settings_.learned.empty())
    aim_.save(settings_.learned);
}

void ExperimentNode::fail(const std::string& sentence) {
  phase_ = Phase::kFailed;
  error_ = sentence;
}

void ExperimentNode::stop(const std::string& reason) {
  estop_t estop{};
  estop.utime = status_.utime;
  // Other processes' words are in it: an ESTOP that is too long would not be said.
  estop.reason = messaging::shortened(reason);
  estops_.publish(estop);
  fail(reason);
}

void ExperimentNode::giveUpWaiting() {
  // A ball that no camera saw long enough leaves nothing to measure: a result, not a failure.
  if (phase_ == Phase::kThrowing && sceneFinished()) {
    finishThrow();
    return;
  }
  stop(fmt::format("throw {}: {} (run.answer_timeout {} s)", number_, waitingFor(),
                   settings_.config.answer_timeout));
}

int64_t ExperimentNode::wakeUs() const {
  return finished() ? INT64_MAX : std::min(next_say_us_, give_up_us_);
}

}  // namespace fastball::launch
