#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "config/experiment.h"
#include "model/arm.h"
#include "sim_bullet/actuators.h"
#include "sim_bullet/arm_hand.h"
#include "sim_bullet/ball_contact.h"
#include "sim_bullet/config.h"
#include "sim_bullet/encoder_noise.h"
#include "sim_bullet/feeder.h"
#include "sim_bullet/landing_judge.h"
#include "sim_bullet/net_bag.h"
#include "sim_bullet/scene_errors.h"
#include "sim_bullet/snapshot.h"
#include "sim_bullet/tactile_sensor.h"
#include "sim_bullet/world.h"

namespace fastball::sim_bullet {

/// Control tick [s]: commands hold for this long.
inline constexpr double kTick = 1e-3;

/// What the robot's sensors say at a tick.
struct RobotState {
  Eigen::Vector4d q_arm, qd_arm;                      ///< [rad], [rad/s], as the encoders read
  Eigen::Vector4d tau_arm = Eigen::Vector4d::Zero();  ///< [N m], motors, mean over the tick before
  JointVectors q, qd;                                 ///< as they are
  model::HandVector tau_hand =
      model::HandVector::Zero();  ///< [N m], drives, mean over the tick before
  FingertipForces forces;         ///< mean over the tick before, as it is
  FingertipForces felt;           ///< as the fingertips' sensors read
};

/// What a scene begins with.
struct SceneStart {
  SceneSeeds seeds;
  Eigen::Vector4d q_arm = Eigen::Vector4d::Zero();  ///< [rad], at rest
  model::Target target;                             ///< as ordered
};

/// One throw from start to end in a fresh world: arm at rest, fingers open, the ball held in the hand by the feeder.
/// advance() steps the physics through one control tick. The same start and the same commands give the same scene bit for bit.
class Scene {
 public:
  /// @throw std::invalid_argument if the arm would start past a stop, or the hand cannot open around the ball.
  Scene(const config::Experiment& experiment,
        const SimulationSettings& settings,
        const Uncertainty& uncertainty,
        const SceneStart& start);

  /// One tick under motor torques [N m] (clipped to the limits) and hand commands that hold through it.
  void advance(const Eigen::Vector4d& tau_arm, const HandCommand& hand);
  /// One tick with the arm braked: damping and gravity compensation instead of a command.
  void brake(const HandCommand& hand);

  int64_t tick() const { return tick_; }
  const RobotState& state() const { return state_; }
  BallMotion ball() const { return world_.ball(); }
  /// Events of the last tick, in order.
  const std::vector<SceneEvent>& events() const { return events_; }
  /// What a camera sees; `start_utime`: simulated time [us] of tick 0.
  SceneSnapshot snapshot(int64_t start_utime) const;
  /// False once any number of the state has stopped being finite.
  bool healthy() const;
  /// The command that keeps the open hand as it is at the start, for the time before the first command.
  const HandCommand& openHand() const { return open_hand_; }
  const SceneErrors& errors() const { return errors_; }
  /// The net as it really stands.
  const model::Target& target() const { return target_; }

 private:
  void tickWith(const Eigen::Vector4d* tau_arm, const HandCommand& hand);
  void substep(const Eigen::Vector4d* tau_arm, const HandCommand& hand, double dt);
  void pushBall(double dt, JudgedStep* judged);
  void readState();

  SimulationSettings settings_;
  SceneErrors errors_;
  model::Arm arm_;  ///< with the hand it carries: friction, limits, gravity
  double gravity_;
  model::Target target_;  ///< as it really stands
  HandCommand open_hand_;
  ArmHand arm_hand_;
  World world_;
  BallContacts contacts_;
  HandServo servo_;
  TactileSensor tactile_;
  EncoderNoise encoder_noise_;
  JointStops stops_;
  Feeder feeder_;
  NetBag bag_;
  LandingJudge judge_;
  int64_t tick_ = 0;
  int64_t substep_ = 0;
  RobotState state_;
  std::vector<SceneEvent> events_;
};

}  // namespace fastball::sim_bullet
