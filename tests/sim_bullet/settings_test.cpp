// The experiment file's section and the uncertainty file: read strictly, refused with file, line and key.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim_bullet/config.h"
#include "sim_bullet/uncertainty.h"
#include "tests/config/temporary_folder.h"
#include "tests/sim_bullet/test_scene.h"

namespace fastball::sim_bullet {
namespace {

using config::faultOf;
using testing::AllOf;
using testing::HasSubstr;

TEST(SimulationSettings, TheDefaultExperimentIsRead) {
  EXPECT_EQ(simulation().substeps, 10);
  EXPECT_GT(simulation().arm_stop.stiffness, 0);
}

TEST(SimulationSettings, RefusesWhatItDoesNotKnowOrCannotBe) {
  const config::TemporaryFolder folder;
  const auto faultIn = [&](const std::string& text) {
    const std::string path = folder.write("experiment.yaml", text);
    return faultOf([&] { loadSimulationSettings(path); });
  };
  EXPECT_THAT(faultIn("simulation: {substeps: 0}"),
              AllOf(HasSubstr("experiment.yaml:1"), HasSubstr("'substeps'")));
  EXPECT_THAT(faultIn("simulation:\n  substeps: 10\n"), HasSubstr("'watchdog'"));
  EXPECT_THAT(faultIn("simulation:\n  substeps: 10\n  watchdog: -1\n"),
              AllOf(HasSubstr("experiment.yaml:3"), HasSubstr("'watchdog'")));
}

class UncertaintyFile : public testing::Test {
 protected:
  Uncertainty load(const std::string& text) {
    return loadUncertainty(folder_.write("errors.yaml", text));
  }
  std::string faultIn(const std::string& text) {
    return faultOf([&] { load(text); });
  }
  config::TemporaryFolder folder_;
};

TEST_F(UncertaintyFile, GivesWhatItGivesAndNothingElse) {
  const Uncertainty read = load("ball_offset_sd: 0.002\nfriction: [0.5, 1.0]\n");
  EXPECT_EQ(read.ball_offset_sd, 0.002);
  EXPECT_EQ(read.friction->high, 1.0);
  EXPECT_EQ(read.mass_rel_sd, 0);
  EXPECT_FALSE(read.youngs_modulus);
}

TEST_F(UncertaintyFile, TheExampleIsRead) {
  const Uncertainty read = loadUncertainty(FASTBALL_SOURCE_DIR "/config/uncertainty.yaml");
  EXPECT_GT(read.opening_delay_sd, 0);
  EXPECT_TRUE(read.youngs_modulus);
}

TEST_F(UncertaintyFile, RefusesAbsurdValuesWithFileLineAndKey) {
  const std::vector<std::pair<std::string, std::string>> faults{
      {"ball_ofset_sd: 0.001", "ball_ofset_sd"},
      {"ball_offset_sd: 3", "ball_offset_sd"},
      {"mass_rel_sd: -0.1", "mass_rel_sd"},
      {"drag_rel_sd: .nan", "drag_rel_sd"},
      {"youngs_modulus: [1, 2]", "youngs_modulus"},
      {"youngs_modulus: [1e6, 2e5]", "youngs_modulus"},
      {"friction: 0.8", "friction"},
      {"encoder_bias_sd: much", "encoder_bias_sd"},
      {"opening_delay_sd: 1", "opening_delay_sd"},
      {"finger_delay_sd: 1", "finger_delay_sd"}};
  for (const auto& [line, key] : faults)
    EXPECT_THAT(faultIn("# errors\n" + line + "\n"),
                AllOf(HasSubstr("errors.yaml:2"), HasSubstr("'" + key + "'")));
}

TEST(SceneErrors, NoFileNoErrors) {
  const SceneErrors errors = drawErrors({}, experiment().ball, 5);
  EXPECT_EQ(errors.ball_offset_H.norm(), 0);
  EXPECT_EQ(errors.encoder_bias.norm(), 0);
  EXPECT_EQ(errors.finger_delay[model::kThumb], 0);
  EXPECT_EQ(errors.ball.mass, experiment().ball.mass);
  EXPECT_EQ(errors.ball.youngs_modulus, experiment().ball.youngs_modulus);
}

TEST(SceneErrors, DrawsHaveTheirSpreadAndTheirBounds) {
  Uncertainty uncertainty;
  uncertainty.ball_offset_sd = 2e-3;
  uncertainty.mass_rel_sd = 0.05;
  uncertainty.youngs_modulus = config::Range{2e5, 1e6};
  const int n = 4000;
  double offset2 = 0, below_middle = 0;
  for (int seed = 0; seed < n; ++seed) {
    const SceneErrors errors = drawErrors(uncertainty, experiment().ball, seed);
    offset2 += errors.ball_offset_H.squaredNorm() / 3;
    below_middle += errors.ball.youngs_modulus < std::sqrt(2e5 * 1e6);
    EXPECT_LE(errors.ball_offset_H.cwiseAbs().maxCoeff(), 3 * 2e-3);
    EXPECT_NEAR(errors.ball.mass / experiment().ball.mass, 1, 3 * 0.05 + 1e-12);
    EXPECT_GE(errors.ball.youngs_modulus, 2e5);
    EXPECT_LE(errors.ball.youngs_modulus, 1e6);
  }
  EXPECT_NEAR(std::sqrt(offset2 / n), 2e-3, 0.05 * 2e-3);
  EXPECT_NEAR(below_middle / n, 0.5, 0.03);
}

TEST(SceneErrors, OneMoreErrorLeavesTheOthersAlone) {
  Uncertainty one;
  one.mass_rel_sd = 0.05;
  Uncertainty both = one;
  both.ball_offset_sd = 1e-3;
  both.youngs_modulus = config::Range{2e5, 1e6};
  EXPECT_EQ(drawErrors(one, experiment().ball, 3).ball.mass,
            drawErrors(both, experiment().ball, 3).ball.mass);
  EXPECT_NE(drawErrors(one, experiment().ball, 3).ball.mass,
            drawErrors(one, experiment().ball, 4).ball.mass);
}

}  // namespace
}  // namespace fastball::sim_bullet
