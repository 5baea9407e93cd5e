#include "sim_bullet/camera_config.h"

#include <Eigen/Geometry>
#include <set>
#include <stdexcept>

#include "config/experiment.h"

namespace fastball::sim_bullet {
namespace {

constexpr config::Range kPlace{-100, 100};  // [m]

RigCamera readView(config::Section section, int width, int height) {
  RigCamera view;
  view.channel = section.choice("channel", {"CAMERA_LEFT", "CAMERA_RIGHT"});
  model::Camera& camera = view.camera;
  camera.width = width;
  camera.height = height;
  camera.fx = camera.fy = section.number("focal_length", {50, 1e5});
  const Eigen::Vector2d centre = section.vector("principal_point", 2, {0, 1e5});
  camera.cx = centre.x();
  camera.cy = centre.y();
  const Eigen::Vector3d k = section.vector("radial_distortion", 3, {-1, 1});
  camera.distortion << k[0], k[1], 0, 0, k[2];
  const Eigen::Vector3d p_WCamera = section.vector("position", 3, kPlace);
  const Eigen::Vector3d p_WLookAt = section.vector("look_at", 3, kPlace);
  try {
    lookAt(p_WCamera, p_WLookAt, camera);
  } catch (const std::invalid_argument& error) {
    throw section.error("look_at", error.what());
  }
  section.finish();
  return view;
}

}  // namespace

void lookAt(const Eigen::Vector3d& p_WCamera,
            const Eigen::Vector3d& p_WLookAt,
            model::Camera& camera) {
  const Eigen::Vector3d forward = p_WLookAt - p_WCamera;
  const Eigen::Vector3d right = forward.cross(Eigen::Vector3d::UnitZ());
  if (!(right.norm() > 1e-6 * forward.norm()))
    throw std::invalid_argument("lies straight above, below or at the camera's position");
  camera.R_CW.row(0) = right.normalized();
  camera.R_CW.row(2) = forward.normalized();
  camera.R_CW.row(1) = camera.R_CW.row(2).cross(camera.R_CW.row(0));
  camera.p_CW = -camera.R_CW * p_WCamera;
}

CameraRigOptions readCameraRig(const std::string& path) {
  config::Section section = config::processSection(path, "cameras");
  CameraRigOptions options;
  const int width = section.integer("width", 64, 4096);
  const int height = section.integer("height", 64, 4096);
  const double rate = section.number("rate", {1, 1000});
  const double exposure = section.number("exposure", {1e-5, 1 / rate});
  options.noise = section.number("noise", {0, 50});
  options.blur = section.number("blur", {0.3, 5});
  options.jpeg_quality = section.integer("jpeg_quality", 1, 100);
  options.workers = section.integer("workers", 0, 16);
  const Eigen::Vector3d to_light_W = section.vector("light", 3);
  if (!(to_light_W.norm() > 1e-6))
    throw section.error("light", "has no direction");
  options.to_light_W = to_light_W.normalized();
  std::set<std::string> channels;
  for (config::Section& view : section.sections("views")) {
    RigCamera camera = readView(view, width, height);
    camera.rate = rate;
    camera.exposure = exposure;
    if (!channels.insert(camera.channel).second)
      throw view.error("channel", "'" + camera.channel + "' is given to two cameras");
    options.cameras.push_back(camera);
  }
  section.finish();
  if (options.cameras.empty())
    throw section.error("views", "is empty, there must be a camera");
  return options;
}

}  // namespace fastball::sim_bullet
