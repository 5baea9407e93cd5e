#pragma once

#include <vector>

#include "bench/synthetic_throw.h"
#include "lcmtypes/fastball_types.h"
#include "tests/vision_tracker/experiment_path.h"

namespace fastball::testing {

/// The messages of the cameras and of the experiment for a synthetic throw.
inline plan_request_t requestMessage(const config::Experiment& experiment, int64_t request_id) {
  plan_request_t m{};
  m.request_id = request_id;
  m.strategy = "paper";
  Eigen::Map<Eigen::Vector3d>{m.p_WTarget} = experiment.target.p_WTarget;
  Eigen::Map<Eigen::Vector3d>{m.n_WTarget} = experiment.target.n_WTarget;
  m.target_radius = experiment.target.radius;
  return m;
}

inline camera_info_t infoMessage(const sim_bullet::RigCamera& rig) {
  const model::Camera& camera = rig.camera;
  camera_info_t m{};
  m.channel = rig.channel;
  m.width = camera.width;
  m.height = camera.height;
  const Eigen::Matrix3d K =
      (Eigen::Matrix3d() << camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1).finished();
  Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>{m.K} = K;
  Eigen::Map<Eigen::Matrix<double, 5, 1>>{m.D} = camera.distortion;
  Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>{m.R_CW} = camera.R_CW;
  Eigen::Map<Eigen::Vector3d>{m.p_CW} = camera.p_CW;
  m.rate = rig.rate;
  m.exposure = rig.exposure;
  return m;
}

inline image_t imageMessage(const sim_bullet::RenderedImage& image) {
  image_t m{};
  m.utime = image.utime;
  m.seq = image.frame;
  m.width = image.width;
  m.height = image.height;
  m.row_stride = image.width;
  m.pixelformat = image_t::MJPEG;
  m.size = static_cast<int32_t>(image.jpeg.size());
  m.data = image.jpeg;
  return m;
}

}  // namespace fastball::testing
