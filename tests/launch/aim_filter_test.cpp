// What strategy adaptive learns from landings.
#include "launch/aim_filter.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <filesystem>
#include <random>

#include "tests/config/temporary_folder.h"

namespace fastball::launch {
namespace {

using config::faultOf;
using Eigen::Matrix2d;
using Eigen::Vector2d;
using testing::HasSubstr;

const AimSettings kSettings{0.1, 0.05, 0.008, 0.1, 0.02, 3.0};
const model::BallParameters kBall{0.05, 0.033, 0.47, 1.2, 5e5, 0.2, 0.8, 1e4, 20};

/// A throw of 5 m/s at the default target.
model::LandingJacobian jacobian() {
  model::Target target;
  target.p_WTarget = {3, 0, -0.5};
  target.radius = 0.1;
  return model::landingJacobian({{0.2, 0, 0.5}, {4.9, 0.1, 1.0}}, target, kBall, 9.81);
}

/// Lets a filter aim `throws` throws of a set-up that adds `bias` [m] to each landing, which scatters. @param obeyed what the
/// arm makes of a correction. @return the landings.
std::vector<Vector2d> thrown(AimFilter& filter,
                             const Vector2d& bias,
                             double scatter,
                             int throws,
                             double obeyed = 1,
                             unsigned seed = 1) {
  const model::LandingJacobian H = jacobian();
  std::mt19937 engine(seed);
  std::normal_distribution<double> normal(0, scatter);
  std::vector<Vector2d> landings;
  for (int i = 0; i < throws; ++i) {
    const Vector2d expected = H * filter.biases();  // and the planner aims there less
    landings.push_back(-obeyed * expected + bias + Vector2d(normal(engine), normal(engine)));
    filter.observe(H, Vector2d::Zero(), landings.back(), Matrix2d::Identity() * 1e-6);
  }
  return landings;
}

TEST(AimFilter, LearnsAFixedErrorWithinAFewThrows) {
  AimFilter filter(kSettings);
  const std::vector<Vector2d> landings = thrown(filter, {0.06, -0.05}, 0, 8);
  EXPECT_NEAR(landings.front().norm(), 0.078, 1e-3);
  EXPECT_LT(landings[2].norm(), 0.04);
  EXPECT_LT(landings[7].norm(), 0.01);
}

TEST(AimFilter, WithoutErrorsLeavesTheAimAlone) {
  AimFilter filter(kSettings);
  thrown(filter, {0, 0}, 0, 5);
  EXPECT_EQ(filter.biases().norm(), 0);
}

TEST(AimFilter, HardlyAddsToRandomScatter) {
  AimFilter filter(kSettings);
  const double scatter = 0.02;
  double squares = 0;
  const int n = 4000;
  for (const Vector2d& landing : thrown(filter, {0, 0}, scatter, n))
    squares += landing.squaredNorm() / 2;
  EXPECT_LT(std::sqrt(squares / n), 1.15 * scatter);
}

TEST(AimFilter, DoesNotDivergeWithAnArmThatObeysTooMuchOrTooLittle) {
  for (const double obeyed : {0.5, 1.0, 1.5}) {
    AimFilter filter(kSettings);
    for (const Vector2d& landing : thrown(filter, {0.1, 0.1}, 0.1, 2000, obeyed, 3))
      ASSERT_LT(landing.norm(), 1.0) << obeyed;
    const Eigen::SelfAdjointEigenSolver<AimFilter::Covariance> spectrum(filter.covariance());
    EXPECT_GE(spectrum.eigenvalues().minCoeff(), 0);
  }
}

TEST(AimFilter, AThrowFarOffCountsLittle) {
  AimFilter filter(kSettings);
  thrown(filter, {0.02, 0}, 0.01, 20);
  const Vector2d before = jacobian() * filter.biases();
  filter.observe(jacobian(), Vector2d::Zero(), {1.5, -0.8}, Matrix2d::Identity() * 1e-6);
  EXPECT_LT((jacobian() * filter.biases() - before).norm(), 0.02);
}

TEST(AimFilter, LearnsNothingFromNumbersThatOverflow) {
  AimFilter filter(kSettings);
  thrown(filter, {0.06, -0.05}, 0, 2);
  const model::LandingBiases before = filter.biases();
  filter.observe(jacobian(), Vector2d::Zero(), {1e200, -1e300}, Matrix2d::Identity() * 1e-6);
  EXPECT_EQ(filter.biases(), before);
  EXPECT_TRUE(filter.covariance().allFinite());
}

TEST(AimFilter, FollowsASetUpThatChanges) {
  AimFilter filter(kSettings);
  thrown(filter, {0.05, 0}, 0.005, 200);
  const std::vector<Vector2d> after = thrown(filter, {-0.03, 0.04}, 0.005, 60);
  EXPECT_LT(after.back().norm(), 0.03);
}

TEST(AimFilter, GoesOnFromItsFile) {
  const config::TemporaryFolder folder;
  const std::string path = folder.path() / "learned.yaml";
  AimFilter filter(kSettings);
  filter.load(path);  // not there yet: nothing is known
  EXPECT_EQ(filter.throws(), 0);
  thrown(filter, {0.03, 0.02}, 0.01, 7);
  filter.save(path);
  AimFilter read(kSettings);
  read.load(path);
  EXPECT_EQ(read.throws(), 7);
  EXPECT_EQ(read.biases(), filter.biases());
  EXPECT_EQ(read.covariance(), filter.covariance());
}

TEST(AimFilter, RefusesAFileThatIsNone) {
  const config::TemporaryFolder folder;
  const auto faultIn = [&](const std::string& text) {
    const std::string path = folder.write("learned.yaml", text);
    return faultOf([&] { AimFilter(kSettings).load(path); });
  };
  const std::string zeros = "[0, 0, 0, 0, 0, 0]";
  std::string covariance = "covariance:\n  - [-1, 0, 0, 0, 0, 0]\n";
  for (int i = 0; i < 5; ++i)
    covariance += "  - " + zeros + "\n";
  EXPECT_THAT(faultIn("throws: 1\nbiases: " + zeros + "\n" + covariance), HasSubstr("eigenvalues"));
  EXPECT_THAT(faultIn("throws: -1\n"), HasSubstr("'throws'"));
  EXPECT_THAT(faultIn("throws: 1\nbiases: [0, 0]\n"), HasSubstr("'biases'"));
  EXPECT_THAT(faultIn("throws: 1\nbiases: [.nan, 0, 0, 0, 0, 0]\n"), HasSubstr("'biases'"));
}

}  // namespace
}  // namespace fastball::launch
