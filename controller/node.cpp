#include "controller/node.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <vector>

#include "config/experiment.h"
#include "controller/arm_controller.h"

namespace fastball::controller {
namespace {

/// Status messages are this far apart in simulated time [us].
constexpr int64_t kStatusUs = 20000;

Plan fromMessage(const swing_plan_t& message) {
  std::vector<model::ArmMotion> samples(static_cast<std::size_t>(message.n_samples));
  for (std::size_t k = 0; k < samples.size(); ++k) {
    samples[k].q = Eigen::Map<const Eigen::Vector4d>(message.q[k].data());
    samples[k].qd = Eigen::Map<const Eigen::Vector4d>(message.qd[k].data());
    samples[k].qdd = Eigen::Map<const Eigen::Vector4d>(message.qdd[k].data());
  }
  return {message.plan_id,
          message.t_ready,
          message.t_swing,
          message.t_swing_end,
          model::SampledTrajectory(message.dt, std::move(samples)),
          message.t_release,
          message.flight_time,
          Eigen::Map<const Eigen::Vector2d>(message.q_wrist)};
}

class ControllerNode : public messaging::Node {
 public:
  ControllerNode(messaging::Endpoint& endpoint,
                 const messaging::Clock& clock,
                 const config::Experiment& experiment,
                 const ControllerConfig& config,
                 bool realtime)
      : clock_(clock),
        realtime_(realtime),
        stale_limit_us_(static_cast<int64_t>(config.stale_limit * 1e6)),
        controller_(model::Arm(experiment.arm, experiment.hand.payload),
                    model::Hand(experiment.hand),
                    experiment.ball,
                    config),
        commands_(endpoint, messaging::kArmCommand),
        statuses_(endpoint, messaging::kControllerStatus) {
    endpoint.subscribe<swing_plan_t>(messaging::kSwingPlan,
                                     [this](const swing_plan_t& m) { takePlan(m); });
    endpoint.subscribe<throw_start_t>(messaging::kThrowStart, [this](const throw_start_t& m) {
      controller_.startThrow({m.plan_id, m.scene_id, m.start_utime});
    });
    endpoint.subscribe<grip_t>(messaging::kGrip, [this](const grip_t& m) {
      controller_.correctFor(m.plan_id, m.scene_id, Eigen::Map<const Eigen::Vector3d>(m.p_HBall));
    });
    endpoint.subscribe<estop_t>(messaging::kEstop, [this](const estop_t& m) {
      controller_.stop("braked: ESTOP: " + m.reason);
    });
    endpoint.subscribe<arm_state_t>(messaging::kArmState, [this](const arm_state_t& m) {
      newest_ = m;
      is_new_ = true;
      // In lockstep the robot waits for the answer to each state; in real time only the newest counts.
      if (!realtime_)
        answerNewest();
    });
  }

  std::string name() const override { return "controller"; }

  void step() override {
    if (is_new_)
      answerNewest();
    if (clock_.monotonicUs() >= wakeUs()) {
      silent_ = true;
      controller_.stop(
          fmt::format("braked: no ARM_STATE for more than {} ms", stale_limit_us_ / 1000));
      sayStatus();
    }
    if (silent_ && !controller_.stopped())
      silent_ = back_ = false;  // another scene
  }

  void onSilence(const std::vector<std::string>& names, const std::string& sentence) override {
    if (std::find(names.begin(), names.end(), "experiment") != names.end())
      controller_.stop("braked: " + sentence);
  }

  int64_t wakeUs() const override {
    return realtime_ && controller_.running() && !controller_.stopped()
               ? heard_us_ + stale_limit_us_
               : INT64_MAX;
  }

  messaging::NodeState state() const override {
    return {word(), controller_.notice() + (back_ ? "; it comes again" : ""), controller_.planId()};
  }

 private:
  const char* word() const {
    // A scene that lasts as long as its plan may end a tick before it: the next order counts all the same.
    if (controller_.running() && !controller_.stopped() && !controller_.armed())
      return "running";
    if (controller_.refused())
      return "refused";
    if (controller_.armed())
      return "armed";
    if (controller_.planned())
      return "planned";
    if (controller_.stopped())
      return "braked";
    return controller_.phase() == Phase::kHold ? "holding" : "idle";
  }

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
    back_ = silent_;
    const Phase phase_before = controller_.phase();
    const ArmSample sample{newest_.utime, newest_.scene_id, newest_.tick,
                           Eigen::Map<const Eigen::Vector4d>(newest_.q),
                           Eigen::Map<const Eigen::Vector4d>(newest_.qd)};
    const std::optional<Answer> answer = controller_.answer(sample);
    if (!answer)
      return;
    command_.utime = newest_.utime;
    command_.scene_id = newest_.scene_id;
    command_.tick = newest_.tick;
    command_.plan_id = answer->plan_id;
    command_.phase = static_cast<int8_t>(answer->phase);
    std::copy_n(answer->tau.data(), model::kArmJoints, command_.tau);
    commands_.publish(command_);

    const int64_t slot = newest_.utime / kStatusUs;
    if (slot != status_slot_ || answer->phase != phase_before) {
      status_slot_ = slot;
      sayStatus();
    }
  }

  void sayStatus() {
    const Status& status = controller_.status();
    status_.utime = newest_.utime;
    status_.plan_id = controller_.planId();
    status_.scene_id = controller_.scene();
    status_.phase = static_cast<int8_t>(controller_.phase());
    std::copy_n(status.q_error.data(), model::kArmJoints, status_.q_error);
    std::copy_n(status.qd_error.data(), model::kArmJoints, status_.qd_error);
    std::copy_n(status.q_error_max.data(), model::kArmJoints, status_.q_error_max);
    status_.stale_states = status.stale_states;
    status_.saturations = status.saturations;
    status_.message = messaging::shortened(controller_.notice());
    statuses_.publish(status_);
  }

  const messaging::Clock& clock_;
  bool realtime_;
  int64_t stale_limit_us_;
  ArmController controller_;
  messaging::Publisher<arm_command_t> commands_;
  messaging::Publisher<controller_status_t> statuses_;
  arm_state_t newest_{};
  bool is_new_ = false;
  int64_t heard_us_ = 0;
  bool silent_ = false;  ///< stopped because it was not heard
  bool back_ = false;    ///< it was heard again since
  arm_command_t command_{};
  controller_status_t status_{};
  int64_t status_slot_ = -1;
};

}  // namespace

std::unique_ptr<messaging::Node> makeNode(messaging::Endpoint& endpoint,
                                          const messaging::Clock& clock,
                                          const messaging::ProcessOptions& options) {
  const std::string path = config::experimentPath(options.config);
  return std::make_unique<ControllerNode>(endpoint, clock, config::loadExperiment(path),
                                          loadConfig(path), options.realtime);
}

}  // namespace fastball::controller
