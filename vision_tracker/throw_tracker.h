#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

#include "model/camera.h"
#include "model/target.h"
#include "vision_tracker/ball_detector.h"
#include "vision_tracker/eye.h"
#include "vision_tracker/flight_finder.h"
#include "vision_tracker/flight_landing.h"
#include "vision_tracker/free_flight.h"
#include "vision_tracker/ring_pose.h"
#include "vision_tracker/tracked_target.h"

namespace fastball::vision_tracker {

/// The section `tracker` of the experiment file, with what it needs of the shared part.
struct TrackerOptions {
  DetectorOptions detector;
  FlightPrior prior;
  double longest_gap =
      0;  ///< [s], from the last observation to the crossing; a longer one is not measured
  /// The target's pose is the one given, or is measured: the ring as the cameras see it when the track starts.
  bool measure_target = false;
  RingPrior ring;  ///< for a measured one: how well the pose given is known
};

/// What became of one image.
struct Sighting {
  bool found = false;
  BallFit fit;           ///< of the ball tracked; before that of the most ball-like thing
  bool tracked = false;  ///< a flight is followed, not only looked for
  std::vector<BallFit> candidates;  ///< all ball-like things; only the ball where it is tracked
};

/// The flight as it is known after a time.
struct TrackReport {
  int64_t utime = 0;     ///< [us], of `state`
  int observations = 0;  ///< used by the fit
  model::BallState state;
  double drag = 0;                         ///< [1/m]
  LandingEstimate landing;                 ///< predicted
  std::vector<double> clock, clock_sigma;  ///< [s], as FlightEstimate
};

/// The result of a throw.
struct LandingReport {
  bool measured = false;
  std::string message;  ///< why not, or why the target was not measured
  LandingEstimate landing;
  int observations = 0;
  double residual_px = 0;                  ///< [px], as FlightEstimate
  std::vector<double> clock, clock_sigma;  ///< [s], as FlightEstimate
};

/// Follows one ball through the images of all cameras, from the first that shows it flying to the
/// target plane. The images must come in order of time, those of one time in order of camera; the
/// results depend on nothing else.
class ThrowTracker {
 public:
  enum class State { kWaiting, kTracking, kLanded };

  /// Switches OpenCV's own threads off, for the whole process: the images are small.
  explicit ThrowTracker(const TrackerOptions& options);

  /// A camera's calibration; call for each before its first image. An unchanged one does nothing,
  /// another one forgets all images.
  /// @throw std::invalid_argument unless new indices come one after another, from 0
  void setCamera(int index, const CameraSetup& setup);
  /// Begins a throw: forgets every image.
  void begin(const model::Target& target);
  /// An image (CV_8U, of the camera's size) at a time [us] not before the last one's.
  Sighting add(int camera, int64_t utime, const cv::Mat& image);
  /// No image will come any more: a throw without a landing becomes "not measured".
  void end();

  State state() const { return state_; }
  /// The report that the last add() made, if it made one.
  std::optional<TrackReport> takeTrack();
  /// The landing, once a throw.
  std::optional<LandingReport> takeLanding();

 private:
  Sighting searchIn(int camera, int64_t utime, const cv::Mat& image);
  Sighting followIn(int camera, int64_t utime, const cv::Mat& image);
  void observe(int64_t utime, int camera, const BallFit& fit, const Eigen::Vector3d& p_WBall);
  /// All images of a time have been seen.
  void closeMoment();
  void startTrack(const FlightFinder::Found& found);
  void updateTrack();
  void loseTrack();
  void land();
  void giveUp(const std::string& why);
  bool passed(int64_t utime) const;
  /// The ball at what a camera's clock calls utime.
  model::BallState expectedAt(int64_t utime, int camera) const;
  void takeFlight(const FreeFlight& followed);
  /// Where each camera is still to see the ball.
  void expectWay();
  double distanceAt(int64_t utime, int camera) const;

  TrackerOptions options_;
  std::vector<Eye> eyes_;
  std::vector<model::Camera> cameras_;
  TrackedTarget target_;
  FlightFinder finder_;
  State state_ = State::kWaiting;

  Sightings moment_;          ///< of the time that is being seen, while nothing flies
  int64_t moment_utime_ = 0;  ///< [us], its first image's
  unsigned seen_ = 0;         ///< cameras whose image of it has come, one bit each
  std::size_t known_ = 0;     ///< observations before it
  std::vector<Observation> observations_;
  std::optional<FreeFlight> followed_;
  std::optional<LandingEstimate> predicted_;
  model::BallState latest_;   ///< of the flight, at latest_utime_
  int64_t latest_utime_ = 0;  ///< [us]
  int misses_ = 0;            ///< times in a row without an observation
  int64_t images_ = 0;        ///< of the throw
  std::string lost_;          ///< how the last track ended
  std::optional<TrackReport> track_report_;
  std::optional<LandingReport> landing_report_;
};

}  // namespace fastball::vision_tracker
