#include "controller/config.h"

#include "config/experiment.h"

namespace fastball::controller {

ControllerConfig loadConfig(const std::string& path) {
  config::Section section = config::processSection(path, "controller");
  ControllerConfig result;
  result.law = section.choice("law", {"feed_forward", "gravity_pd"}) == "gravity_pd"
                   ? Law::kGravityPd
                   : Law::kFeedForward;
  result.kp = section.vector("kp", model::kArmJoints, config::kNonNegative);
  result.kd = section.vector("kd", model::kArmJoints, config::kNonNegative);
  result.start_tolerance = section.number("start_tolerance", config::kPositive);
  result.blend_time = section.number("blend_time", config::kPositive);
  result.grip_correction_max = section.number("grip_correction_max", {0, 0.05});
  result.tracking_bound = section.number("tracking_bound", config::kPositive);
  result.overspeed = section.number("overspeed", {1.0, 2.0});
  result.stale_limit = section.number("stale_limit", {0.002, 1.0});
  result.brake_share = section.number("brake_share", {0.1, 1.0});
  section.finish();
  return result;
}

}  // namespace fastball::controller
