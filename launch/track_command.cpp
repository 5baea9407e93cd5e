#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <memory>
#include <opencv2/core/utils/logger.hpp>
#include <opencv2/imgcodecs.hpp>

#include "config/calibration_file.h"
#include "config/experiment.h"
#include "launch/commands.h"
#include "messaging/process.h"
#include "vision_tracker/config.h"
#include "vision_tracker/flight_landing.h"
#include "vision_tracker/video_track.h"

namespace fastball::launch {
namespace {

struct TrackOptions {
  std::vector<std::string> videos;
  std::vector<std::string> calibrations;
  std::string folder, config;
  double radius = 0;
};

void save(const std::filesystem::path& path, const std::string& text) {
  std::ofstream file(path);
  file << text;
  if (!file.flush())
    throw std::invalid_argument(fmt::format("{}: cannot be written", path.string()));
}

std::string flightText(const vision_tracker::FlightEstimate& flight,
                       const std::optional<vision_tracker::LandingEstimate>& landing) {
  const auto& s = flight.start;
  std::string text = fmt::format(
      "from {:.6f} s: position ({:.5f}, {:.5f}, {:.5f}) m, velocity ({:.5f}, {:.5f}, {:.5f}) m/s, "
      "drag {:.4f} /m, {} observations, residual {:.3f} px\n",
      static_cast<double>(flight.utime) * 1e-6, s.p_WBall.x(), s.p_WBall.y(), s.p_WBall.z(),
      s.v_WBall.x(), s.v_WBall.y(), s.v_WBall.z(), flight.drag, flight.used, flight.residual_px);
  if (!landing)
    return text + "it does not cross the target plane\n";
  return text + fmt::format("landing at {:.6f} s: ({:.2f}, {:.2f}) mm +- ({:.2f}, {:.2f})\n",
                            static_cast<double>(landing->utime) * 1e-6, 1e3 * landing->landing.x(),
                            1e3 * landing->landing.y(), 1e3 * std::sqrt(landing->cov(0, 0)),
                            1e3 * std::sqrt(landing->cov(1, 1)));
}

int track(const TrackOptions& options) {
  // What OpenCV says of a file that it cannot read is said again in one sentence.
  cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
  const std::string path = config::experimentPath(options.config);
  const config::Experiment experiment = config::loadExperiment(path);
  const vision_tracker::TrackerOptions tracker = vision_tracker::readTracker(path).tracker;
  std::vector<model::Camera> cameras;
  for (const std::string& file : options.calibrations)
    for (const model::Camera& camera : config::readCalibration(file))
      cameras.push_back(camera);
  if (cameras.empty() && !(options.radius > 0))
    throw std::invalid_argument(
        "--radius: without --calib the ball's approximate radius in pixels is needed");
  if (!cameras.empty() && cameras.size() != options.videos.size())
    throw std::invalid_argument(fmt::format("{}: {} cameras, but there are {} videos",
                                            fmt::join(options.calibrations, ", "), cameras.size(),
                                            options.videos.size()));
  std::error_code error;
  std::filesystem::create_directories(options.folder, error);
  const vision_tracker::VideoBall ball{options.radius, experiment.ball.radius,
                                       tracker.detector.nearest, tracker.detector.farthest};
  std::vector<vision_tracker::VideoTrack> tracks;
  bool everywhere = true;
  for (std::size_t i = 0; i < options.videos.size(); ++i) {
    std::optional<model::Camera> camera;
    if (!cameras.empty())
      camera = cameras[i];
    tracks.push_back(vision_tracker::trackVideo(options.videos[i], camera, ball));
    const auto& t = tracks.back();
    const auto file = std::filesystem::path(options.folder) / fmt::format("track{}", i + 1);
    save(file.string() + ".csv", vision_tracker::tableOf(t, camera, experiment.ball.radius));
    if (!cv::imwrite(file.string() + ".png", t.picture))
      throw std::invalid_argument(fmt::format("{}.png: cannot be written", file.string()));
    fmt::print("{}: the ball is in {} of {} images\n", options.videos[i], t.sightings.size(),
               t.frames);
    everywhere = everywhere && !t.sightings.empty();
  }
  const bool posed = std::any_of(cameras.begin(), cameras.end(), [](const model::Camera& c) {
    return !c.R_CW.isIdentity(0) || !c.p_CW.isZero(0);
  });
  if (cameras.size() >= 2 && !posed)
    fmt::print("no flight: the calibration has no pose (R, T), so it does not tell what is down\n");
  if (cameras.size() >= 2 && posed && everywhere) {
    const auto flight = vision_tracker::flightOf(tracks, cameras, tracker.prior);
    const std::string text =
        flight ? flightText(*flight, vision_tracker::landingOf(*flight, experiment.target,
                                                               tracker.prior.gravity))
               : std::string("not measured: no flight agrees with the tracks\n");
    save(std::filesystem::path(options.folder) / "flight.txt", text);
    fmt::print("{}", text);
    everywhere = flight.has_value();
  }
  fmt::print("wrote {}\n", options.folder);
  return everywhere ? messaging::kExitDone : messaging::kExitFailed;
}

}  // namespace

void addTrackCommand(CLI::App& app, int& exit_status) {
  auto options = std::make_shared<TrackOptions>();
  CLI::App* command = app.add_subcommand("track",
                                         "Follow the ball in videos: a table (CSV) and a picture "
                                         "(PNG) of each track, and with two or more calibrated "
                                         "cameras the flight and its landing");
  command
      ->add_option("VIDEO", options->videos,
                   "One video of each camera, all beginning at the same time")
      ->required()
      ->expected(1, 4);
  command
      ->add_option(
          "--calib", options->calibrations,
          "Calibration of the videos' cameras, OpenCV YAML: one file for all, or once for each; "
          "without it the track is in pixels only")
      ->allow_extra_args(false);
  command
      ->add_option("--radius", options->radius,
                   "Approximate radius of the ball in the images [px] (default with --calib: from "
                   "the ball's size and "
                   "tracker.depth)")
      ->check(CLI::Range(2.0, 500.0));
  command->add_option("-o,--output", options->folder, "Folder to write to")->required();
  command->add_option("--config", options->config, "Experiment file (default: the shipped one)");
  command->callback([options, &exit_status] { exit_status = track(*options); });
}

}  // namespace fastball::launch
