#include "vision_tracker/camera_message.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <cmath>

namespace fastball::vision_tracker {
namespace {

// What no camera exceeds; with it no pixel leaves its number type.
constexpr double kFarthest = 1000;     // [m], from the world's origin
constexpr double kLongestFocus = 1e6;  // [px]
constexpr double kLargestDistortion = 1e3;
constexpr double kSlowest = 0.1, kFastest = 1e5;  // [Hz]
constexpr double kLongestExposure = 1;            // [s]

}  // namespace

CameraSetup cameraSetup(const camera_info_t& m) {
  using RowMajor = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
  CameraSetup setup;
  setup.rate = m.rate;
  setup.exposure = m.exposure;
  model::Camera& camera = setup.camera;
  camera.width = m.width;
  camera.height = m.height;
  camera.fx = m.K[0];
  camera.fy = m.K[4];
  camera.cx = m.K[2];
  camera.cy = m.K[5];
  camera.distortion = Eigen::Map<const Eigen::Matrix<double, 5, 1>>(m.D);
  camera.R_CW = Eigen::Map<const RowMajor>(m.R_CW);
  camera.p_CW = Eigen::Map<const Eigen::Vector3d>(m.p_CW);
  return setup;
}

std::string cameraFault(const camera_info_t& m) {
  const CameraSetup setup = cameraSetup(m);
  const auto& K = m.K;
  const model::Camera& c = setup.camera;
  const double off = (c.R_CW * c.R_CW.transpose() - Eigen::Matrix3d::Identity()).norm();
  if (!(off < 1e-6 && c.R_CW.determinant() > 0))
    return fmt::format("R_CW is no rotation: R R^T differs from the identity by {:.2g}", off);
  if (!(c.fx > 0 && c.fy > 0 && c.fx < kLongestFocus && c.fy < kLongestFocus))
    return fmt::format("its focal lengths are {} and {} px, must be positive and below {}", c.fx,
                       c.fy, kLongestFocus);
  if (K[1] != 0 || K[3] != 0 || K[6] != 0 || K[7] != 0 || K[8] != 1)
    return "its K is not [fx 0 cx; 0 fy cy; 0 0 1]";
  if (!(std::abs(c.cx) < 2 * c.width && std::abs(c.cy) < 2 * c.height))
    return fmt::format("its principal point ({}, {}) px lies far outside of {} x {}", c.cx, c.cy,
                       c.width, c.height);
  if (!(c.distortion.cwiseAbs().maxCoeff() < kLargestDistortion))
    return fmt::format("a distortion coefficient exceeds {}", kLargestDistortion);
  if (!(c.p_CW.norm() < kFarthest))
    return fmt::format("it stands {:.0f} m from the world's origin, at most {} are sensible",
                       c.p_CW.norm(), kFarthest);
  if (!(setup.rate > kSlowest && setup.rate < kFastest && setup.exposure < kLongestExposure))
    return fmt::format("its rate is {} Hz and its exposure {} s, must be in [{}, {}] and below {}",
                       setup.rate, setup.exposure, kSlowest, kFastest, kLongestExposure);
  return {};
}

}  // namespace fastball::vision_tracker
