#include "sim_bullet/scene_cameras.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "sim_bullet/scene_messages.h"

namespace fastball::sim_bullet {
namespace {

std::vector<std::string> channels(const CameraRigOptions& rig) {
  std::vector<std::string> names;
  for (const RigCamera& camera : rig.cameras)
    names.push_back(camera.channel);
  return names;
}

}  // namespace

SceneCameras::SceneCameras(messaging::Endpoint& endpoint,
                           const messaging::Clock& clock,
                           bool lockstep,
                           const CameraRigOptions& calibrated,
                           const config::Experiment& experiment,
                           const Uncertainty& uncertainty)
    : calibrated_(calibrated),
      experiment_(experiment),
      uncertainty_(uncertainty),
      infos_(endpoint, messaging::kCameraInfo),
      images_(endpoint, clock, channels(calibrated), lockstep) {}

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
  images_.beginScene();
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

void SceneCameras::collectImages() {
  while (rig_->nextImage(rendered_))
    images_.add(static_cast<std::size_t>(rendered_.camera), image(rendered_));
}

void SceneCameras::sayImages() {
  collectImages();
  images_.say();
}

bool SceneCameras::holdUp(bool last_tick) {
  if (!last_tick)
    return images_.behind();
  rig_->flush();
  sayImages();
  return !images_.empty();
}

void SceneCameras::finish() {
  rig_->flush();
  collectImages();
  images_.sayRest();
}

}  // namespace fastball::sim_bullet
