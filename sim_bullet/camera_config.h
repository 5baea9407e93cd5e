#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "model/camera.h"

namespace fastball::sim_bullet {

/// One camera of the rig: where its images go and how it sees.
struct RigCamera {
  std::string channel;  ///< channel of its images, e.g. "CAMERA_LEFT"
  model::Camera camera;
  double rate = 0;      ///< [Hz]
  double exposure = 0;  ///< [s]
};

/// The section `cameras` of the experiment file.
struct CameraRigOptions {
  std::vector<RigCamera> cameras;  ///< all with the same image size, rate and exposure
  double noise = 0;                ///< [grey levels], standard deviation
  double blur = 0;                 ///< [px], standard deviation of lens and pixel together
  int jpeg_quality = 0;            ///< 1..100
  int workers = 0;                 ///< threads that draw; 0: the caller's own
  Eigen::Vector3d to_light_W = Eigen::Vector3d::UnitZ();  ///< unit vector towards the lamp
};

/// Camera frame at p_WCamera [m]: z towards p_WLookAt, x horizontal to the right, y down.
/// @throw std::invalid_argument if the two points lie on one vertical line.
void lookAt(const Eigen::Vector3d& p_WCamera,
            const Eigen::Vector3d& p_WLookAt,
            model::Camera& camera);

/// Reads the section of an experiment file. @throw config::ConfigError
CameraRigOptions readCameraRig(const std::string& path);

}  // namespace fastball::sim_bullet
