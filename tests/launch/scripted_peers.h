#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "messaging/local_network.h"

namespace fastball::launch {

/// A process that does what the test says.
struct ScriptedNode : messaging::Node {
  explicit ScriptedNode(std::string its_name) : own_name(std::move(its_name)) {}
  std::string name() const override { return own_name; }
  messaging::NodeState state() const override { return own_state; }

  std::string own_name;
  messaging::NodeState own_state;
};

/// All that the experiment talks to, as simple as can be: every order is obeyed at once, every throw lands 1 cm
/// right of the centre. What is set to false is not answered.
class ScriptedPeers {
 public:
  explicit ScriptedPeers(messaging::LocalNetwork& network)
      : endpoint_(network.addEndpoint()),
        plans_(endpoint_, messaging::kSwingPlan),
        landings_(endpoint_, messaging::kLanding),
        truths_(endpoint_, messaging::kSimTruth),
        statuses_(endpoint_, messaging::kControllerStatus) {
    for (ScriptedNode* node : {&planner, &controller, &hand_server, &sim_bullet, &vision_tracker}) {
      network.addNode(*node, node == &planner ? endpoint_ : network.addEndpoint());
    }
    endpoint_.subscribe<plan_request_t>(messaging::kPlanRequest,
                                        [this](const auto& m) { plan(m); });
    endpoint_.subscribe<throw_start_t>(messaging::kThrowStart, [this](const auto& m) { arm(m); });
    endpoint_.subscribe<scene_t>(messaging::kScene, [this](const auto& m) { play(m); });
    endpoint_.subscribe<estop_t>(messaging::kEstop, [this](const auto& m) { estops.push_back(m); });
  }

  ScriptedNode planner{"planner"}, controller{"controller"}, hand_server{"hand_server"},
      sim_bullet{"sim_bullet"}, vision_tracker{"vision_tracker"};
  bool plans = true, arms = true, plays = true, measures = true;
  std::string refusal;  ///< of the planner
  std::string braked;   ///< why the arm brakes in mid-throw
  std::string kept;     ///< why the hand keeps the ball
  std::vector<plan_request_t> requests;
  std::vector<throw_start_t> starts;
  std::vector<scene_t> scenes;
  std::vector<estop_t> estops;

  /// The plan that the planner answers with.
  static swing_plan_t examplePlan() {
    swing_plan_t plan{};
    plan.plan_ms = 12.5;
    plan.t_ready = 1.0;
    plan.t_swing = 1.2;
    plan.t_swing_end = 1.6;
    plan.t_release_command = 1.45;
    plan.t_release = 1.5;
    plan.flight_time = 0.5;
    plan.v_WBall_release[0] = 6.0;
    plan.q_wrist[0] = 0.0;
    plan.dt = 0.01;
    plan.n_samples = 201;
    plan.q.assign(201, std::vector<double>(4, 0.0));
    plan.qd = plan.qdd = plan.q;
    return plan;
  }

 private:
  void plan(const plan_request_t& request) {
    requests.push_back(request);
    if (!plans)
      return;
    swing_plan_t plan = examplePlan();
    plan.plan_id = request.request_id;
    plan.strategy = request.strategy;
    plan.status = refusal.empty() ? swing_plan_t::OK : swing_plan_t::REFUSED;
    plan.message = refusal;
    plans_.publish(plan);
    for (ScriptedNode* node : {&controller, &hand_server, &vision_tracker}) {
      node->own_state = {"planned", "", request.request_id};
    }
  }

  void arm(const throw_start_t& start) {
    starts.push_back(start);
    if (!arms)
      return;
    controller.own_state = hand_server.own_state = {"armed", "", start.plan_id};
  }

  void play(const scene_t& scene) {
    scenes.push_back(scene);
    if (!plays)
      return;
    if (!braked.empty())
      brake(scene.scene_id);
    if (!kept.empty())
      hand_server.own_state = {"holding", kept, scene.scene_id};
    tell(sim_truth_t::RELEASED, 1, scene.scene_id);
    tell(sim_truth_t::LANDED, 2, scene.scene_id);
    tell(sim_truth_t::FINISHED, 3, scene.scene_id);
    sim_bullet.own_state = {"finished", "", scene.scene_id};
    if (!measures)
      return;
    landing_t landing{};
    landing.request_id = scene.scene_id;
    landing.measured = 1;
    landing.landing[0] = 0.01;
    landing.cov_landing[0] = 1e-6;
    landing.cov_landing[2] = 4e-6;
    landings_.publish(landing);
  }

  void brake(int64_t scene_id) {
    controller_status_t status{};
    status.utime = 1;
    status.scene_id = scene_id;
    status.phase = arm_command_t::BRAKE;
    status.message = braked;
    statuses_.publish(status);
  }

  void tell(int8_t event, int32_t index, int64_t scene_id) {
    sim_truth_t truth{};
    truth.scene_id = scene_id;
    truth.event = event;
    truth.event_index = index;
    truth.utime = int64_t{1000} * event;
    truth.v_WBall[0] = 3.0;
    truth.v_WBall[2] = 4.0;
    truth.landing[0] = 0.011;
    truths_.publish(truth);
  }

  messaging::Endpoint& endpoint_;
  messaging::Publisher<swing_plan_t> plans_;
  messaging::Publisher<landing_t> landings_;
  messaging::Publisher<sim_truth_t> truths_;
  messaging::Publisher<controller_status_t> statuses_;
};

}  // namespace fastball::launch
