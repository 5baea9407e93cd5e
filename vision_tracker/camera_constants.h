#pragma once

#include <Eigen/Core>
#include <vector>

#include "model/camera.h"

namespace fastball::vision_tracker {

/// How far one camera, and what is measured in its images, is from what is assumed of it, the same through a flight:
/// bias of the centres [px] (2); rotation of the camera [rad] (3), R_CW true = exp([rotation]x) R_CW assumed; position of the
/// camera [m] in the world (3); focal length, relative (1). True minus assumed.
constexpr int kCameraConstants = 9;
using CameraConstants = Eigen::Matrix<double, kCameraConstants, 1>;

/// How well each camera's calibration is known: standard deviations per axis.
struct CalibrationSigma {
  double rotation = 0;      ///< [rad]
  double position = 0;      ///< [m]
  double focal_length = 0;  ///< relative
};

/// Variances of one camera's constants. @param bias_sigma [px]
CameraConstants constantVariances(double bias_sigma, const CalibrationSigma& calibration);

/// d centre [px] / d constants, of a point or outline at p_W [m] whose centre lies at pixel
/// `centre`.
/// @param projection d centre / d p_W [px/m]
Eigen::Matrix<double, 2, kCameraConstants> byConstants(
    const model::Camera& camera,
    const Eigen::Vector3d& p_W,
    const Eigen::Vector2d& centre,
    const Eigen::Matrix<double, 2, 3>& projection);

/// Variance of a constant that is known: far below what any image shows.
constexpr double kLeastVariance = 1e-16;

/// What a fit's residuals say of the constants c of all cameras, one camera's after another's, when the fit itself follows them
/// (x moves by gain c): the log likelihood is -c' information c / 2 + gradient' c.
struct ConstantsEvidence {
  Eigen::MatrixXd information;
  Eigen::VectorXd gradient;
};

/// Gathers it, with W the weights, G = d prediction / d constants, J = d prediction / d x.
/// @param squares sum G^T W G of each camera @param gradients sum G^T W residual of each camera
/// @param sums sum J^T W G of each camera @param cov inverse of the fit's information
ConstantsEvidence evidenceOf(
    const std::vector<Eigen::Matrix<double, kCameraConstants, kCameraConstants>>& squares,
    const std::vector<CameraConstants>& gradients,
    const std::vector<Eigen::MatrixXd>& sums,
    const Eigen::MatrixXd& cov);

/// The camera that is meant if `camera` is assumed; the bias has no part in it.
model::Camera displaced(const model::Camera& camera, const CameraConstants& constants);

}  // namespace fastball::vision_tracker
