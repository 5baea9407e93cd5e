#pragma once

#include "config/experiment.h"
#include "model/grasp.h"
#include "sim_bullet/config.h"
#include "sim_bullet/scene.h"

namespace fastball::bench {

/// The hand command that holds the ball by the planned grasp's forces and postures.
inline sim_bullet::HandCommand graspCommand(const config::Experiment& experiment,
                                            double grip_force) {
  const model::Hand hand(experiment.hand);
  const model::GraspGeometry grasp = model::grasp(experiment.ball, hand, grip_force);
  sim_bullet::HandCommand command;
  command.q = grasp.q;
  command.kp.setConstant(40);
  command.kd.setConstant(0.1);
  for (const model::Finger finger : {model::kFingerA, model::kThumb, model::kFingerB}) {
    const int proximal = model::Hand::proximalJoint(finger);
    command.tau[proximal] = grasp.fingers[finger].torque[1];
    command.tau[proximal + 1] = grasp.fingers[finger].torque[2];
  }
  return command;
}

/// The default experiment's arm at rest, braked, with the ball between its fingers and the feeder gone.
class HeldBall {
 public:
  HeldBall();
  /// One tick of 1 ms.
  void tick() { scene_.brake(command_); }
  const sim_bullet::Scene& scene() const { return scene_; }
  const config::Experiment& experiment() const { return experiment_; }
  const sim_bullet::SimulationSettings& settings() const { return settings_; }
  const sim_bullet::HandCommand& command() const { return command_; }

 private:
  config::Experiment experiment_;
  sim_bullet::SimulationSettings settings_;
  sim_bullet::HandCommand command_;
  sim_bullet::Scene scene_;
};

}  // namespace fastball::bench
