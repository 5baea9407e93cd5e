#include "config/experiment.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "config/arm_file.h"
#include "config/hand_file.h"

namespace fastball::config {

namespace {

namespace fs = std::filesystem;

constexpr const char* kKnownKeys[] = {"arm",        "hand",    "ball",       "target",
                                      "rest",       "planner", "controller", "hand_server",
                                      "simulation", "cameras", "tracker",    "run"};

/// The experiment file with its top-level keys checked.
Section openExperiment(const std::string& path) {
  Section file = Section::fromFile(path);
  for (const char* key : kKnownKeys) {
    file.ignore(key);
  }
  file.finish();
  return file;
}

model::Target readTarget(Section section) {
  model::Target target;
  target.p_WTarget = section.vector("position", 3, {-100, 100});
  target.n_WTarget = section.vector("normal", 3, {-1, 1});
  target.radius = section.number("radius", kPositive);
  section.finish();
  if (std::abs(target.n_WTarget.norm() - 1) > 1e-3) {
    throw section.error("normal", fmt::format("has the length {}, must have 1 within 0.001",
                                              target.n_WTarget.norm()));
  }
  target.n_WTarget.normalize();
  return target;
}

Eigen::Vector4d readRest(Section section, const model::ArmParameters& arm) {
  Eigen::Vector4d q = section.vector("q", model::kArmJoints);
  section.finish();
  for (int i = 0; i < model::kArmJoints; ++i) {
    const double low = arm.q_min[i] + arm.position_margin;
    const double high = arm.q_max[i] - arm.position_margin;
    if (q[i] < low || q[i] > high) {
      throw section.error("q", fmt::format("joint {} is {}, must be in [{}, {}] (the arm's stops "
                                           "less its position margin)",
                                           i + 1, q[i], low, high));
    }
  }
  return q;
}

}  // namespace

Experiment loadExperiment(const std::string& path) {
  Section file = openExperiment(path);
  Experiment experiment;
  experiment.path = path;
  experiment.arm = readArm(file.file("arm"));
  experiment.ball = readBall(file.file("ball"));
  experiment.hand = readHand(file.file("hand"), experiment.ball);
  experiment.target = readTarget(file.section("target"));
  experiment.q_rest = readRest(file.section("rest"), experiment.arm);
  return experiment;
}

Section processSection(const std::string& path, const std::string& process) {
  return openExperiment(path).section(process);
}

std::string defaultExperimentPath() {
  // Read before any thread is started.
  const char* named = std::getenv("FASTBALL_CONFIG");  // NOLINT(concurrency-mt-unsafe)
  if (named != nullptr && *named != '\0') {
    return named;
  }
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  const fs::path installed =
      program.parent_path().parent_path() / "share/fastball/config/experiment.yaml";
  const fs::path source = fs::path(FASTBALL_CONFIG_SOURCE_DIR) / "experiment.yaml";
  return (fs::exists(source, error) && !fs::exists(installed, error) ? source : installed).string();
}

std::string experimentPath(const std::string& named) {
  return named.empty() ? defaultExperimentPath() : named;
}

}  // namespace fastball::config
