#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "model/camera.h"
#include "vision_tracker/ring_pose.h"

namespace fastball::vision_tracker {

struct RingTemplate;

/// Looks for the net's ring in the still scene before one camera: a closed line of the tube's width, brighter or darker than
/// what lies beside it.
class RingFinder {
 public:
  /// @param still CV_16S in 1/128 grey level, as Background::mean() @param tube [m], diameter
  /// @param blur [px], standard deviation of the image
  /// @param reach [px] around the image of `nominal` that is looked at
  RingFinder(const model::Camera& camera,
             const cv::Mat& still,
             const Ring& nominal,
             double tube,
             double blur,
             double reach);

  /// Whether the ring lies inside the image, with a few pixels around it. Only then look for it.
  bool inView() const { return !area_.empty(); }
  /// How much like a line the image is along the ring's, for every shift of up to `reach` [px] each way: the
  /// middle is for none.
  cv::Mat1f search(const Ring& ring, int reach) const;
  /// Pieces of the ring seen within 2 px of its image moved by `shift` [px].
  /// @param looked how many were looked for
  std::vector<RingPoint> points(const Ring& ring,
                                const Eigen::Vector2d& shift,
                                int camera_index,
                                int* looked) const;

 private:
  struct Piece;
  std::optional<RingPoint> look(const Piece& piece, const RingTemplate& made) const;

  model::Camera camera_;
  double width_ = 0, blur_ = 0;  ///< [px]
  cv::Rect area_;
  cv::Mat grey_;                   ///< CV_32F of the area
  cv::Mat across_, mixed_, down_;  ///< CV_32F, second derivatives of the smoothed area
};

}  // namespace fastball::vision_tracker
