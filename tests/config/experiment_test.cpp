#include "config/experiment.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

#include "model/contact.h"
#include "tests/config/temporary_folder.h"

namespace fastball::config {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

const char* const kSource = FASTBALL_SOURCE_DIR "/config";

/// A copy of the project's configuration in which single lines can be changed.
class ChangedExperiment : public testing::Test {
 protected:
  ChangedExperiment() {
    for (const auto& entry : fs::recursive_directory_iterator(kSource)) {
      if (entry.path().extension() == ".yaml") {
        const fs::path copy = folder_.path() / fs::relative(entry.path(), kSource);
        fs::create_directories(copy.parent_path());
        fs::copy_file(entry.path(), copy);
      }
    }
  }

  /// Replaces the first line of `file` that starts with `start`, and returns its number.
  int change(const std::string& file, const std::string& start, const std::string& line) {
    std::ifstream in(folder_.path() / file);
    std::ostringstream out;
    int changed = 0;
    int number = 0;
    for (std::string text; std::getline(in, text);) {
      ++number;
      const bool here = changed == 0 && text.rfind(start, 0) == 0;
      changed = here ? number : changed;
      out << (here ? line : text) << '\n';
    }
    EXPECT_GT(changed, 0) << "no line of " << file << " starts with " << start;
    folder_.write(file, out.str());
    return changed;
  }

  std::string path() const { return (folder_.path() / "experiment.yaml").string(); }
  std::string fault() const {
    return faultOf([this] { loadExperiment(path()); });
  }
  /// Changes a line and expects the fault to name file, line and key.
  void expectFault(const std::string& file,
                   const std::string& start,
                   const std::string& line,
                   const std::string& key,
                   const std::string& more = "") {
    const int number = change(file, start, line);
    EXPECT_THAT(fault(),
                AllOf(HasSubstr(file + ":" + std::to_string(number) + ": key '" + key + "': "),
                      HasSubstr(more)));
  }

  TemporaryFolder folder_;
};

TEST(Experiment, TheDefaultIsThePapersThrowWithTheArmOnItsUsualSupply) {
  const Experiment experiment = loadExperiment(std::string(kSource) + "/experiment.yaml");
  EXPECT_EQ(experiment.arm.profile, "wam4-48v");
  EXPECT_EQ(experiment.arm.dh[2].d, 0.55);
  EXPECT_EQ(experiment.arm.qd_max, Eigen::Vector4d(2.386, 3.548, 5.960, 5.568));
  EXPECT_EQ(experiment.ball.radius, 0.05);
  EXPECT_EQ(experiment.target.p_WTarget, Eigen::Vector3d(3, 0, -0.5));
  EXPECT_EQ(experiment.target.rightAxis(), -Eigen::Vector3d::UnitY());
  EXPECT_EQ(experiment.hand.p_HBall, Eigen::Vector3d(0, 0, 0.15));
}

TEST(Experiment, ThePayloadIsTheHandWithItsBall) {
  const Experiment experiment = loadExperiment(std::string(kSource) + "/experiment.yaml");
  const model::RigidBody& payload = experiment.hand.payload;
  EXPECT_NEAR(payload.mass, 0.833, 1e-12);
  EXPECT_NEAR(payload.p_BCom.z(), (0.8 * 0.07 + 0.033 * 0.15) / 0.833, 1e-12);
  // Two bodies d apart add the reduced mass times d^2.
  const double reduced = 0.8 * 0.033 / 0.833;
  EXPECT_NEAR(payload.I_BCom(0, 0), 0.0013 + 0.4 * 0.033 * 0.0025 + reduced * 0.08 * 0.08, 1e-12);
  EXPECT_NEAR(payload.I_BCom(2, 2), 0.0010 + 0.4 * 0.033 * 0.0025, 1e-12);
}

TEST(Experiment, TheFastProfileDiffersInItsSpeedsOnly) {
  TemporaryFolder folder;
  const Experiment slow = loadExperiment(std::string(kSource) + "/experiment.yaml");
  const std::string config = kSource;
  const Experiment fast = loadExperiment(folder.write(
      "fast.yaml", "arm: " + config + "/arm/wam4-90v.yaml\nhand: " + config +
                       "/hand.yaml\nball: " + config +
                       "/ball.yaml\ntarget: {position: [3, 0, -0.5], normal: [-1, 0, 0], radius: "
                       "0.1}\nrest: {q: [0, 0, 0, 0]}\n"));
  EXPECT_EQ(fast.arm.profile, "wam4-90v");
  EXPECT_TRUE(fast.arm.qd_max.isApprox(slow.arm.qd_max * 90 / 48, 3e-4));
  EXPECT_EQ(fast.arm.tau_max, slow.arm.tau_max);
}

TEST(Experiment, TheDefaultPathIsTheSourceTreesUnlessTheEnvironmentNamesOne) {
  unsetenv("FASTBALL_CONFIG");
  EXPECT_TRUE(fs::equivalent(defaultExperimentPath(), std::string(kSource) + "/experiment.yaml"));
  setenv("FASTBALL_CONFIG", "/some/where.yaml", 1);
  EXPECT_EQ(defaultExperimentPath(), "/some/where.yaml");
  unsetenv("FASTBALL_CONFIG");
}

TEST_F(ChangedExperiment, AnUnknownTopLevelKeyIsAnErrorForEveryReader) {
  const int line = change("experiment.yaml", "ball:", "bal: ball.yaml");
  const std::string expected = "experiment.yaml:" + std::to_string(line) + ": key 'bal': ";
  EXPECT_THAT(fault(), HasSubstr(expected));
  EXPECT_THAT(faultOf([this] { processSection(path(), "planner"); }), HasSubstr(expected));
}

TEST_F(ChangedExperiment, AProcessGetsItsOwnSection) {
  folder_.write("mine.yaml", "planner: {speed: 3}\ncontroller: 7\n");
  const std::string mine = (folder_.path() / "mine.yaml").string();
  EXPECT_EQ(processSection(mine, "planner").number("speed"), 3);
  EXPECT_THAT(faultOf([&] { processSection(mine, "controller"); }),
              HasSubstr("mine.yaml:2: key 'controller': "));
  EXPECT_THAT(faultOf([&] { processSection(mine, "tracker"); }),
              HasSubstr("mine.yaml:1: key 'tracker': is missing"));
}

TEST_F(ChangedExperiment, MissingFilesAreNamedWhereTheyAreCalledFor) {
  expectFault("experiment.yaml", "arm:", "arm: arm/wam5.yaml", "arm", "wam5.yaml");
}

TEST_F(ChangedExperiment, TheArmsFaultsAreNamed) {
  expectFault("arm/wam4-48v.yaml", "velocity_max:", "velocity_max: [1, 2, 0, 4]", "velocity_max",
              "number 3 is 0");
  change("arm/wam4-48v.yaml", "velocity_max:", "velocity_max: [1, 2, 3, 4]");
  expectFault("arm/wam4.yaml", "q_max:", "q_max: [2.6, 2.0, 2.8, -0.8]", "q_max", "joint 4");
  change("arm/wam4.yaml", "q_max:", "q_max: [2.6, 2.0, 2.8, 3.1]");
  expectFault("arm/wam4.yaml", "    inertia:", "    inertia: {xx: 1, yy: 1, zz: 3}", "inertia",
              "no rigid body");
  change("arm/wam4.yaml", "    inertia:", "    inertia: {xx: 1, yy: 1, zz: 1}");
  expectFault("arm/wam4.yaml", "    mass:", "    mass: -1", "mass", "must be positive");
}

TEST_F(ChangedExperiment, ABallThatTheGripWouldCrushIsRejected) {
  const double least = 18.0 * 27 / (4 * M_PI * 0.05 * 0.05);
  change("ball.yaml", "youngs_modulus:", "youngs_modulus: " + std::to_string(least + 1));
  EXPECT_EQ(fault(), "");
  EXPECT_GE(model::maximumForce(loadExperiment(path()).ball), 18.0);
  expectFault("ball.yaml", "youngs_modulus:", "youngs_modulus: " + std::to_string(least - 1),
              "youngs_modulus", "18 N");
}

TEST_F(ChangedExperiment, ABallWithoutSizeOrMassIsRejected) {
  expectFault("ball.yaml", "radius:", "radius: 0", "radius");
  change("ball.yaml", "radius:", "radius: 0.05");
  expectFault("ball.yaml", "mass:", "mass: 0", "mass", "must be positive");
}

TEST_F(ChangedExperiment, TheHandsPartsAddUp) {
  change("hand.yaml", "finger_mass:", "finger_mass: 0.2");
  EXPECT_THAT(fault(), AllOf(HasSubstr("key 'whole': "), HasSubstr("0.8"), HasSubstr("1.1")));
}

TEST_F(ChangedExperiment, ABallInsideThePalmIsRejected) {
  expectFault("hand.yaml", "ball_position:", "ball_position: [0, 0, 0.13]", "ball_position",
              "palm");
}

TEST_F(ChangedExperiment, ANetWithoutADirectionIsRejected) {
  expectFault("experiment.yaml", "  normal:", "  normal: [-0.5, 0, 0]", "normal", "length");
}

TEST_F(ChangedExperiment, TheArmRestsInsideItsStops) {
  expectFault("experiment.yaml", "  q:", "  q: [0, 1.95, 0, 0]", "q", "joint 2 is 1.95");
}

}  // namespace
}  // namespace fastball::config
