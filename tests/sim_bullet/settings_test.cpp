// The experiment file's section and the uncertainty file: read strictly, refused with file, line and key.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim_bullet/config.h"
#include "sim_bullet/encoder_noise.h"
#include "sim_bullet/scene_errors.h"
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
  const Uncertainty read = load(
      "scale: 2\nset_up:\n  grasp_offset: {normal: 0.002, unit: m, times: 0.5}\n"
      "throw:\n  friction: {uniform: [-0.3, 0.2], unit: relative, reason: dust}\n");
  const Uncertainty::Size& grasp = read.of(Uncertainty::kSetUp, Error::kGraspOffset);
  EXPECT_EQ(grasp.distribution.shape, Distribution::Shape::kNormal);
  EXPECT_EQ(grasp.distribution.a, 0.002);
  EXPECT_EQ(grasp.size, 1);
  const Uncertainty::Size& friction = read.of(Uncertainty::kThrow, Error::kFriction);
  EXPECT_EQ(friction.distribution.b, 0.2);
  EXPECT_EQ(friction.size, 2);
  EXPECT_EQ(read.of(Uncertainty::kThrow, Error::kGraspOffset).distribution.shape,
            Distribution::Shape::kNone);
}

TEST_F(UncertaintyFile, ThePapersIsReadAndGivesEveryErrorItsReason) {
  const std::string path = FASTBALL_SOURCE_DIR "/config/uncertainty/paper.yaml";
  const Uncertainty read = loadUncertainty(path);
  for (const ErrorName& error : errorNames()) {
    SCOPED_TRACE(error.name);
    EXPECT_TRUE(read.of(Uncertainty::kSetUp, error.error).distribution.largest(1) > 0 ||
                read.of(Uncertainty::kThrow, error.error).distribution.largest(1) > 0);
  }
}

TEST_F(UncertaintyFile, RefusesWhatCannotBeWithFileLineAndKey) {
  const std::vector<std::pair<std::string, std::string>> faults{
      {"grasp_ofset: {normal: 0.001, unit: m}", "grasp_ofset"},
      {"grasp_offset: {normal: 3, unit: m}", "grasp_offset"},
      {"grasp_offset: {normal: 0.001, unit: mm}", "unit"},
      {"grasp_offset: {normal: 0.001}", "unit"},
      {"grasp_offset: {unit: m}", "grasp_offset"},
      {"grasp_offset: {normal: 0.001, uniform: [0, 1], unit: m}", "uniform"},
      {"grasp_offset: {log_uniform: [0.5, 2], unit: m}", "log_uniform"},
      {"grasp_offset: 0.001", "grasp_offset"},
      {"ball_mass: {normal: -0.1, unit: relative}", "normal"},
      {"ball_mass: {normal: 0.2, times: 99, unit: relative}", "ball_mass"},
      {"drag: {normal: .nan, unit: relative}", "normal"},
      {"stiffness: {log_uniform: [2, 0.5], unit: relative}", "log_uniform"},
      {"opening_delay: {normal: 0.001, unit: s}", "opening_delay"},
      {"opening_delay: {uniform: [-0.001, 0.001], unit: s}", "opening_delay"},
      {"encoder_noise: {normal: 1e-4, unit: rad}", "encoder_noise"}};
  for (const auto& [line, key] : faults) {
    EXPECT_THAT(faultIn("set_up:\n  " + line + "\n"),
                AllOf(HasSubstr("errors.yaml:2"), HasSubstr("'" + key + "'")))
        << line;
  }
  EXPECT_THAT(faultIn("throw:\n  camera_position: {normal: 0.01, unit: m}\n"),
              AllOf(HasSubstr("errors.yaml:2"), HasSubstr("'camera_position'")));
}

TEST(SceneErrors, NoFileNoErrors) {
  const SceneErrors errors = drawErrors({}, experiment().ball, {5, 5});
  EXPECT_EQ(errors.ball_offset_H.norm(), 0);
  EXPECT_EQ(errors.encoder_offset.norm(), 0);
  EXPECT_EQ(errors.finger_delay[model::kThumb], 0);
  EXPECT_EQ(errors.ball.mass, experiment().ball.mass);
  EXPECT_EQ(errors.ball.youngs_modulus, experiment().ball.youngs_modulus);
  EXPECT_TRUE(errors.room.X_WRoom.isApprox(Eigen::Isometry3d::Identity(), 0));
}

TEST(SceneErrors, DrawsHaveTheirSpreadAndTheirBounds) {
  Uncertainty uncertainty;
  uncertainty.setNormal(Uncertainty::kThrow, Error::kGraspOffset, 2e-3);
  uncertainty.setNormal(Uncertainty::kThrow, Error::kBallMass, 0.05);
  uncertainty.of(Uncertainty::kThrow, Error::kStiffness) = {
      {Distribution::Shape::kLogUniform, 0.5, 2}, 2};
  const int n = 4000;
  double offset2 = 0, below_middle = 0;
  for (int seed = 0; seed < n; ++seed) {
    const SceneErrors errors = drawErrors(uncertainty, experiment().ball, {0, seed});
    offset2 += errors.ball_offset_H.squaredNorm() / 3;
    const double stiffness = errors.ball.youngs_modulus / experiment().ball.youngs_modulus;
    below_middle += stiffness < 1;
    EXPECT_LE(errors.ball_offset_H.cwiseAbs().maxCoeff(), 3 * 2e-3);
    EXPECT_NEAR(errors.ball.mass / experiment().ball.mass, 1, 3 * 0.05 + 1e-12);
    EXPECT_GE(stiffness, 0.25 - 1e-12);
    EXPECT_LE(stiffness, 4 + 1e-12);
  }
  EXPECT_NEAR(std::sqrt(offset2 / n), 2e-3, 0.05 * 2e-3);
  EXPECT_NEAR(below_middle / n, 0.5, 0.03);
}

TEST(SceneErrors, OfASetUpStayTheSameFromThrowToThrow) {
  Uncertainty uncertainty;
  uncertainty.setNormal(Uncertainty::kSetUp, Error::kBallMass, 0.05);
  uncertainty.setNormal(Uncertainty::kThrow, Error::kDrag, 0.05);
  const SceneErrors one = drawErrors(uncertainty, experiment().ball, {1, 10});
  const SceneErrors next = drawErrors(uncertainty, experiment().ball, {1, 11});
  const SceneErrors other = drawErrors(uncertainty, experiment().ball, {2, 10});
  EXPECT_EQ(one.ball.mass, next.ball.mass);
  EXPECT_NE(one.ball.mass, other.ball.mass);
  EXPECT_NE(one.ball.drag_coefficient, next.ball.drag_coefficient);
  EXPECT_EQ(one.ball.drag_coefficient, other.ball.drag_coefficient);
}

TEST(SceneErrors, OneMoreErrorLeavesTheOthersAlone) {
  const SceneSeeds seeds{0, 3};
  Uncertainty one;
  one.setNormal(Uncertainty::kThrow, Error::kBallMass, 0.05);
  Uncertainty more = one;
  more.setNormal(Uncertainty::kThrow, Error::kGraspOffset, 1e-3);
  more.setUniform(Uncertainty::kSetUp, Error::kFriction, -0.1, 0.1);
  EXPECT_EQ(drawErrors(one, experiment().ball, seeds).ball.mass,
            drawErrors(more, experiment().ball, seeds).ball.mass);
  EXPECT_NE(drawErrors(one, experiment().ball, seeds).ball.mass,
            drawErrors(one, experiment().ball, {0, 4}).ball.mass);
}

TEST(SceneErrors, AMovedArmSeesTheRoomMovedTheOtherWayAndItsCamerasWithIt) {
  Uncertainty uncertainty;
  uncertainty.setNormal(Uncertainty::kSetUp, Error::kBasePosition, 0.01);
  uncertainty.setNormal(Uncertainty::kSetUp, Error::kBaseYaw, 0.01);
  const RoomErrors room = drawErrors(uncertainty, experiment().ball, {4, 1}).room;
  const model::Target ordered = experiment().target;
  const model::Target real = room.target(ordered);
  EXPECT_GT((real.p_WTarget - ordered.p_WTarget).norm(), 1e-3);
  model::Camera camera;
  camera.fx = camera.fy = 900;
  camera.p_CW = {0.1, 0.2, 5};
  const model::Camera moved = movedCamera(camera, {}, room);
  EXPECT_LT((moved.project(real.p_WTarget) - camera.project(ordered.p_WTarget)).norm(), 1e-9)
      << "a camera of the room does not see where the arm stands";
}

TEST(SceneErrors, AMovedCameraSeesEverythingElsewhere) {
  model::Camera camera;
  camera.fx = camera.fy = 1000;
  camera.p_CW = {0, 0, 5};
  CameraErrors errors;
  errors.position = {0.005, 0, 0};
  // 5 mm to the right at 5 m: everything is 1 px further left.
  const Eigen::Vector2d pixel = movedCamera(camera, errors, {}).project({0, 0, 0});
  EXPECT_NEAR(pixel.x() - camera.project({0, 0, 0}).x(), -1, 1e-6);
}

TEST(EncoderNoise, HasItsSizeAndItsSpeedIsItsDerivative) {
  const double sd = 1e-4, dt = 1e-3;
  EncoderNoise noise(sd, dt, 3);
  double squares = 0;
  const int n = 200000;
  for (int i = 0; i < n; ++i) {
    const Eigen::Vector4d before = noise.q();
    noise.step();
    squares += noise.q().squaredNorm() / 4;
    EXPECT_LT((noise.q() - before - dt * noise.qd()).norm(), 1e-15);
  }
  EXPECT_NEAR(std::sqrt(squares / n), sd, 0.1 * sd);
  EXPECT_EQ(EncoderNoise(0, dt, 3).q().norm(), 0);
}

}  // namespace
}  // namespace fastball::sim_bullet
