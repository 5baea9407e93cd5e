// The numbers behind `fastball figures`, and the command itself.
#include <gmock/gmock.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <sstream>

#include "launch/commands.h"
#include "launch/figures/level_swing.h"
#include "launch/figures/passive_bend.h"
#include "launch/figures/planned_swing.h"
#include "launch/figures/search.h"
#include "launch/figures/table.h"
#include "launch/figures/torque_budget.h"
#include "launch/figures/tracking.h"
#include "tests/config/temporary_folder.h"

namespace fastball::launch {
namespace {

using testing::HasSubstr;

const std::string kExperiment = FASTBALL_SOURCE_DIR "/config/experiment.yaml";

const config::Experiment& experiment() {
  static const config::Experiment loaded = config::loadExperiment(kExperiment);
  return loaded;
}

model::SwingParameters wamParameters() {
  return model::swingParameters(experiment().arm, experiment().hand.payload,
                                experiment().hand.p_HBall);
}

model::Arm loadedArm() {
  return model::Arm(experiment().arm, experiment().hand.payload);
}

TEST(Oscillation, FindsFrequencyAndMeanOfASine) {
  for (const double omega : {0.7, 5.0, 30.0}) {
    Curve curve;
    for (double t = 0; t < 20; t += 0.002) {
      curve.t.push_back(t);
      curve.y.push_back(1.3 + 0.2 * std::sin(omega * t + 0.4));
    }
    const Oscillation found = oscillation(curve);
    EXPECT_NEAR(found.omega, omega, 1e-4 * omega);
    EXPECT_NEAR(found.mean, 1.3, 1e-3);
  }
}

TEST(Oscillation, OfACurveThatDoesNotOscillateHasNoFrequency) {
  EXPECT_EQ(oscillation({{0, 1, 2, 3}, {0, 1, 2, 3}}).omega, 0);
}

TEST(FitLine, IsExactForALineAndRefusesASinglePlace) {
  const Line line = fitLine({1, 2, 4}, {5, 7, 11});
  EXPECT_NEAR(line.slope, 2, 1e-12);
  EXPECT_NEAR(line.offset, 3, 1e-12);
  EXPECT_THROW(fitLine({1, 1}, {2, 3}), std::invalid_argument);
}

/// Frequency of joint 2 left to itself.
Oscillation passive(const model::SwingParameters& p, double qd1, double qd3, double off) {
  return oscillation(
      passiveBend(model::LevelSwingModel(p), qd1, qd3, M_PI / 2 - off, 8 * M_PI, 0.01).q2);
}

TEST(PassiveBend, FrequencyFollowsDq1AndNotDq3AboutAQuarterTurn) {
  std::vector<double> qd1{4, 6, 8, 10}, qd3{0.5, 1, 1.5, 2}, by_qd1, by_qd3;
  for (const double speed : qd1)
    by_qd1.push_back(passive(wamParameters(), speed, 1, 0.3).omega);
  for (const double speed : qd3) {
    const Oscillation found = passive(wamParameters(), 8, speed, 0.3);
    by_qd3.push_back(found.omega);
    EXPECT_NEAR(found.mean, M_PI / 2, 0.01);
  }
  EXPECT_NEAR(fitLine(qd1, by_qd1).slope, 1, 0.06);
  EXPECT_NEAR(fitLine(qd3, by_qd3).slope, 0, 0.15);
}

TEST(PassiveBend, IsEq7UnderAHeavyUpperArm) {
  model::SwingParameters heavy = wamParameters();
  heavy.m1 *= 1e5;
  for (const double qd3 : {0.0, 1.0, 5.0})
    EXPECT_NEAR(passive(heavy, 6, qd3, 0.01).omega, 6, 0.005) << qd3;
}

TEST(PassiveBend, IsPumpedByAFastJoint3) {
  const model::LevelSwingModel model(wamParameters());
  const auto farthest = [&](double qd3) {
    double off = 0;
    for (const double q2 : passiveBend(model, 8, qd3, M_PI / 2 - 0.3, 20, 0.01).q2.y)
      off = std::max(off, std::abs(q2 - M_PI / 2));
    return off;
  };
  EXPECT_LT(farthest(1), 0.5);
  EXPECT_GT(farthest(6), M_PI / 2) << "past the axis";
}

TEST(Search, FindsTheCornerOfTheDiscAndOfItsBounds) {
  SearchProblem problem;
  problem.lower = Eigen::Vector2d(-2, -2);
  problem.upper = Eigen::Vector2d(2, 2);
  problem.evaluate = [](const Eigen::VectorXd& x) {
    return SearchProblem::Values{x[0] + x[1], Eigen::VectorXd::Constant(1, x.squaredNorm() - 1)};
  };
  SearchResult found = searchFrom(problem, Eigen::Vector2d(0.3, -0.2), 200);
  EXPECT_NEAR(found.worth, std::sqrt(2.0), 1e-5);
  EXPECT_LT(found.violation, 1e-6);
  problem.upper = Eigen::Vector2d(0.1, 2);
  found = searchFrom(problem, Eigen::Vector2d(0, 0), 200);
  EXPECT_NEAR(found.x[0], 0.1, 1e-9);
  EXPECT_NEAR(found.x[1], std::sqrt(0.99), 1e-5);
}

class LevelSwingTest : public testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(WithTorqueShare,
                         LevelSwingTest,
                         testing::Values(1.0, 0.1),
                         [](const auto& test) { return test.param == 1 ? "All" : "Tenth"; });

TEST_P(LevelSwingTest, KeepsItsLimitsBetweenTheSamplesToo) {
  const model::LevelSwingModel model(wamParameters());
  const SwingLimits limits = levelSwingLimits(experiment().arm, {4, 6, 7}, GetParam());
  const LevelSwing found = fastestLevelSwing(model, limits, 8, 1);
  ASSERT_GT(found.release_speed, 3);
  const BaseSwing& swing = found.swing;
  double fastest = 0;
  for (double t = swing.start(); t <= swing.end(); t += 1e-4) {
    const model::SwingAngles s = swing.at(t);
    const Eigen::Vector3d tau = model.inverseDynamics(s.q, s.qd, s.qdd);
    fastest = std::max(fastest, model.endEffectorVelocity(s.q, s.qd).norm());
    for (int j = 0; j < 3; ++j) {
      EXPECT_LT(std::abs(s.qd[j]), 1.001 * limits.qd_max[j]) << t;
      EXPECT_LT(std::abs(tau[j]), 1.02 * found.torque_share * limits.tau_max[j]) << t;
      EXPECT_LT(s.q[j], limits.q_max[j] + 1e-3) << t;
      EXPECT_GT(s.q[j], limits.q_min[j] - 1e-3) << t;
    }
  }
  EXPECT_NEAR(fastest, found.release_speed, 1e-3) << "the release is the fastest moment";
  EXPECT_LE(found.torque_share, 1 + 1e-6);
  const LevelSwing again = fastestLevelSwing(model, limits, 8, 1);
  EXPECT_EQ(again.release_speed, found.release_speed) << "the same seed, the same swing";
}

TEST(LevelSwing, SpeedLimitsBindWithAllTheTorqueAndTorqueWithATenth) {
  const model::LevelSwingModel model(wamParameters());
  const LevelSwing all = fastestLevelSwing(model, levelSwingLimits(experiment().arm, {4, 6, 7}, 1),
                                           8, 1),
                   tenth = fastestLevelSwing(
                       model, levelSwingLimits(experiment().arm, {4, 6, 7}, 0.1), 8, 1);
  const SwingLimits limits = levelSwingLimits(experiment().arm, {4, 6, 7}, 1);
  for (int j = 0; j < 3; ++j)
    EXPECT_NEAR(std::abs(all.swing.at(0).qd[j]) / limits.qd_max[j], 1, 0.01);
  EXPECT_LT(all.torque_share, 0.5);
  EXPECT_NEAR(tenth.torque_share, 1, 0.01);
  EXPECT_LT(tenth.release_speed, all.release_speed - 0.5);
}

TEST(LevelSwing, TorqueOfJoint2TurnsWhereOmega2DoesAndJoint3NeedsLittle) {
  const model::LevelSwingModel model(wamParameters());
  const SwingLimits limits = levelSwingLimits(experiment().arm, {4, 6, 7}, 1);
  const BaseSwing swing = fastestLevelSwing(model, limits, 8, 1).swing;
  const auto torque = [&](double t) {
    const model::SwingAngles s = swing.at(t);
    return model.inverseDynamics(s.q, s.qd, s.qdd);
  };
  const double turn = swing.q2.t_switch;
  EXPECT_GT(torque(turn - 1e-6)[1], 5);
  EXPECT_LT(torque(turn + 1e-6)[1], -5);
  EXPECT_GT(torque(swing.q1.start() + 1e-6)[0], 5) << "at once";
  for (int i = 0; i <= 1000; ++i) {
    const double t = swing.start() + (swing.end() - swing.start()) * i / 1000;
    EXPECT_LT(std::abs(torque(t)[2]), limits.tau_max[2] / 3) << t;
  }
}

TEST(SwingSpeeds, AreThoseFromWhichTheArmsWereMade) {
  const model::Arm arm = loadedArm();
  std::mt19937 random(2);
  std::uniform_real_distribution<> unit(-1, 1);
  for (int i = 0; i < 50; ++i) {
    model::SwingAngles swing;
    swing.q << unit(random), 0.8 + 0.5 * unit(random), 1.5 * unit(random);
    swing.qd << 3 * unit(random), 4 * unit(random), 8 * unit(random);
    const model::WamMotion wam = model::wamFromSwing(swing, 0.7, 1, 0);
    const Eigen::Vector3d found = swingSpeeds(arm, {wam.q, wam.qd, wam.qdd});
    EXPECT_LT((found - swing.qd).norm(), 1e-9);
  }
}

TEST(TorqueBudget, MoreTorqueAndAFreeShoulderAreNeverSlower) {
  const BudgetSettings settings{experiment().hand.p_HBall, 12, 0.3, 0.3, -0.9};
  const std::vector<double> shares{0.2, 0.5, 1};
  const auto held = fastestByBudget(loadedArm(), settings, Timing::kInPhaseHeld, shares, 5, 1),
             free = fastestByBudget(loadedArm(), settings, Timing::kInPhaseFree, shares, 5, 1),
             chain = fastestByBudget(loadedArm(), settings, Timing::kKineticChain, shares, 1, 1);
  for (std::size_t i = 0; i < shares.size(); ++i) {
    EXPECT_GT(held[i].release_speed, 3);
    EXPECT_GT(chain[i].release_speed, 3);
    // By the speed limits of the profile alone, whatever the torque.
    EXPECT_LT(held[i].release_speed, 6.2);
    EXPECT_LT(chain[i].release_speed, 6.2);
    EXPECT_LT(free[i].release_speed, 7.9);
    EXPECT_GT(free[i].release_speed, 0.97 * held[i].release_speed);
    if (i > 0) {
      EXPECT_GE(held[i].release_speed, held[i - 1].release_speed - 1e-6);
      EXPECT_GE(free[i].release_speed, free[i - 1].release_speed - 1e-6);
      EXPECT_GE(chain[i].release_speed, chain[i - 1].release_speed - 1e-6);
    }
  }
}

TEST(TorqueBudget, TheChainPaysWhereTorqueIsScarceAndNotWhereSpeedBinds) {
  const BudgetSettings settings{experiment().hand.p_HBall, 12, 0.3, 0.3, -0.9};
  const auto held = fastestByBudget(loadedArm(), settings, Timing::kInPhaseHeld, {0.2, 1}, 12, 1),
             chain = fastestByBudget(loadedArm(), settings, Timing::kKineticChain, {0.2, 1}, 12, 1);
  EXPECT_GT(chain[0].release_speed, 1.03 * held[0].release_speed);
  EXPECT_LT(chain[1].release_speed, held[1].release_speed);
  EXPECT_GT(chain[1].release_speed, 0.95 * held[1].release_speed);
}

/// Largest distance [m] of the end effector from its planned place.
double largestError(const TrackedThrow& tracked) {
  const model::Arm arm = loadedArm();
  double largest = 0;
  for (const arm_state_t& state : tracked.states) {
    const Eigen::Vector4d planned = tracked.planned.at(tracked.time(state)).q;
    largest =
        std::max(largest, (arm.p_WPoint(Eigen::Map<const Eigen::Vector4d>(state.q), {0, 0, 0.15}) -
                           arm.p_WPoint(planned, {0, 0, 0.15}))
                              .norm());
  }
  return largest;
}

TEST(TrackedThrow, IsNearerToThePlanWithFeedForward) {
  const TrackedThrow pd = trackedThrow(kExperiment, "gravity_pd"),
                     forward = trackedThrow(kExperiment, "feed_forward");
  EXPECT_EQ(pd.plan.t_release, forward.plan.t_release);
  EXPECT_GT(pd.time(pd.states.back()), pd.plan.t_swing_end);
  for (std::size_t k = 1; k < pd.states.size(); ++k)
    EXPECT_EQ(pd.states[k].tick, pd.states[k - 1].tick + 1);
  EXPECT_LT(largestError(pd), 0.03);
  EXPECT_LT(largestError(forward), largestError(pd) / 2);
}

TEST(Table, LeavesOutWhatIsNoNumber) {
  const config::TemporaryFolder folder;
  writeCsv({{"a (s)", "b"}, {{1, kNoNumber}, {2.5, -3}}}, folder.path().string() + "/t.csv");
  std::ifstream file(folder.path().string() + "/t.csv");
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  EXPECT_EQ(text, "a (s),b\n1,\n2.5,-3\n");
  EXPECT_THROW(writeCsv({}, "/nonexistent/t.csv"), std::runtime_error);
}

/// `fastball figures` with these words.
void figures(std::vector<std::string> words) {
  CLI::App app;
  int exit_status = -1;
  addFiguresCommand(app, exit_status);
  words.insert(words.begin(), "figures");
  std::reverse(words.begin(), words.end());
  app.parse(words);
  EXPECT_EQ(exit_status, 0);
}

std::string contents(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

TEST(FiguresCommand, WritesPicturesNumbersAndCaptions) {
  const config::TemporaryFolder folder;
  // A quote in the name is for gnuplot to bear.
  const std::string output = folder.path().string() + "/it's new";
  figures({"-o", output, "--config", kExperiment, "--only", "fig04"});
  EXPECT_EQ(contents(output + "/fig04.png").substr(1, 3), "PNG");
  EXPECT_THAT(contents(output + "/fig04.svg"), HasSubstr("</svg>"));
  EXPECT_THAT(contents(output + "/fig04-fits.csv"), HasSubstr("omega (rad/s)"));
  EXPECT_THAT(contents(output + "/fig04.txt"), HasSubstr("follows dq1 and not dq3"));
  EXPECT_THAT(contents(output + "/README.md"), HasSubstr(contents(output + "/fig04.txt")));
  EXPECT_THAT(contents(output + "/README.md"), HasSubstr("(fig04-sweep.csv)"));
}

std::string refusal(const std::vector<std::string>& words) {
  try {
    figures(words);
  } catch (const std::invalid_argument& e) {
    return e.what();
  }
  return "not refused";
}

TEST(FiguresCommand, RefusesWhatItCannotWriteOrDoesNotKnow) {
  const config::TemporaryFolder folder;
  const std::string file = folder.path().string() + "/file";
  std::ofstream(file) << "x";
  EXPECT_THAT(refusal({"-o", file, "--config", kExperiment}), HasSubstr("-o " + file));
  EXPECT_THAT(refusal({"-o", "/dev/null/a", "--config", kExperiment}), HasSubstr("/dev/null/a"));
  EXPECT_THAT(refusal({"-o", folder.path().string(), "--config", kExperiment, "--only", "fig99"}),
              HasSubstr("there are fig04, fig05"));
  EXPECT_THAT(refusal({"-o", folder.path().string(), "--config", kExperiment, "--only", "("}),
              HasSubstr("regular expression"));
  EXPECT_THAT(refusal({"-o", folder.path().string(), "--config", "/nonexistent.yaml"}),
              HasSubstr("/nonexistent.yaml"));
}

}  // namespace
}  // namespace fastball::launch
