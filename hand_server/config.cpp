#include "hand_server/config.h"

#include "config/experiment.h"

namespace fastball::hand_server {
namespace {

/// Gains of all joints from those of the wrist (roll, flexion) and of a finger (spread, proximal, distal).
model::HandVector jointGains(config::Section& section, const std::string& key) {
  const Eigen::VectorXd wrist = section.vector(key + "_wrist", 2, config::kPositive);
  const Eigen::VectorXd finger = section.vector(key + "_finger", 3, config::kPositive);
  model::HandVector gains;
  gains << wrist, finger, finger.tail(2), finger;
  return gains;
}

}  // namespace

HandServerConfig loadConfig(const std::string& path) {
  config::Section section = config::processSection(path, "hand_server");
  HandServerConfig result;
  result.release_by = section.choice("release", {"plan_time", "normal_force"}) == "plan_time"
                          ? ReleaseBy::kPlanTime
                          : ReleaseBy::kNormalForce;
  result.normal_force_window = section.number("normal_force_window", config::kPositive);
  result.kp = jointGains(section, "kp");
  result.kd = jointGains(section, "kd");
  result.open_distance = section.number("open_distance", config::kPositive);
  result.grasp_time = section.number("grasp_time", config::kPositive);
  result.thumb_open_angle = section.number("thumb_open_angle", {-2.5, -0.5});
  result.thumb_speed = section.number("thumb_speed", config::kPositive);
  result.thumb_deceleration = section.number("thumb_deceleration", config::kPositive);
  result.clear_delay = section.number("clear_delay", config::kPositive);
  result.clear_time = section.number("clear_time", config::kPositive);
  result.touch_force = section.number("touch_force", config::kPositive);
  result.quiet_time = section.number("quiet_time", config::kPositive);
  result.grip_share = section.number("grip_share", {0, 1});
  result.arm_bound = section.number("arm_bound", config::kPositive);
  section.finish();
  return result;
}

}  // namespace fastball::hand_server
