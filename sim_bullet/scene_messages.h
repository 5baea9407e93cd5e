#pragma once

#include <cstdint>

#include "messaging/channels.h"
#include "sim_bullet/camera_rig.h"
#include "sim_bullet/scene.h"

/// Between the simulator's own types and the messages; seq is the publisher's.
namespace fastball::sim_bullet {

/// Which tick of which scene a state belongs to.
struct TickStamp {
  int64_t utime = 0;  ///< [us], simulated
  int64_t scene_id = 0;
  int64_t tick = 0;
};

/// The arm as its encoders read; the hand's joints as they are, its forces as they are felt.
arm_state_t armState(const TickStamp& stamp, const RobotState& state);
hand_state_t handState(const TickStamp& stamp, const RobotState& state);
/// A SAMPLE or FINISHED of SIM_TRUTH.
sim_truth_t truth(const TickStamp& stamp,
                  int8_t event,
                  const BallMotion& ball,
                  const Eigen::Vector4d& q_arm);
/// `start_utime`: of tick 0 [us].
sim_truth_t truth(const SceneEvent& event,
                  int64_t start_utime,
                  int64_t scene_id,
                  const Eigen::Vector4d& q_arm);
/// What the light curtain says of a landing; null: of a ball that never crossed it. Its noise follows the seed.
landing_t curtainLanding(const TickStamp& stamp,
                         const SceneEvent* landed,
                         const CurtainSettings& curtain,
                         int64_t seed);
camera_info_t cameraInfo(const RigCamera& camera, int64_t utime);
image_t image(const RenderedImage& rendered);

/// [N m].
Eigen::Vector4d armTorque(const arm_command_t& message);
HandCommand handCommand(const hand_command_t& message);
SceneStart sceneStart(const scene_t& message);

}  // namespace fastball::sim_bullet
