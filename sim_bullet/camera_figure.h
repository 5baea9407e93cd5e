#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <vector>

#include "model/arm.h"
#include "model/camera.h"
#include "model/hand.h"
#include "sim_bullet/snapshot.h"

namespace fastball::sim_bullet {

/// A limb as the camera sees it: two discs and what lies between them.
struct Limb {
  Eigen::Vector2d start, end;               ///< [px]
  double start_radius = 0, end_radius = 0;  ///< [px]
  double depth = 0;                         ///< [m], of its middle along the optical axis
  int grey = 0;
};

/// The moving robot: upper arm, forearm, palm and phalanges. Limbs behind the camera are left out.
class Figure {
 public:
  Figure(const model::ArmParameters& arm, const model::HandParameters& hand);
  /// Farthest first.
  std::vector<Limb> limbs(const model::Camera& camera, const SceneSnapshot& snapshot) const;

 private:
  model::Arm arm_;
  model::Hand hand_;
};

/// The smallest rectangle around a limb, with a border for the antialiasing.
cv::Rect boundsOf(const Limb& limb);
/// `origin` is the image's own corner in the full image; CV_8U.
void drawLimb(const Limb& limb, const cv::Point& origin, cv::Mat& image);

}  // namespace fastball::sim_bullet
