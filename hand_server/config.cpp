#include "hand_server/config.h"

#include "config/experiment.h"
#include "config/release_file.h"

namespace fastball::hand_server {

namespace {

TrialSettings readTrial(config::Section trial) {
  TrialSettings result;
  result.begin = trial.number("begin", config::kNonNegative);
  result.share = trial.number("share", {0.01, 0.6});
  result.duration = trial.number("duration", {0.01, 0.07});
  result.longest = trial.number("longest", {0.001, 0.05});
  trial.finish();
  return result;
}

}  // namespace

HandServerConfig loadConfig(const std::string& path) {
  config::Section section = config::processSection(path, "hand_server");
  HandServerConfig result;
  result.release_by = section.choice("release", {"plan_time", "normal_force"}) == "plan_time"
                          ? ReleaseBy::kPlanTime
                          : ReleaseBy::kNormalForce;
  result.normal_force_window = section.number("normal_force_window", config::kPositive);
  result.release = config::readRelease(section);
  result.grasp_time = section.number("grasp_time", config::kPositive);
  result.settle_time = section.number("settle_time", config::kNonNegative);
  result.settle_constant = section.number("settle_constant", {0.005, 1});
  result.trial = readTrial(section.section("trial"));
  result.clear_delay = section.number("clear_delay", config::kPositive);
  result.force_noise = section.number("force_noise", {0, 1});
  result.force_delay = section.number("force_delay", {0, 0.02});
  result.command_shift_max = section.number("command_shift_max", {0, 0.02});
  result.quiet_time = section.number("quiet_time", {0.002, 0.025});
  result.grip_share = section.number("grip_share", {0, 1});
  result.arm_bound = section.number("arm_bound", config::kPositive);
  result.stale_limit = section.number("stale_limit", {0.002, 1.0});
  section.finish();
  return result;
}

}  // namespace fastball::hand_server
