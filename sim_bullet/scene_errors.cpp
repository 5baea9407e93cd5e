#include "sim_bullet/scene_errors.h"

#include <algorithm>
#include <string_view>

namespace fastball::sim_bullet {
namespace {

/// FNV-1a: the same on every machine, as std::hash need not be.
uint64_t hashOf(std::string_view text) {
  uint64_t hash = 0xcbf29ce484222325;
  for (const char c : text)
    hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3;
  return hash;
}

std::mt19937_64 engineFor(int64_t seed, const ErrorName& error, int index) {
  const auto bits = static_cast<uint64_t>(seed);
  const uint64_t name = hashOf(error.name);
  std::seed_seq sequence{static_cast<uint32_t>(bits), static_cast<uint32_t>(bits >> 32),
                         static_cast<uint32_t>(name), static_cast<uint32_t>(name >> 32),
                         static_cast<uint32_t>(index)};
  return std::mt19937_64(sequence);
}

/// Draws of one part of the uncertainty.
class PartDraw {
 public:
  PartDraw(const Uncertainty& uncertainty, Uncertainty::Part part, int64_t seed)
      : uncertainty_(uncertainty),
        part_(part),
        // A scene whose two seeds are the same number must not draw the same twice.
        seed_(part == Uncertainty::kSetUp ? ~seed : seed) {}

  /// @param index of what the error is drawn for several times: an axis, a joint, a finger.
  double operator()(Error error, int index = 0) const {
    const Uncertainty::Size& size = uncertainty_.of(part_, error);
    if (size.distribution.shape == Distribution::Shape::kNone)
      return 0;
    std::mt19937_64 engine = engineFor(seed_, errorNames()[static_cast<std::size_t>(error)], index);
    return size.distribution.draw(engine, size.size);
  }

 private:
  const Uncertainty& uncertainty_;
  Uncertainty::Part part_;
  int64_t seed_;
};

/// Draws of both parts together.
class Draw {
 public:
  Draw(const Uncertainty& uncertainty, const SceneSeeds& seeds)
      : set_up_(uncertainty, Uncertainty::kSetUp, seeds.set_up),
        throw_(uncertainty, Uncertainty::kThrow, seeds.scene) {}

  double offset(Error error, int index = 0) const {
    return set_up_(error, index) + throw_(error, index);
  }
  double factor(Error error, int index = 0) const {
    return std::max(kLeastFactor, 1 + set_up_(error, index)) *
           std::max(kLeastFactor, 1 + throw_(error, index));
  }
  Eigen::Vector3d axes(Error error) const {
    return {offset(error, 0), offset(error, 1), offset(error, 2)};
  }

 private:
  PartDraw set_up_, throw_;
};

}  // namespace

model::Target RoomErrors::target(model::Target ordered) const {
  ordered.p_WTarget = X_WRoom * Eigen::Vector3d(ordered.p_WTarget + p_RoomTarget_offset);
  ordered.n_WTarget = X_WRoom.linear() * ordered.n_WTarget;
  return ordered;
}

SceneErrors drawErrors(const Uncertainty& uncertainty,
                       const model::BallParameters& ball,
                       const SceneSeeds& seeds) {
  const Draw draw(uncertainty, seeds);
  SceneErrors errors;
  errors.ball_offset_H = draw.axes(Error::kGraspOffset);
  for (int i = 0; i < model::kArmJoints; ++i)
    errors.encoder_offset[i] = draw.offset(Error::kEncoderOffset, i);
  const Uncertainty::Size& noise = uncertainty.of(Uncertainty::kThrow, Error::kEncoderNoise);
  if (noise.distribution.shape != Distribution::Shape::kNone)
    errors.encoder_noise = noise.size * noise.distribution.a;
  const double opening = draw.offset(Error::kOpeningDelay);
  for (std::size_t i = 0; i < errors.finger_delay.size(); ++i) {
    const int finger = static_cast<int>(i);
    errors.finger_delay[i] = opening + draw.offset(Error::kFingerDelay, finger);
    errors.unevenness[i] = draw.factor(Error::kUnevenness, finger);
  }
  errors.finger_lag = draw.factor(Error::kFingerLag);
  errors.joint_friction = draw.factor(Error::kJointFriction);
  errors.ball = ball;
  errors.ball.mass *= draw.factor(Error::kBallMass);
  errors.ball.radius *= draw.factor(Error::kBallRadius);
  errors.ball.drag_coefficient *= draw.factor(Error::kDrag);
  errors.ball.youngs_modulus *= draw.factor(Error::kStiffness);
  errors.ball.friction *= draw.factor(Error::kFriction);
  // Where the arm is in the room, seen from the arm: the room the other way.
  const Eigen::AngleAxisd yaw(-draw.offset(Error::kBaseYaw), Eigen::Vector3d::UnitZ());
  errors.room.X_WRoom.linear() = yaw.toRotationMatrix();
  errors.room.X_WRoom.translation() = yaw * Eigen::Vector3d(-draw.axes(Error::kBasePosition));
  errors.room.p_RoomTarget_offset = draw.axes(Error::kTargetPosition);
  return errors;
}

CameraErrors drawCameraErrors(const Uncertainty& uncertainty, int camera, int64_t set_up_seed) {
  const PartDraw draw(uncertainty, Uncertainty::kSetUp, set_up_seed);
  CameraErrors errors;
  for (int axis = 0; axis < 3; ++axis) {
    errors.position[axis] = draw(Error::kCameraPosition, 3 * camera + axis);
    errors.rotation[axis] = draw(Error::kCameraRotation, 3 * camera + axis);
  }
  return errors;
}

double drawImageNoise(const Uncertainty& uncertainty, int64_t set_up_seed) {
  return std::max(kLeastFactor,
                  1 + PartDraw(uncertainty, Uncertainty::kSetUp, set_up_seed)(Error::kImageNoise));
}

model::Camera movedCamera(model::Camera calibrated,
                          const CameraErrors& errors,
                          const RoomErrors& room) {
  // X_CRoom = X_turn X_CW(calibrated) shifted, and W is the room moved by X_WRoom.
  Eigen::Isometry3d X_CRoom = Eigen::Isometry3d::Identity();
  X_CRoom.linear() = calibrated.R_CW;
  X_CRoom.translation() = calibrated.p_CW - calibrated.R_CW * errors.position;
  const double angle = errors.rotation.norm();
  if (angle > 0)
    X_CRoom = Eigen::AngleAxisd(angle, errors.rotation / angle) * X_CRoom;
  const Eigen::Isometry3d X_CW = X_CRoom * room.X_WRoom.inverse();
  calibrated.R_CW = X_CW.linear();
  calibrated.p_CW = X_CW.translation();
  return calibrated;
}

}  // namespace fastball::sim_bullet
