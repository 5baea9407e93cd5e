#pragma once

#include <string>
#include <vector>

#include "vision_tracker/board_corners.h"
#include "vision_tracker/rig_calibration.h"

namespace fastball::vision_tracker {

/// Chooses views from what cameras see while somebody moves a board about before them: those in which the board is held still, so
/// that it does not matter when exactly each camera looked, and lies otherwise than in the views before.
class BoardCollector {
 public:
  /// @param cameras names, at least one
  /// @throw std::invalid_argument if the board cannot be
  BoardCollector(const BoardShape& shape, const std::vector<std::string>& cameras);

  /// Looks at the cameras' newest images (CV_8U, in their order; empty: none since the last look).
  /// @return whether they are a new view
  bool look(const std::vector<cv::Mat>& greys);

  /// The views of each camera; those of one name belong together.
  const std::vector<CameraImages>& images() const { return images_; }
  /// Corners that the last look found in each camera's image.
  std::vector<std::size_t> corners() const;
  /// Views of the camera that has the fewest.
  std::size_t fewestViews() const;

 private:
  /// One camera.
  struct Eye {
    cv::Size size;
    BoardCorners now, before;         ///< in the last two looks
    std::vector<BoardCorners> taken;  ///< in the views
  };
  static bool isStill(const Eye& eye);
  static bool isNew(const Eye& eye);

  BoardFinder finder_;
  std::vector<Eye> eyes_;
  std::vector<CameraImages> images_;
  int views_ = 0;
};

}  // namespace fastball::vision_tracker
