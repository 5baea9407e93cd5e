#include "planner/config.h"

namespace fastball::planner {
namespace {

model::ReleaseCommand readRelease(config::Section section) {
  model::ReleaseCommand release;
  release.grip_force = section.number("grip_force", {0.1, 12});
  release.thumb_delay = section.number("thumb_delay", {0, 0.05});
  release.thumb_acceleration = section.number("thumb_acceleration", config::kPositive);
  release.thumb_speed = section.number("thumb_speed", config::kPositive);
  release.finger_stiffness = section.number("finger_stiffness", config::kNonNegative);
  section.finish();
  return release;
}

SwingSettings readSwing(config::Section section) {
  SwingSettings swing;
  swing.omega_max = section.vector("omega_max", 3, {3, 20});
  swing.elbow_margin = section.number("elbow_margin", {0.05, 1});
  swing.body_clearance = section.number("body_clearance", {0, 0.8});
  swing.lowest_ball = section.number("lowest_ball", {-3, 0});
  swing.follow.delay = section.number("follow_through", {0.01, 0.2});
  swing.follow.brake_time = section.vector("brake_time", model::kArmJoints, {0.1, 1});
  section.finish();
  return swing;
}

}  // namespace

PlannerConfig loadConfig(const std::string& path) {
  const config::Experiment experiment = config::loadExperiment(path);
  PlannerConfig result;
  result.arm = experiment.arm;
  result.hand = experiment.hand;
  result.ball = experiment.ball;
  config::Section section = config::processSection(path, "planner");
  result.limit_share = section.number("limit_share", {0.5, 1});
  result.random_starts = section.integer("random_starts", 0, 1000);
  result.max_evaluations = section.integer("max_evaluations", 1, 10000);
  result.landing_tolerance = section.number("landing_tolerance", {1e-5, 0.1});
  result.motion.sample_time = section.number("sample_time", {0.001, 0.02});
  result.motion.max_samples = section.integer("max_samples", 100, 610);
  result.motion.ready_time = section.number("ready_time", {0, 10});
  result.motion.approach_speed = section.number("approach_speed", {0.05, 1});
  result.swing = readSwing(section.section("swing"));
  result.release = readRelease(section.section("release"));
  section.finish();
  result.swing.wrist_limit = result.hand.wrist_limit;
  return result;
}

}  // namespace fastball::planner
