#include "sim_bullet/scene_cameras.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "sim_bullet/scene_messages.h"

namespace fastball::sim_bullet {
namespace {

messaging::Channel<image_t> imageChannel(const std::string& name) {
  for (const auto& channel : {messaging::kCameraLeft, messaging::kCameraRight}) {
    if (name == channel.name)
      return channel;
  }
  throw std::invalid_argument(fmt::format("camera channel '{}' is none of {} and {}", name,
                                          messaging::kCameraLeft.name,
                                          messaging::kCameraRight.name));
}

}  // namespace

SceneCameras::SceneCameras(messaging::Endpoint& endpoint,
                           const CameraRigOptions& calibrated,
                           const config::Experiment& experiment,
                           const Uncertainty& uncertainty)
    : calibrated_(calibrated),
      experiment_(experiment),
      uncertainty_(uncertainty),
      infos_(endpoint, messaging::kCameraInfo) {
  for (const RigCamera& camera : calibrated.cameras)
    images_.emplace_back(endpoint, imageChannel(camera.channel));
}

void SceneCameras::place(int64_t set_up_seed, const Scene& scene) {
  if (rig_ && set_up_seed_ == set_up_seed)
    return;
  set_up_seed_ = set_up_seed;
  CameraRigOptions placed = calibrated_;
  placed.noise *= drawImageNoise(uncertainty_, set_up_seed);
  for (std::size_t i = 0; i < placed.cameras.size(); ++i) {
    model::Camera& camera = placed.cameras[i].camera;
    camera = movedCamera(camera, drawCameraErrors(uncertainty_, static_cast<int>(i), set_up_seed),
                         scene.errors().room);
  }
  rig_ = std::make_unique<CameraRig>(placed, experiment_.arm, experiment_.hand,
                                     scene.errors().ball.radius);
}

void SceneCameras::beginScene(const scene_t& message, const Scene& scene) {
  place(message.set_up_seed, scene);
  const auto us = [&](double seconds) {
    return message.utime + std::llround(std::min(seconds, message.duration) * 1e6);
  };
  rig_->begin(message.scene_id, message.seed, us(message.camera_start), us(message.camera_end),
              scene.target());
  rig_->add(scene.snapshot(message.utime));
}

void SceneCameras::sayInfo(int64_t utime) {
  for (const RigCamera& camera : calibrated_.cameras) {
    camera_info_t message = cameraInfo(camera, utime);
    infos_.publish(message);
  }
}

void SceneCameras::sayImages() {
  while (rig_->nextImage(rendered_)) {
    image_t message = image(rendered_);
    images_[static_cast<std::size_t>(rendered_.camera)].publish(message);
  }
}

void SceneCameras::finish() {
  rig_->flush();
  sayImages();
}

}  // namespace fastball::sim_bullet
