#include "hand_server/node.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "config/experiment.h"
#include "hand_server/hand_controller.h"

namespace fastball::hand_server {
namespace {

HandPlan fromMessage(const swing_plan_t& message) {
  std::vector<model::ArmMotion> samples(static_cast<std::size_t>(message.n_samples));
  for (std::size_t k = 0; k < samples.size(); ++k) {
    samples[k].q = Eigen::Map<const Eigen::Vector4d>(message.q[k].data());
    samples[k].qd = Eigen::Map<const Eigen::Vector4d>(message.qd[k].data());
    samples[k].qdd = Eigen::Map<const Eigen::Vector4d>(message.qdd[k].data());
  }
  return {message.plan_id,
          message.t_swing,
          message.t_release_command,
          message.t_release,
          message.release_window[1] - message.release_window[0],
          message.grip_force,
          Eigen::Map<const Eigen::Vector2d>(message.q_wrist),
          model::SampledTrajectory(message.dt, std::move(samples)),
          message.strategy == "tactile" || message.strategy == "adaptive"};
}

class HandServerNode : public messaging::Node {
 public:
  HandServerNode(messaging::Endpoint& endpoint,
                 const messaging::Clock& clock,
                 const config::Experiment& experiment,
                 const HandServerConfig& config,
                 bool realtime)
      : clock_(clock),
        realtime_(realtime),
        stale_limit_us_(std::llround(config.stale_limit * 1e6)),
        controller_(model::Arm(experiment.arm, experiment.hand.payload),
                    model::Hand(experiment.hand),
                    experiment.ball,
                    config),
        commands_(endpoint, messaging::kHandCommand),
        grips_(endpoint, messaging::kGrip),
        releases_(endpoint, messaging::kRelease) {
    endpoint.subscribe<swing_plan_t>(messaging::kSwingPlan,
                                     [this](const swing_plan_t& m) { takePlan(m); });
    endpoint.subscribe<throw_start_t>(messaging::kThrowStart, [this](const throw_start_t& m) {
      controller_.startThrow({m.plan_id, m.scene_id, m.start_utime});
    });
    endpoint.subscribe<estop_t>(messaging::kEstop, [this](const estop_t& m) {
      controller_.keep("kept the ball: ESTOP: " + m.reason);
    });
    endpoint.subscribe<arm_state_t>(messaging::kArmState, [this](const arm_state_t& m) {
      arm_heard_us_ = clock_.monotonicUs();
      controller_.watchArm(m.scene_id, m.utime, Eigen::Map<const Eigen::Vector4d>(m.q));
    });
    endpoint.subscribe<hand_state_t>(messaging::kHandState, [this](const hand_state_t& m) {
      newest_ = m;
      is_new_ = true;
      // In lockstep the robot waits for the answer to each state; in real time only the newest counts.
      if (!realtime_)
        answerNewest();
    });
  }

  std::string name() const override { return "hand_server"; }

  void step() override {
    if (is_new_)
      answerNewest();
    if (silent_ && clock_.monotonicUs() < staleUs())
      back_ = true;
    if (clock_.monotonicUs() >= wakeUs()) {
      silent_ = true;
      controller_.keep(fmt::format("kept the ball: no {} for more than {} ms",
                                   arm_heard_us_ < heard_us_ ? "ARM_STATE" : "HAND_STATE",
                                   stale_limit_us_ / 1000));
    }
    if (silent_ && !controller_.kept())
      silent_ = back_ = false;  // another scene
  }

  void onSilence(const std::vector<std::string>& names, const std::string& sentence) override {
    if (std::find(names.begin(), names.end(), "experiment") != names.end())
      controller_.keep("kept the ball: " + sentence);
  }

  int64_t wakeUs() const override {
    return realtime_ && controller_.running() ? staleUs() : INT64_MAX;
  }

  messaging::NodeState state() const override {
    return {word(), controller_.notice() + (back_ ? "; it comes again" : ""), controller_.planId()};
  }

 private:
  const char* word() const {
    if (controller_.running())
      return "running";
    if (controller_.refused())
      return "refused";
    if (controller_.armed())
      return "armed";
    if (controller_.planned())
      return "planned";
    if (controller_.released())
      return "released";
    return controller_.kept() ? "holding" : "idle";
  }

  /// When the older of the newest states will be too old.
  int64_t staleUs() const { return std::min(arm_heard_us_, heard_us_) + stale_limit_us_; }

  void takePlan(const swing_plan_t& message) {
    if (message.status != swing_plan_t::OK)
      return;
    try {
      controller_.offerPlan(fromMessage(message));
    } catch (const std::invalid_argument& e) {
      controller_.refusePlan(message.plan_id,
                             fmt::format("plan {}: {}", message.plan_id, e.what()));
    }
  }

  void answerNewest() {
    is_new_ = false;
    heard_us_ = clock_.monotonicUs();
    HandSample sample{newest_.utime, newest_.scene_id, newest_.tick,
                      Eigen::Map<const model::HandVector>(newest_.q),
                      Eigen::Map<const model::HandVector>(newest_.qd)};
    sample.tau = Eigen::Map<const model::HandVector>(newest_.tau);
    std::copy_n(newest_.f_normal, model::kFingers, sample.force.begin());
    for (int i = 0; i < model::kFingers; ++i)
      sample.tangential[i] = {newest_.f_tangential[i][0], newest_.f_tangential[i][1]};
    const std::optional<HandAnswer> answer = controller_.answer(sample);
    if (!answer)
      return;
    command_.utime = newest_.utime;
    command_.scene_id = newest_.scene_id;
    command_.tick = newest_.tick;
    command_.plan_id = answer->plan_id;
    command_.phase = static_cast<int8_t>(answer->phase);
    std::copy_n(answer->q.data(), model::kHandJoints, command_.q);
    std::copy_n(answer->qd.data(), model::kHandJoints, command_.qd);
    std::copy_n(answer->tau.data(), model::kHandJoints, command_.tau);
    std::copy_n(answer->kp.data(), model::kHandJoints, command_.kp);
    std::copy_n(answer->kd.data(), model::kHandJoints, command_.kd);
    if (const auto grip = controller_.gripBeforeStart())
      say(*grip);
    commands_.publish(command_);
    while (const auto event = controller_.takeEvent())
      say(*event);
  }

  void say(const GripEstimate& grip) {
    grip_t message{};
    message.utime = newest_.utime;
    message.plan_id = command_.plan_id;
    message.scene_id = newest_.scene_id;
    message.grip_force = grip.grip_force;
    std::copy_n(grip.p_HBall.data(), 3, message.p_HBall);
    message.youngs_modulus = grip.youngs_modulus;
    grips_.publish(message);
  }

  void say(const ReleaseEvent& event) {
    release_t message{};
    message.utime = event.utime;
    message.plan_id = event.plan_id;
    message.scene_id = controller_.scene();
    message.event = static_cast<int8_t>(event.kind);
    message.reason =
        event.reason == ReleaseBy::kPlanTime ? release_t::PLAN_TIME : release_t::NORMAL_FORCE;
    message.planned_utime = event.planned_utime;
    message.predicted_utime = event.predicted_utime;
    if (event.grip) {
      message.grip_force = event.grip->grip_force;
      std::copy_n(event.grip->p_HBall.data(), 2, message.p_HBall);
      message.youngs_modulus = event.grip->youngs_modulus;
    }
    if (event.dead_times)
      std::copy_n(event.dead_times->begin(), model::kFingers, message.dead_time);
    std::copy_n(event.force.begin(), model::kFingers, message.f_normal);
    releases_.publish(message);
  }

  const messaging::Clock& clock_;
  bool realtime_;
  int64_t stale_limit_us_;
  int64_t heard_us_ = 0;      ///< monotonic, HAND_STATE
  int64_t arm_heard_us_ = 0;  ///< monotonic, ARM_STATE
  bool silent_ = false;       ///< the ball is kept because one of them was not heard
  bool back_ = false;         ///< both were heard again since
  HandController controller_;
  messaging::Publisher<hand_command_t> commands_;
  messaging::Publisher<grip_t> grips_;
  messaging::Publisher<release_t> releases_;
  hand_state_t newest_{};
  bool is_new_ = false;
  hand_command_t command_{};
};

}  // namespace

std::unique_ptr<messaging::Node> makeNode(messaging::Endpoint& endpoint,
                                          const messaging::Clock& clock,
                                          const messaging::ProcessOptions& options) {
  const std::string path = config::experimentPath(options.config);
  return std::make_unique<HandServerNode>(endpoint, clock, config::loadExperiment(path),
                                          loadConfig(path), options.realtime);
}

}  // namespace fastball::hand_server
