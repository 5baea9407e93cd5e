#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

#include "model/camera.h"
#include "vision_tracker/flight_estimate.h"
#include "vision_tracker/pixel_tracker.h"

namespace fastball::vision_tracker {

/// The ball in one video file.
struct VideoTrack {
  cv::Size size;        ///< [px]
  int frames = 0;       ///< read
  double duration = 0;  ///< [s]
  std::vector<PixelSighting> sightings;
  cv::Mat picture;  ///< CV_8UC3: the track over the image in its middle
};

/// What is known of the ball in a video.
struct VideoBall {
  /// [px], approximate; 0: from radius and depth, which takes a calibrated camera.
  double pixel_radius = 0;
  double radius = 0;                 ///< [m]
  double nearest = 0, farthest = 0;  ///< [m], depth before the camera
};

/// Tracks the ball through everything that OpenCV reads as a video.
/// @param camera if calibrated; its image must have the video's size
/// @throw std::invalid_argument if it is no video or none of this camera
VideoTrack trackVideo(const std::string& path,
                      const std::optional<model::Camera>& camera,
                      const VideoBall& ball);

/// A table (CSV): frame, time [s], u, v, radius [px], cov_uu, cov_uv, cov_vv [px^2]; for a
/// calibrated camera also x, y, z [m], the place in the world that direction and apparent size say
/// (placeBySize()), empty where they say none.
/// @param ball_radius [m]
std::string tableOf(const VideoTrack& track,
                    const std::optional<model::Camera>& camera,
                    double ball_radius);

/// One flight fitted to the tracks of two to four cameras whose videos begin at the same time; its
/// times count from there.
/// @return nothing if no flight fits
std::optional<FlightEstimate> flightOf(const std::vector<VideoTrack>& tracks,
                                       const std::vector<model::Camera>& cameras,
                                       const FlightPrior& prior);

}  // namespace fastball::vision_tracker
