#pragma once

#include <functional>
#include <vector>

#include "messaging/endpoint.h"
#include "tests/sim_bullet/test_scene.h"

namespace fastball::sim_bullet {

/// SCENE as the experiment says it, at rest and with the default target.
inline scene_t sceneMessage(int64_t scene_id, double duration) {
  scene_t scene{};
  scene.utime = scene_id * 10'000'000;
  scene.scene_id = scene_id;
  scene.seed = 1;
  for (int i = 0; i < 4; ++i)
    scene.q_arm[i] = experiment().q_rest[i];
  scene.duration = duration;
  scene.camera_start = 0;
  scene.camera_end = duration;
  for (int i = 0; i < 3; ++i) {
    scene.p_WTarget[i] = experiment().target.p_WTarget[i];
    scene.n_WTarget[i] = experiment().target.n_WTarget[i];
  }
  scene.target_radius = experiment().target.radius;
  return scene;
}

/// Stands in for controller and hand server: answers each state, as told, and remembers what the simulator says.
class ScriptedPeers {
 public:
  explicit ScriptedPeers(messaging::Endpoint& endpoint)
      : scenes_(endpoint, messaging::kScene),
        arm_commands_(endpoint, messaging::kArmCommand),
        hand_commands_(endpoint, messaging::kHandCommand) {
    endpoint.subscribe<arm_state_t>(messaging::kArmState, [this](const arm_state_t& m) {
      arm_states.push_back(m);
      if (answers_arm)
        sendArm(armCommand(m));
    });
    endpoint.subscribe<hand_state_t>(messaging::kHandState, [this](const hand_state_t& m) {
      hand_states.push_back(m);
      if (answers_hand)
        sendHand(handCommandFor(m));
    });
    endpoint.subscribe<sim_truth_t>(messaging::kSimTruth,
                                    [this](const sim_truth_t& m) { truths.push_back(m); });
  }

  /// Holds the arm with some torque that depends on the state alone.
  arm_command_t armCommand(const arm_state_t& state) const {
    static const model::Arm arm(experiment().arm, experiment().hand.payload);
    const Eigen::Vector4d tau = arm.gravityTorque(Eigen::Map<const Eigen::Vector4d>(state.q));
    arm_command_t command{};
    command.utime = state.utime;
    command.scene_id = state.scene_id;
    command.tick = state.tick;
    for (int i = 0; i < 4; ++i)
      command.tau[i] = tau[i] - 5 * state.qd[i] + push;
    return command;
  }
  static hand_command_t handCommandFor(const hand_state_t& state) {
    static const HandCommand grasp = graspCommand(3);
    hand_command_t command{};
    command.utime = state.utime;
    command.scene_id = state.scene_id;
    command.tick = state.tick;
    for (int i = 0; i < model::kHandJoints; ++i) {
      command.q[i] = grasp.q[i];
      command.tau[i] = grasp.tau[i];
      command.kp[i] = grasp.kp[i];
      command.kd[i] = grasp.kd[i];
    }
    return command;
  }

  void sendScene(scene_t scene) { scenes_.publish(scene); }
  void sendArm(arm_command_t command) { arm_commands_.publish(command); }
  void sendHand(hand_command_t command) { hand_commands_.publish(command); }
  int64_t tick() const { return arm_states.empty() ? -1 : arm_states.back().tick; }
  int count(int8_t event) const {
    int n = 0;
    for (const sim_truth_t& truth : truths)
      n += truth.event == event;
    return n;
  }

  bool answers_arm = true;
  bool answers_hand = true;
  double push = 0;  ///< [N m], on every joint
  std::vector<arm_state_t> arm_states;
  std::vector<hand_state_t> hand_states;
  std::vector<sim_truth_t> truths;

 private:
  messaging::Publisher<scene_t> scenes_;
  messaging::Publisher<arm_command_t> arm_commands_;
  messaging::Publisher<hand_command_t> hand_commands_;
};

}  // namespace fastball::sim_bullet
