#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

#include "model/camera.h"
#include "vision_tracker/ring_pose.h"

namespace fastball::vision_tracker {

/// What became of the search.
struct RingMeasurement {
  std::optional<RingEstimate> estimate;
  std::string why_not;  ///< a sentence where there is no estimate, else empty
};

/// The pose of the ring from all cameras' images of the still scene. The nominal pose may be wrong
/// by three times what `prior` says; an estimate more than 4 prior.position off is not believed.
/// @param still of each camera, as Background::mean()
/// @param blur [px] of the images, standard deviation
RingMeasurement measureRing(const std::vector<const cv::Mat*>& still,
                            const std::vector<model::Camera>& cameras,
                            const Ring& nominal,
                            const RingPrior& prior,
                            double blur);

}  // namespace fastball::vision_tracker
