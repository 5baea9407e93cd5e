#pragma once

#include <cstdint>
#include <memory>

#include "config/experiment.h"
#include "messaging/channels.h"
#include "messaging/endpoint.h"
#include "sim_bullet/camera_rig.h"
#include "sim_bullet/image_flow.h"
#include "sim_bullet/scene.h"

namespace fastball::sim_bullet {

/// The cameras as the set-up of a scene has really placed them, and what they say: CAMERA_INFO as calibrated, and images.
class SceneCameras {
 public:
  /// @param calibrated as everyone believes them to stand.
  /// @throw std::invalid_argument as ImageFlow.
  SceneCameras(messaging::Endpoint& endpoint,
               const messaging::Clock& clock,
               bool lockstep,
               const CameraRigOptions& calibrated,
               const config::Experiment& experiment,
               const Uncertainty& uncertainty);

  /// Before all that follows. The cameras stand elsewhere only if the set-up is another one.
  void beginScene(const scene_t& message, const Scene& scene);
  /// The scene after a tick.
  void add(const SceneSnapshot& snapshot) { rig_->add(snapshot); }
  /// @param utime [us], simulated.
  void sayInfo(int64_t utime);
  /// Says the images that are ready and may be said. Does not wait. @throw as CameraRig::nextImage(), here and below.
  void sayImages();
  /// Images that wait hold the scene up: many of them, or any before its last tick.
  bool holdUp(bool last_tick);
  /// Waits for the last images, some ten of a few milliseconds each, and says them.
  void finish();

 private:
  void place(int64_t set_up_seed, const Scene& scene);
  void collectImages();

  CameraRigOptions calibrated_;
  config::Experiment experiment_;
  Uncertainty uncertainty_;
  messaging::Publisher<camera_info_t> infos_;
  ImageFlow images_;
  std::unique_ptr<CameraRig> rig_;
  int64_t set_up_seed_ = 0;  ///< of the set-up in which they stand as in rig_
  RenderedImage rendered_;
};

}  // namespace fastball::sim_bullet
