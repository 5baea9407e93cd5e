// A controller of one's own in the place of fastball-controller: computed torque along the plan.
#include <config/experiment.h>
#include <messaging/process.h>
#include <model/arm.h>
#include <model/trajectory.h>

using namespace fastball;
class MyController : public messaging::Node {
 public:
  MyController(messaging::Endpoint& endpoint, const config::Experiment& experiment)
      : arm_(experiment.arm, experiment.hand.payload), commands_(endpoint, messaging::kArmCommand) {
    endpoint.subscribe<swing_plan_t>(messaging::kSwingPlan, [this](const auto& m) { take(m); });
    endpoint.subscribe<throw_start_t>(messaging::kThrowStart,
                                      [this](const auto& m) { start_ = m; });
    endpoint.subscribe<arm_state_t>(messaging::kArmState, [this](const auto& m) { answer(m); });
  }
  std::string name() const override { return "controller"; }
  messaging::NodeState state() const override {
    return {start_.plan_id == plan_id_ ? "armed" : "planned", "", plan_id_};
  }

 private:
  void take(const swing_plan_t& plan) {
    if (plan.status != swing_plan_t::OK || plan.plan_id == plan_id_)
      return;
    std::vector<model::ArmMotion> samples;
    for (int k = 0; k < plan.n_samples; ++k)
      samples.push_back({Eigen::Vector4d(plan.q[k].data()), Eigen::Vector4d(plan.qd[k].data()),
                         Eigen::Vector4d(plan.qdd[k].data())});
    trajectory_ = model::SampledTrajectory(plan.dt, samples);
    plan_id_ = plan.plan_id;
  }
  void answer(const arm_state_t& state) {
    const Eigen::Map<const Eigen::Vector4d> q(state.q), qd(state.qd);
    model::ArmMotion desired{q, Eigen::Vector4d::Zero(), Eigen::Vector4d::Zero()};
    if (state.scene_id == start_.scene_id && start_.plan_id == plan_id_)
      desired = trajectory_.at(1e-6 * static_cast<double>(state.utime - start_.start_utime));
    const Eigen::Vector4d kp(8000, 8000, 2000, 5000), kd(250, 250, 22, 70);
    arm_command_t command{state.utime, 0, state.scene_id, state.tick, plan_id_};
    Eigen::Map<Eigen::Vector4d>{command.tau} = arm_.clipTorque(
        arm_.inverseDynamics(desired.q, desired.qd, desired.qdd) + arm_.frictionTorque(desired.qd) +
        kp.cwiseProduct(desired.q - q) + kd.cwiseProduct(desired.qd - qd));
    commands_.publish(command);
  }
  model::Arm arm_;
  messaging::Publisher<arm_command_t> commands_;
  model::SampledTrajectory trajectory_;
  throw_start_t start_{0, 0, -1};
  int64_t plan_id_ = 0;
};

int main(int argc, char** argv) {
  return messaging::processMain(
      argc, argv, "my-controller", "Computed torque along the plan.",
      [](auto& endpoint, const auto& /*clock*/, const messaging::ProcessOptions& options) {
        const std::string file = config::experimentPath(options.config);
        return std::make_unique<MyController>(endpoint, config::loadExperiment(file));
      });
}
