#include "camera/camera_info.h"

namespace fastball::camera {

camera_info_t infoMessage(const model::Camera& camera) {
  using RowMajor = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
  camera_info_t m{};
  m.width = camera.width;
  m.height = camera.height;
  Eigen::Map<RowMajor>{m.K} << camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1;
  Eigen::Map<Eigen::Matrix<double, 5, 1>>{m.D} = camera.distortion;
  Eigen::Map<RowMajor>{m.R_CW} = camera.R_CW;
  Eigen::Map<Eigen::Vector3d>{m.p_CW} = camera.p_CW;
  return m;
}

}  // namespace fastball::camera
