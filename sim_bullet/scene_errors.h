#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>

#include "model/arm_parameters.h"
#include "model/ball_parameters.h"
#include "model/camera.h"
#include "model/hand_parameters.h"
#include "model/target.h"
#include "sim_bullet/uncertainty.h"

namespace fastball::sim_bullet {

/// Seeds of what is drawn for a scene.
struct SceneSeeds {
  int64_t set_up = 0;  ///< of what is fixed in a set-up
  int64_t scene = 0;   ///< of what is drawn anew for each throw
};

/// Where things in the room really are, as seen from the arm. The arm's foot is level: it stands on gravity, not on a map.
struct RoomErrors {
  Eigen::Isometry3d X_WRoom = Eigen::Isometry3d::Identity();  ///< the room the arm believes in -> W
  Eigen::Vector3d p_RoomTarget_offset = Eigen::Vector3d::Zero();  ///< [m], of the net in the room

  /// The net as it really stands, for the one that was ordered.
  model::Target target(model::Target ordered) const;
};

/// A camera that is not where its calibration says.
struct CameraErrors {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< [m], in the room
  Eigen::Vector3d rotation = Eigen::Vector3d::Zero();  ///< [rad], rotation vector, in the camera
};

/// The errors of one scene.
struct SceneErrors {
  Eigen::Vector3d ball_offset_H = Eigen::Vector3d::Zero();   ///< [m]
  Eigen::Vector4d encoder_offset = Eigen::Vector4d::Zero();  ///< [rad]
  double encoder_noise = 0;                                  ///< [rad], standard deviation
  std::array<double, model::kFingers> finger_delay{};        ///< [s], of the commands
  std::array<double, model::kFingers> unevenness{1, 1, 1};   ///< of the modulus under a finger
  double finger_lag = 1;                                     ///< factor
  double joint_friction = 1;                                 ///< factor
  model::BallParameters ball;                                ///< as it really is
  RoomErrors room;
};

/// The same for the same seeds. Each error has random numbers of its own: one more leaves the others as they are.
SceneErrors drawErrors(const Uncertainty& uncertainty,
                       const model::BallParameters& ball,
                       const SceneSeeds& seeds);

/// Of the set-up's camera with this index; a throw does not move cameras.
CameraErrors drawCameraErrors(const Uncertainty& uncertainty, int camera, int64_t set_up_seed);
/// Factor on the images' noise in the set-up.
double drawImageNoise(const Uncertainty& uncertainty, int64_t set_up_seed);

/// The camera as it really stands.
model::Camera movedCamera(model::Camera calibrated,
                          const CameraErrors& errors,
                          const RoomErrors& room);

}  // namespace fastball::sim_bullet
