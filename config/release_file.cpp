#include "config/release_file.h"

#include <algorithm>

namespace fastball::config {
namespace {

/// Gains of all joints from those of the wrist (roll, flexion) and of a finger (spread, proximal, distal).
model::HandVector jointGains(Section& section, const std::string& key) {
  const Eigen::VectorXd wrist = section.vector(key + "_wrist", 2, kPositive);
  const Eigen::VectorXd finger = section.vector(key + "_finger", 3, kPositive);
  model::HandVector gains;
  gains << wrist, finger, finger.tail(2), finger;
  return gains;
}

model::ReleaseMode releaseMode(Section& section, const std::string& key) {
  const auto& names = model::kReleaseModes;
  const std::string name = section.choice(key, names);
  return static_cast<model::ReleaseMode>(std::find(names.begin(), names.end(), name) -
                                         names.begin());
}

}  // namespace

model::ReleaseSettings readRelease(Section& hand_server) {
  model::ReleaseSettings release;
  Section mode = hand_server.section("release_mode");
  release.in_window = releaseMode(mode, "in_window");
  release.without_window = releaseMode(mode, "without_window");
  mode.finish();
  release.kp = jointGains(hand_server, "kp");
  release.kd = jointGains(hand_server, "kd");
  release.thumb.open_angle = hand_server.number("thumb_open_angle", {-2.5, -0.5});
  release.thumb.speed = hand_server.number("thumb_speed", kPositive);
  release.thumb.deceleration = hand_server.number("thumb_deceleration", kPositive);
  release.relax_time = hand_server.number("relax_time", {0.005, 0.2});
  release.retreat_ratio = hand_server.number("retreat_ratio", {1.05, 5});
  release.open_delay = hand_server.number("open_delay", {0, 0.1});
  release.open_distance = hand_server.number("open_distance", kPositive);
  release.clear_time = hand_server.number("clear_time", kPositive);
  release.touch_force = hand_server.number("touch_force", kPositive);
  return release;
}

}  // namespace fastball::config
