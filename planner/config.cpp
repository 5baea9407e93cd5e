#include "planner/config.h"

#include "config/release_file.h"

namespace fastball::planner {
namespace {

/// What the planner must know of the hand server and the controller to predict what they will do.
void readServos(const std::string& path, PlannerConfig& result) {
  config::Section hand_server = config::processSection(path, "hand_server");
  result.release = config::readRelease(hand_server);
  config::Section controller = config::processSection(path, "controller");
  result.support_kp << controller.vector("kp", model::kArmJoints, config::kPositive),
      result.release.kp.head<2>();
  result.support_kd << controller.vector("kd", model::kArmJoints, config::kPositive),
      result.release.kd.head<2>();
}

std::vector<Shoulder> readShoulders(config::Section& section) {
  const std::string shoulder = section.choice("shoulder", {"held", "free", "as_needed"});
  if (shoulder == "as_needed")
    return {Shoulder::kHeld, Shoulder::kFree};
  return {shoulder == "free" ? Shoulder::kFree : Shoulder::kHeld};
}

SwingSettings readSwing(config::Section& section) {
  SwingSettings swing;
  swing.omega_max = section.vector("omega_max", 3, {3, 20});
  swing.elbow_margin = section.number("elbow_margin", {0.05, 1});
  swing.body_clearance = section.number("body_clearance", {0, 0.8});
  swing.lowest_ball = section.number("lowest_ball", {-3, 0});
  swing.flexion_limit = section.number("flexion_limit", {0.01, 1});
  swing.follow.delay = section.number("follow_through", {0.01, 0.2});
  swing.follow.brake_time = section.vector("brake_time", model::kArmJoints, {0.1, 1});
  return swing;
}

RobustSettings readRobust(config::Section section) {
  RobustSettings robust;
  const Eigen::VectorXd lengths = section.vector("window_lengths", 2, {0.005, 0.1});
  robust.window_lengths.assign(lengths.begin(), lengths.end());
  robust.limit_share = section.number("limit_share", {0.5, 1});
  robust.wanted_speed = section.number("wanted_speed", {0, 20});
  config::Section errors = section.section("errors");
  robust.errors.joint_speed = errors.number("joint_speed", {0, 1});
  robust.errors.grasp = errors.number("grasp", {0, 0.05});
  robust.errors.drag = errors.number("drag", {0, 1});
  errors.finish();
  section.finish();
  return robust;
}

AtlasSettings readAtlas(config::Section section) {
  AtlasSettings atlas;
  atlas.step = section.number("step", {0.02, 1});
  const auto range = [&](const char* key, const config::Range& allowed) {
    const Eigen::Vector2d ends = section.vector(key, 2, allowed);
    if (!(ends[1] - ends[0] >= atlas.step))
      throw section.error(key, "must span at least one step");
    return ends;
  };
  atlas.distance = range("distance", {0.5, 20});
  atlas.height = range("height", {-5, 10});
  section.finish();
  return atlas;
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
  result.floor = section.number("floor", {-100, 0});
  result.motion.sample_time = section.number("sample_time", {0.001, 0.02});
  result.motion.max_samples = section.integer("max_samples", 100, 610);
  result.motion.ready_time = section.number("ready_time", {0, 10});
  result.motion.approach_speed = section.number("approach_speed", {0.05, 1});
  config::Section swing = section.section("swing");
  result.shoulders = readShoulders(swing);
  result.swing = readSwing(swing);
  swing.finish();
  result.grip_force = section.number("grip_force", {0.1, 12});
  readServos(path, result);
  result.robust = readRobust(section.section("robust"));
  result.atlas = readAtlas(section.section("atlas"));
  section.finish();
  return result;
}

}  // namespace fastball::planner
