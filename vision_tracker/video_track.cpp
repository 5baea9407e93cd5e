#include "vision_tracker/video_track.h"

#include <fmt/format.h>

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>
#include <stdexcept>

#include "vision_tracker/free_flight.h"
#include "vision_tracker/sphere_outline.h"

namespace fastball::vision_tracker {
namespace {

constexpr double kUsualRate = 30;  // [Hz], where a file does not tell

cv::Mat greyOf(const cv::Mat& frame) {
  cv::Mat grey;
  if (frame.channels() == 1)
    frame.convertTo(grey, CV_8U);
  else
    cv::cvtColor(frame, grey, frame.channels() == 4 ? cv::COLOR_BGRA2GRAY : cv::COLOR_BGR2GRAY);
  return grey;
}

PixelTrackerOptions optionsFor(const std::optional<model::Camera>& camera, const VideoBall& ball) {
  PixelTrackerOptions options;
  if (ball.pixel_radius > 0) {
    options.smallest = 0.6 * ball.pixel_radius;
    options.largest = 1.7 * ball.pixel_radius;
  } else {
    options.smallest = camera->fx * ball.radius / ball.farthest;
    options.largest = camera->fx * ball.radius / ball.nearest;
  }
  return options;
}

void drawTrack(VideoTrack& track) {
  const cv::Scalar kRing(0, 200, 255), kLine(0, 0, 230);
  constexpr int kShift = 4;  // OpenCV draws in sixteenths of a pixel
  const auto fixed = [](double x) { return static_cast<int>(std::lround(x * (1 << kShift))); };
  for (std::size_t i = 0; i < track.sightings.size(); ++i) {
    const BallFit& fit = track.sightings[i].fit;
    const cv::Point centre(fixed(fit.centre.x()), fixed(fit.centre.y()));
    cv::circle(track.picture, centre, fixed(fit.radius), kRing, 1, cv::LINE_AA, kShift);
    if (i > 0 && track.sightings[i].frame - track.sightings[i - 1].frame < 5) {
      const BallFit& before = track.sightings[i - 1].fit;
      cv::line(track.picture, {fixed(before.centre.x()), fixed(before.centre.y())}, centre, kLine,
               1, cv::LINE_AA, kShift);
    }
  }
}

cv::VideoCapture opened(const std::string& path) {
  cv::VideoCapture video;
  try {
    video.open(path);
  } catch (const cv::Exception&) {
    video.release();
  }
  if (!video.isOpened())
    throw std::invalid_argument(fmt::format("{}: cannot be read as a video", path));
  return video;
}

/// The frame of the picture: the one in the middle of the track.
cv::Mat frameOf(const std::string& path, int index) {
  cv::VideoCapture video = opened(path);
  cv::Mat frame;
  for (int i = 0; i <= index && video.read(frame); ++i) {
  }
  return frame;
}

}  // namespace

VideoTrack trackVideo(const std::string& path,
                      const std::optional<model::Camera>& camera,
                      const VideoBall& ball) {
  cv::VideoCapture video = opened(path);
  const double told = video.get(cv::CAP_PROP_FPS);
  const double rate = std::isfinite(told) && told > 0.1 && told < 1e5 ? told : kUsualRate;
  VideoTrack track;
  cv::Mat frame;
  std::optional<PixelTracker> tracker;
  while (video.read(frame) && !frame.empty()) {
    if (!tracker) {
      track.size = frame.size();
      if (camera && track.size != cv::Size(camera->width, camera->height))
        throw std::invalid_argument(fmt::format(
            "{}: its images have {} x {} pixels, but the calibration is of a camera with {} x {}",
            path, frame.cols, frame.rows, camera->width, camera->height));
      tracker.emplace(track.size, optionsFor(camera, ball));
    }
    if (frame.size() != track.size)
      throw std::invalid_argument(
          fmt::format("{}: image {} has another size than the first", path, track.frames));
    tracker->add(greyOf(frame), track.frames / rate);
    ++track.frames;
  }
  if (!tracker)
    throw std::invalid_argument(fmt::format("{}: holds no image", path));
  track.duration = track.frames / rate;
  track.sightings = tracker->track();
  const int middle =
      track.sightings.empty() ? 0 : track.sightings[track.sightings.size() / 2].frame;
  const cv::Mat shown = frameOf(path, middle);
  if (shown.channels() == 1)
    cv::cvtColor(shown, track.picture, cv::COLOR_GRAY2BGR);
  else
    track.picture = shown.clone();
  drawTrack(track);
  return track;
}

std::string tableOf(const VideoTrack& track,
                    const std::optional<model::Camera>& camera,
                    double ball_radius) {
  std::string text = "frame,time,u,v,radius,cov_uu,cov_uv,cov_vv";
  text += camera ? ",x,y,z\n" : "\n";
  for (const PixelSighting& s : track.sightings) {
    text += fmt::format("{},{:.6f},{:.4f},{:.4f},{:.4f},{:.6g},{:.6g},{:.6g}", s.frame, s.time,
                        s.fit.centre.x(), s.fit.centre.y(), s.fit.radius, s.fit.cov(0, 0),
                        s.fit.cov(0, 1), s.fit.cov(1, 1));
    if (camera) {
      const auto place = placeBySize(*camera, s.fit.centre, s.fit.radius, ball_radius);
      text += place ? fmt::format(",{:.5f},{:.5f},{:.5f}", place->p_W.x(), place->p_W.y(),
                                  place->p_W.z())
                    : ",,,";
    }
    text += '\n';
  }
  return text;
}

std::optional<FlightEstimate> flightOf(const std::vector<VideoTrack>& tracks,
                                       const std::vector<model::Camera>& cameras,
                                       const FlightPrior& prior) {
  std::vector<Observation> observations;
  for (std::size_t c = 0; c < tracks.size(); ++c)
    for (const PixelSighting& s : tracks[c].sightings)
      observations.push_back(
          {std::llround(s.time * 1e6), static_cast<int>(c), s.fit.centre, s.fit.cov});
  if (observations.empty())
    return std::nullopt;
  // A start by the sizes: p + v t - g t^2 / 2, least squares.
  Eigen::MatrixXd design(observations.size(), 2), points(observations.size(), 3);
  Eigen::Index row = 0;
  for (std::size_t c = 0; c < tracks.size(); ++c) {
    for (const PixelSighting& s : tracks[c].sightings) {
      const auto place = placeBySize(cameras[c], s.fit.centre, s.fit.radius, prior.ball_radius);
      if (!place)
        continue;
      const Eigen::Vector3d fall(0, 0, prior.gravity * s.time * s.time / 2);
      design.row(row) << 1, s.time;
      points.row(row++) = place->p_W + fall;
    }
  }
  if (row == 0)
    return std::nullopt;
  const Eigen::MatrixXd line = design.topRows(row).colPivHouseholderQr().solve(points.topRows(row));
  std::stable_sort(observations.begin(), observations.end(),
                   [](const Observation& a, const Observation& b) { return a.utime < b.utime; });
  return fitFreeFlight(observations, cameras, prior,
                       {line.row(0).transpose(), line.row(1).transpose()}, 0, nullptr);
}

}  // namespace fastball::vision_tracker
