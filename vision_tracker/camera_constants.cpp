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

ConstantsEvidence evidenceOf(
    const std::vector<Eigen::Matrix<double, kCameraConstants, kCameraConstants>>& squares,
    const std::vector<CameraConstants>& gradients,
    const std::vector<Eigen::MatrixXd>& sums,
    const Eigen::MatrixXd& cov) {
  const auto cameras = static_cast<Eigen::Index>(squares.size());
  const Eigen::Index n = kCameraConstants;
  ConstantsEvidence evidence{Eigen::MatrixXd::Zero(n * cameras, n * cameras),
                             Eigen::VectorXd::Zero(n * cameras)};
  for (Eigen::Index a = 0; a < cameras; ++a) {
    const auto i = static_cast<std::size_t>(a);
    evidence.information.block(n * a, n * a, n, n) = squares[i];
    evidence.gradient.segment(n * a, n) = gradients[i];
    for (Eigen::Index b = 0; b < cameras; ++b)
      evidence.information.block(n * a, n * b, n, n) -=
          sums[i].transpose() * cov * sums[static_cast<std::size_t>(b)];
  }
  return evidence;
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
