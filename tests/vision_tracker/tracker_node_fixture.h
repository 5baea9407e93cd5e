#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "messaging/local_network.h"
#include "tests/vision_tracker/messages.h"
#include "vision_tracker/node.h"

namespace fastball::vision_tracker {

/// The tracker's node among scripted cameras, in one process.
class TrackerNodeTest : public ::testing::Test {
 protected:
  explicit TrackerNodeTest(const std::string& config = testing::experimentPath()) {
    experimenter_.subscribe<landing_t>(messaging::kLanding,
                                       [this](const landing_t& m) { landings_.push_back(m); });
    experimenter_.subscribe<ball_observation_t>(
        messaging::kBallObservation,
        [this](const ball_observation_t& m) { observations_.push_back(m); });
    experimenter_.subscribe<ball_track_t>(messaging::kBallTrack,
                                          [this](const ball_track_t& m) { tracks_.push_back(m); });
    messaging::ProcessOptions options;
    options.config = config;
    node_ = makeNode(endpoint_, clock_, options);
    network_.addNode(*node_, endpoint_);
    sim_bullet::CameraRigOptions rig = sim_bullet::readCameraRig(testing::experimentPath());
    rig.workers = 2;
    rig_ = std::make_unique<sim_bullet::CameraRig>(rig, experiment_.arm, experiment_.hand,
                                                   experiment_.ball.radius);
  }

  void run() {
    network_.run([] { return false; });
  }
  void request(int64_t id) {
    experimenter_.publish(messaging::kPlanRequest, testing::requestMessage(experiment_, id));
  }
  void calibrate() {
    for (const sim_bullet::RigCamera& camera : rig_->cameras())
      experimenter_.publish(messaging::kCameraInfo, testing::infoMessage(camera));
  }
  void show(const sim_bullet::RenderedImage& image) {
    experimenter_.publish(image.camera == 0 ? messaging::kCameraLeft : messaging::kCameraRight,
                          testing::imageMessage(image));
  }
  std::vector<sim_bullet::RenderedImage> drawn(int seed) {
    synthetic_ = bench::makeThrow(experiment_, seed);
    return bench::renderThrow(*rig_, experiment_, synthetic_, seed);
  }

  config::Experiment experiment_ = config::loadExperiment(testing::experimentPath());
  messaging::ManualClock clock_;
  messaging::LocalNetwork network_{clock_};
  messaging::Endpoint& experimenter_ = network_.addEndpoint();
  messaging::Endpoint& endpoint_ = network_.addEndpoint();
  std::unique_ptr<messaging::Node> node_;
  std::unique_ptr<sim_bullet::CameraRig> rig_;
  bench::SyntheticThrow synthetic_;
  std::vector<landing_t> landings_;
  std::vector<ball_observation_t> observations_;
  std::vector<ball_track_t> tracks_;
};

}  // namespace fastball::vision_tracker
