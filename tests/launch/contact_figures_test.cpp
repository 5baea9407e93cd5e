// The numbers behind the figures of sections 3 and 5.
#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "launch/figures/elastic_release.h"
#include "launch/figures/figure.h"
#include "launch/figures/planned_swing.h"
#include "launch/figures/printed_rolling.h"
#include "launch/figures/release_shift.h"
#include "launch/figures/rolling_range.h"
#include "tests/config/temporary_folder.h"

namespace fastball::launch {
namespace {

using Eigen::Vector3d;
using testing::HasSubstr;

const FigureTask& task() {
  static const FigureTask loaded = [] {
    FigureTask result;
    result.config = FASTBALL_SOURCE_DIR "/config/experiment.yaml";
    result.experiment = config::loadExperiment(result.config);
    return result;
  }();
  return loaded;
}

CircleSwing swing(double acceleration, double lean) {
  CircleSwing result;
  result.acceleration = acceleration;
  result.lean = lean;
  return result;
}

model::FingerPair groove() {
  const config::Experiment& e = task().experiment;
  model::FingerPair fingers = model::fingersBehind(e.hand, e.ball.radius);
  fingers.X_HF.setIdentity();
  return fingers;
}

TEST(FingersBehind, AreThoseOfTheGrasp) {
  const config::Experiment& e = task().experiment;
  const model::FingerPair fingers = model::fingersBehind(e.hand, e.ball.radius);
  EXPECT_LT((fingers.X_HF.linear().col(1) - Vector3d::UnitY()).norm(), 1e-9);
  EXPECT_NEAR(fingers.half_spacing, 0.03, 1e-9);
  const model::Hand hand(e.hand);
  const double touch = e.ball.radius + e.hand.finger_radius;
  const model::HandVector q = hand.posture(0, 0, {touch, touch, touch});
  const auto surfaces = fingers.surfaces(e.ball.radius);
  for (const model::Finger finger : {model::kFingerA, model::kFingerB}) {
    const Vector3d p = hand.phalanges(finger, q)[1].p_start;
    const Vector3d axis = surfaces[finger == model::kFingerA ? 0 : 1].p_H;
    EXPECT_LT((p - axis).head<2>().norm(), 1e-9);
  }
  model::HandParameters facing = e.hand;
  facing.azimuth[model::kFingerB] = facing.azimuth[model::kFingerA] + M_PI;
  EXPECT_THROW(model::fingersBehind(facing, e.ball.radius), std::invalid_argument);
}

TEST(CircleSwing, HasTheDerivativesOfItsMotionAndTheSamePathWhenFaster) {
  const CircleSwing s = swing(60, 0.4);
  constexpr double h = 1e-6;
  for (const double t : {0.0, 0.01, 0.05}) {
    const model::HandMotion now = s(t), before = s(t - h), after = s(t + h);
    const Vector3d v = (after.X_WH.translation() - before.X_WH.translation()) / (2 * h);
    EXPECT_LT((now.v_WH - v).norm(), 1e-7);
    EXPECT_LT((now.a_WH - (after.v_WH - before.v_WH) / (2 * h)).norm(), 1e-5);
    EXPECT_LT((now.dw_WH - (after.w_WH - before.w_WH) / (2 * h)).norm(), 1e-5);
    const Eigen::Matrix3d turning =
        (after.X_WH.linear() - before.X_WH.linear()) / (2 * h) * now.X_WH.linear().transpose();
    EXPECT_LT((now.w_WH - Vector3d(turning(2, 1), turning(0, 2), turning(1, 0))).norm(), 1e-7);
    const model::HandMotion fast = s.faster(3)(t / 3);
    EXPECT_LT((fast.X_WH.matrix() - now.X_WH.matrix()).norm(), 1e-12);
    EXPECT_LT((fast.v_WH - 3 * now.v_WH).norm(), 1e-12);
  }
}

TEST(RollingRange, GoesEitherWayOrNowhere) {
  const model::BallParameters& ball = task().experiment.ball;
  const auto outcome = [&](double acceleration, double lean) {
    return outcomeOf(model::rollOnFingers(ball, groove(), swing(acceleration, lean), {}));
  };
  EXPECT_EQ(outcome(50, 0).kind, RollKind::kForwards);
  EXPECT_GT(outcome(50, 0).distance, 0.01);
  EXPECT_EQ(outcome(100, 1.2).kind, RollKind::kBackwards);
  EXPECT_LT(outcome(100, 1.2).distance, -0.01);
  EXPECT_EQ(outcome(10, -0.7).kind, RollKind::kNone);
  EXPECT_EQ(outcome(10, -0.7).distance, 0);
}

// The paper: "the rolling distance cannot be dramatically increased".
TEST(RollingRange, DoesNotDependOnTheSpeedWithoutGravityAndDrag) {
  model::BallParameters ball = task().experiment.ball;
  ball.drag_coefficient = 0;
  model::RollingTask weightless;
  weightless.gravity = 0;
  weightless.t_end = 2;
  const double distance =
      outcomeOf(model::rollOnFingers(ball, groove(), swing(50, 0), weightless)).distance;
  for (const double factor : {0.1, 0.5, 3.0}) {
    const CircleSwing s = swing(50, 0).faster(factor);
    EXPECT_NEAR(outcomeOf(model::rollOnFingers(ball, groove(), s, weightless)).distance, distance,
                1e-6);
  }
}

TEST(PrintedRolling, IsRightOnAPlaneWhereTheHandTurnsEvenlyAndNothingSlips) {
  model::BallParameters ball = task().experiment.ball;
  ball.drag_coefficient = 0;
  ball.friction = 1e9;
  model::RollingTask short_task;
  short_task.t_end = 0.03;
  const CircleSwing even = swing(0, 0.5), hastened = swing(60, 0.5);
  const auto difference = [&](const CircleSwing& s) {
    return std::abs(rollAsPrinted(ball, {}, s, short_task).samples.back().p_FBall.x() -
                    model::rollOnFingers(ball, {}, s, short_task).samples.back().p_FBall.x());
  };
  EXPECT_LT(difference(even), 1e-9);
  EXPECT_GT(difference(hastened), 1e-4);
}

// Fig. 9 as a number.
TEST(ReleaseShift, IsTwoSeventhsWhereTheBallRollsAndAllOfItWhereTheGripThrowsItOff) {
  const PlannedRelease release =
      plannedRelease(task().experiment, planner::loadConfig(task().config), planPaperThrow(task()));
  const std::vector<double> early{-0.01, -0.005, -0.001}, late{0, 0.005, 0.01};
  const double free = landingShift(release, LetGo::kFreely, late).norm();
  EXPECT_GT(free, 15) << "mm/ms";
  const auto share = [&](LetGo how, const std::vector<double>& errors) {
    return landingShift(release, how, errors).norm() / free;
  };
  EXPECT_NEAR(share(LetGo::kLongerOnFingers, late), 2.0 / 7, 0.06);
  // The fingers end before the rolling has done all it could.
  EXPECT_LT(share(LetGo::kRolling, early), 0.7);
  EXPECT_GT(share(LetGo::kRolling, early), 0.35);
  EXPECT_LT(share(LetGo::kGently, early), 0.75);
  EXPECT_TRUE(rigidRoll(release, -0.005, false).rolled_off);
  EXPECT_GT(rigidRoll(release, -0.005, true).samples.back().p_FBall.x(), release.fingertip);
  EXPECT_GT(share(LetGo::kElastic, early), 0.9);
  for (const double error : {0.006, 0.01}) {
    EXPECT_LT(
        (landing(release, LetGo::kRolling, error) - landing(release, LetGo::kFreely, error)).norm(),
        1e-9);
  }
  EXPECT_THROW(landingShift(release, LetGo::kFreely, {0.001}), std::invalid_argument);
}

TEST(ElasticRelease, IsLaterAndFasterTheSofterTheBallAndNeverBeforeTheRigidOne) {
  for (const double rate : {450.0, 900.0}) {
    const Unloading situation = unloading(task().experiment.ball, rate);
    double later = rigidRelease(situation).t_release, faster = 0;
    for (const double modulus : {1e7, 1e6, 1e5, 3e4}) {
      const model::ElasticMotion motion = elasticRelease(situation, modulus);
      EXPECT_GT(motion.t_release, later) << modulus;
      EXPECT_GT(recovery(motion), faster) << modulus;
      later = motion.t_release;
      faster = recovery(motion);
    }
  }
  EXPECT_THROW(unloading(task().experiment.ball, 0), std::invalid_argument);
}

std::string contents(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

TEST(ContactFigures, ComeWithPicturesNumbersAndCaptions) {
  const config::TemporaryFolder folder;
  FigureTask here = task();
  here.folder = folder.path().string();
  writeFigures(here, std::regex("fig08|fig09|fig14_15"), [](const std::string&) {});
  for (const std::string name : {"fig08", "fig09", "fig14_15"}) {
    EXPECT_EQ(contents(here.folder + "/" + name + ".png").substr(1, 3), "PNG");
    EXPECT_THAT(contents(here.folder + "/" + name + ".svg"), HasSubstr("</svg>"));
  }
  EXPECT_THAT(contents(here.folder + "/fig08-map.csv"), HasSubstr("lean (degrees)"));
  EXPECT_THAT(contents(here.folder + "/fig09-shifts.csv"), HasSubstr("together (mm/ms)"));
  EXPECT_THAT(contents(here.folder + "/fig14_15-delays.csv"), HasSubstr("450 N/s"));
  EXPECT_THAT(contents(here.folder + "/fig08.txt"), HasSubstr("gone as soon as"));
  EXPECT_THAT(contents(here.folder + "/fig09.txt"), HasSubstr("nothing rolls"));
  EXPECT_THAT(contents(here.folder + "/fig14_15.txt"), HasSubstr("The softer the ball"));
}

}  // namespace
}  // namespace fastball::launch
