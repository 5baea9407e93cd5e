#include "vision_tracker/config.h"

#include <fmt/format.h>

#include <algorithm>

#include "config/experiment.h"
#include "config/image_channel.h"

namespace fastball::vision_tracker {

namespace {

std::vector<std::string> readCameras(config::Section& section) {
  std::vector<std::string> names = section.texts("cameras");
  if (names.empty() || names.size() > model::kMostCameras)
    throw section.error("cameras", fmt::format("names {} cameras, there can be one to {}",
                                               names.size(), model::kMostCameras));
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (!config::isImageChannel(names[i]))
      throw section.error("cameras",
                          fmt::format("has '{}', which is no channel of images: CAMERA_ and "
                                      "capitals, digits or underscores, not CAMERA_INFO",
                                      names[i]));
    if (std::find(names.begin(), names.begin() + static_cast<std::ptrdiff_t>(i), names[i]) !=
        names.begin() + static_cast<std::ptrdiff_t>(i))
      throw section.error("cameras", fmt::format("names {} twice", names[i]));
  }
  return names;
}

}  // namespace

TrackerConfig readTracker(const std::string& path) {
  const config::Experiment experiment = config::loadExperiment(path);
  config::Section section = config::processSection(path, "tracker");
  TrackerConfig config;
  config.cameras = readCameras(section);
  DetectorOptions& detector = config.tracker.detector;
  detector.ball_radius = experiment.ball.radius;
  const Eigen::VectorXd depth = section.vector("depth", 2, {0.2, 100});
  detector.nearest = depth[0];
  detector.farthest = depth[1];
  if (!(detector.nearest < detector.farthest))
    throw section.error("depth", "must give the nearer depth first");
  detector.blur = section.number("blur", {0.3, 5});
  detector.noise_floor = section.number("noise_floor", {1e-3, 5});
  const Eigen::VectorXd brightness = section.vector("brightness", 2, {0, 255});
  detector.darkest = brightness[0];
  detector.brightest = brightness[1];
  if (!(detector.darkest < detector.brightest))
    throw section.error("brightness", "must give the darker level first");
  FlightPrior& prior = config.tracker.prior;
  prior.gravity = experiment.arm.gravity;
  prior.ball_radius = experiment.ball.radius;
  prior.drag = experiment.ball.dragPerMetre();
  prior.drag_sigma = prior.drag * section.number("drag_uncertainty", {1e-3, 10});
  prior.bias_sigma = section.number("bias", {1e-4, 10});
  prior.clock_sigma = section.number("clock_sigma", {0, 0.1});
  prior.magnus_sigma = section.number("magnus_sigma", {0, 100});
  prior.radius_sigma = section.number("radius_uncertainty", {1e-5, 0.5});
  config::Section calibration = section.section("calibration");
  prior.calibration.rotation = calibration.number("rotation", {0, 0.1});
  prior.calibration.position = calibration.number("position", {0, 1});
  prior.calibration.focal_length = calibration.number("focal_length", {0, 0.1});
  calibration.finish();
  config.tracker.longest_gap = section.number("longest_gap", {0.01, 1});
  config.longest_wait = section.number("longest_wait", {1, 1e5});
  config.tracker.measure_target = section.choice("target", {"known", "measured"}) == "measured";
  config::Section ring = section.section("ring");
  config.tracker.ring.tube = ring.number("tube", {1e-3, 1});
  config.tracker.ring.position = ring.number("position", {1e-4, 1});
  config.tracker.ring.tilt = ring.number("tilt", {1e-4, 0.5});
  config.tracker.ring.bias = ring.number("bias", {1e-4, 10});
  ring.finish();
  config.silence = section.number("silence", {0.1, 60});
  section.finish();
  return config;
}

}  // namespace fastball::vision_tracker
