#pragma once

#include <cstdint>
#include <deque>
#include <future>
#include <memory>
#include <vector>

#include "model/arm_parameters.h"
#include "model/hand_parameters.h"
#include "model/target.h"
#include "sim_bullet/camera_config.h"
#include "sim_bullet/camera_frame.h"
#include "sim_bullet/snapshot.h"

namespace fastball::sim_bullet {

/// Cameras that draw what snapshots of a scene show. Frames are taken at the whole multiples of the frame period, rounded to
/// microseconds, the same for all cameras. The bytes depend on the snapshots and the seed alone, not on how many threads
/// draw them or how fast.
class CameraRig {
 public:
  /// @param ball_radius [m].
  /// @throw std::invalid_argument without a camera.
  CameraRig(const CameraRigOptions& options,
            const model::ArmParameters& arm,
            const model::HandParameters& hand,
            double ball_radius);
  ~CameraRig();
  CameraRig(const CameraRig&) = delete;
  CameraRig& operator=(const CameraRig&) = delete;

  const std::vector<RigCamera>& cameras() const { return options_.cameras; }

  /// Begins a scene; images of the scene before that have not been fetched are dropped. Frames
  /// whose whole exposure lies in [start_utime, end_utime] ([us], simulated) will be taken.
  void begin(int64_t scene_id,
             int64_t seed,
             int64_t start_utime,
             int64_t end_utime,
             const model::Target& target);
  /// The scene at a later time than the call before (others are ignored); call every tick. Between two snapshots motion is
  /// interpolated linearly. May wait when the drawing threads are far behind.
  void add(const SceneSnapshot& snapshot);
  /// The next image in order of time, then of camera; false if it is not ready. Does not wait.
  /// @throw as renderFrame().
  bool nextImage(RenderedImage& image);
  /// Waits until every frame begun is ready.
  void flush();

 private:
  struct Workers;
  void take(int64_t utime);
  SceneSnapshot at(double utime) const;
  int64_t frameTime(int64_t index) const;

  CameraRigOptions options_;
  std::shared_ptr<const NoiseField> noise_;
  std::shared_ptr<const Figure> figure_;
  BallLook ball_;
  std::vector<cv::Mat> rays_, rooms_;
  std::vector<std::shared_ptr<const View>> views_;
  std::unique_ptr<Workers> workers_;

  std::deque<SceneSnapshot> history_;
  std::deque<std::future<RenderedImage>> pending_;
  int64_t scene_id_ = 0, seed_ = 0, end_utime_ = 0;
  int64_t next_index_ = 0;  ///< of the frame grid, whose frame 0 is at utime 0
  int64_t next_frame_ = 0;  ///< of the scene
  bool running_ = false;
};

}  // namespace fastball::sim_bullet
