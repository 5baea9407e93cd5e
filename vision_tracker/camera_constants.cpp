#include "vision_tracker/camera_constants.h"

#include <Eigen/Geometry>

namespace fastball::vision_tracker {

CameraConstants constantVariances(double bias_sigma, const CalibrationSigma& calibration) {
  CameraConstants sigma;
  sigma << Eigen::Vector2d::Constant(bias_sigma), Eigen::Vector3d::Constant(calibration.rotation),
      Eigen::Vector3d::Constant(calibration.position), calibration.focal_length;
  return sigma.cwiseAbs2();
}

Eigen::Matrix<double, 2, kCameraConstants> byConstants(
    const model::Camera& camera,
    const Eigen::Vector3d& p_W,
    const Eigen::Vector2d& centre,
    const Eigen::Matrix<double, 2, 3>& projection) {
  const Eigen::Vector3d p_C = camera.toCamera(p_W);
  Eigen::Matrix3d cross;
  cross << 0, -p_C.z(), p_C.y(), p_C.z(), 0, -p_C.x(), -p_C.y(), p_C.x(), 0;
  Eigen::Matrix<double, 2, kCameraConstants> derivative;
  derivative << Eigen::Matrix2d::Identity(), -projection * camera.R_CW.transpose() * cross,
      -projection, centre - Eigen::Vector2d(camera.cx, camera.cy);
  return derivative;
}

model::Camera displaced(const model::Camera& camera, const CameraConstants& constants) {
  model::Camera moved = camera;
  const Eigen::Vector3d turn = constants.segment<3>(2);
  const Eigen::Vector3d p_WCamera =
      -camera.R_CW.transpose() * camera.p_CW + constants.segment<3>(5);
  if (turn.norm() > 0)
    moved.R_CW = Eigen::AngleAxisd(turn.norm(), turn.normalized()) * camera.R_CW;
  moved.p_CW = -moved.R_CW * p_WCamera;
  moved.fx *= 1 + constants[8];
  moved.fy *= 1 + constants[8];
  return moved;
}

}  // namespace fastball::vision_tracker
