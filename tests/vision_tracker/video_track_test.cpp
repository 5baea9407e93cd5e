// Videos written by OpenCV, with a ball whose path is known.
#include "vision_tracker/video_track.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>
#include <stdexcept>

#include "bench/synthetic_throw.h"
#include "tests/vision_tracker/experiment_path.h"
#include "vision_tracker/config.h"
#include "vision_tracker/sphere_outline.h"

namespace fastball::vision_tracker {
namespace {

using ::testing::HasSubstr;

class Videos : public ::testing::Test {
 protected:
  ~Videos() override {
    for (const std::string& path : paths_)
      std::remove(path.c_str());
  }
  std::string newPath(const std::string& name) {
    paths_.push_back(::testing::TempDir() + "video_track_test_" + std::to_string(getpid()) + name);
    return paths_.back();
  }
  std::string write(const std::string& name, double rate, const std::vector<cv::Mat>& frames) {
    const std::string path = newPath(name);
    cv::VideoWriter video(path, cv::CAP_OPENCV_MJPEG, cv::VideoWriter::fourcc('M', 'J', 'P', 'G'),
                          rate, frames.front().size(), frames.front().channels() == 3);
    for (const cv::Mat& frame : frames)
      video.write(frame);
    return path;
  }
  static std::string refusal(const std::string& path, const std::optional<model::Camera>& camera) {
    try {
      trackVideo(path, camera, {8, 0.05, 1, 10});
    } catch (const std::invalid_argument& e) {
      return e.what();
    }
    return "accepted";
  }
  std::vector<std::string> paths_;
};

TEST_F(Videos, ThrowIsTrackedByTwoCamerasAndItsLandingMeasured) {
  const config::Experiment experiment =
      config::loadExperiment(::fastball::testing::experimentPath());
  sim_bullet::CameraRigOptions options =
      sim_bullet::readCameraRig(::fastball::testing::experimentPath());
  options.workers = 2;
  sim_bullet::CameraRig rig(options, experiment.arm, experiment.hand, experiment.ball.radius);
  const bench::SyntheticThrow made = bench::makeThrow(experiment, 3);
  std::vector<std::vector<cv::Mat>> frames(2);
  int64_t first = 0;
  for (const sim_bullet::RenderedImage& image : bench::renderThrow(rig, experiment, made, 3)) {
    first = first == 0 ? image.utime : first;
    frames[static_cast<std::size_t>(image.camera)].push_back(
        cv::imdecode(image.jpeg, cv::IMREAD_COLOR));
  }
  const TrackerOptions tracker = readTracker(::fastball::testing::experimentPath()).tracker;
  std::vector<VideoTrack> tracks;
  std::vector<model::Camera> cameras;
  for (std::size_t c = 0; c < 2; ++c) {
    cameras.push_back(rig.cameras()[c].camera);
    const std::string path = write("throw" + std::to_string(c) + ".avi", 240, frames[c]);
    tracks.push_back(trackVideo(
        path, cameras[c],
        {0, experiment.ball.radius, tracker.detector.nearest, tracker.detector.farthest}));
    int right = 0;
    for (const PixelSighting& s : tracks[c].sightings) {
      const double t = static_cast<double>(first - made.release_utime) * 1e-6 + s.time;
      if (t < 0.03)
        continue;
      const model::BallState ball = model::fly(made.release, t, made.drag, experiment.arm.gravity);
      const Eigen::Vector2d truth = outlineCentre(cameras[c], ball.p_WBall, experiment.ball.radius);
      if ((s.fit.centre - truth).norm() > 0.5)
        continue;
      ++right;
      const auto place =
          placeBySize(cameras[c], s.fit.centre, s.fit.radius, experiment.ball.radius);
      ASSERT_TRUE(place);
      EXPECT_LT((place->p_W - ball.p_WBall).norm(), 0.6) << "a tenth of the distance";
    }
    EXPECT_GT(right, 80);
    EXPECT_EQ(tracks[c].picture.size(), cv::Size(640, 480));
  }
  const auto flight = flightOf(tracks, cameras, tracker.prior);
  ASSERT_TRUE(flight);
  const auto landing = landingOf(*flight, experiment.target, experiment.arm.gravity);
  ASSERT_TRUE(landing);
  EXPECT_LT((landing->landing - made.landing.landing).norm(), 3e-3);
}

/// A patterned ball that bounces through a noisy colour video at 60 Hz; when it is gone a smaller thing moves.
TEST_F(Videos, BouncingPatternedBallIsFollowedWithItsRadiusAlone) {
  std::vector<cv::Mat> frames;
  std::vector<Eigen::Vector2d> truth;
  cv::RNG noise(3);
  double y = 80, v = 0;
  for (int k = 0; k < 110; ++k) {
    cv::Mat frame(360, 480, CV_8UC3, cv::Scalar(60, 90, 70));
    cv::rectangle(frame, {200, 150, 120, 90}, {120, 60, 40}, cv::FILLED);
    const double x = 20 + 5 * (k - 10);
    if (k >= 90)
      cv::circle(frame, {6 * (k - 80), 40}, 6, {240, 240, 240}, cv::FILLED, cv::LINE_AA);
    if (k >= 10 && k < 90) {
      v += 0.9;
      y += v;
      if (y > 320) {
        y = 640 - y;
        v *= -0.85;
      }
      const cv::Point centre(static_cast<int>(std::lround(x * 16)),
                             static_cast<int>(std::lround(y * 16)));
      cv::circle(frame, centre, 11 * 16, {200, 210, 250}, cv::FILLED, cv::LINE_AA, 4);
      cv::ellipse(frame, centre, {11 * 16, 4 * 16}, 17.0 * k, 0, 360, {160, 120, 230}, cv::FILLED,
                  cv::LINE_AA, 4);
    }
    truth.emplace_back(x, y);
    cv::Mat grain(frame.size(), CV_16SC3), sum;
    noise.fill(grain, cv::RNG::NORMAL, 0, 4);
    cv::add(frame, grain, sum, cv::noArray(), CV_8U);
    frames.push_back(sum);
  }
  const VideoTrack track = trackVideo(write("bounce.avi", 60, frames), std::nullopt, {9, 0, 0, 0});
  EXPECT_EQ(track.frames, 110);
  int right = 0;
  for (const PixelSighting& s : track.sightings)
    right += (s.fit.centre - truth[static_cast<std::size_t>(s.frame)]).norm() < 2 ? 1 : 0;
  EXPECT_GE(right, 70) << "of 80";
  EXPECT_LE(static_cast<int>(track.sightings.size()) - right, 2);
  const std::string table = tableOf(track, std::nullopt, 0);
  EXPECT_THAT(table, ::testing::StartsWith("frame,time,u,v,radius,cov_uu,cov_uv,cov_vv\n"));
}

TEST_F(Videos, NothingThatFliesGivesNoTrack) {
  std::vector<cv::Mat> frames;
  cv::RNG noise(1);
  for (int k = 0; k < 40; ++k) {
    cv::Mat frame(240, 320, CV_8UC1);
    noise.fill(frame, cv::RNG::NORMAL, 100, 4);
    frames.push_back(frame);
  }
  EXPECT_TRUE(
      trackVideo(write("still.avi", 60, frames), std::nullopt, {8, 0, 0, 0}).sightings.empty());
}

TEST_F(Videos, NamesTheFileItRefuses) {
  const std::string text = newPath("text.avi");
  std::ofstream(text) << "no video";
  EXPECT_THAT(refusal(text, {}), HasSubstr(text + ": cannot be read as a video"));
  EXPECT_THAT(refusal("/nonexistent.avi", {}), HasSubstr("cannot be read"));
  const std::string small = write("small.avi", 30, {cv::Mat(240, 320, CV_8UC1, cv::Scalar(9))});
  model::Camera camera;
  camera.width = 640;
  camera.height = 480;
  camera.fx = camera.fy = 600;
  EXPECT_THAT(refusal(small, camera), HasSubstr("320 x 240 pixels, but the calibration"));
}

}  // namespace
}  // namespace fastball::vision_tracker
