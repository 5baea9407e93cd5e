// Hand and ball around the release, drawn from what a run says, against what its simulator knows.
#include "launch/release_sequence.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <functional>
#include <iterator>
#include <map>
#include <random>
#include <sstream>

#include "launch/figures/recorded_throw.h"
#include "launch/release_drawing.h"
#include "launch/release_outline.h"
#include "tests/config/temporary_folder.h"

namespace fastball::launch {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using testing::Each;
using testing::HasSubstr;
using testing::Lt;

const std::string kExperiment = FASTBALL_SOURCE_DIR "/config/experiment.yaml";

const config::Experiment& experiment() {
  static const config::Experiment loaded = config::loadExperiment(kExperiment);
  return loaded;
}

/// A throw with what nobody but the judge hears.
struct JudgedRecord {
  ThrowRecord record;
  std::vector<sim_truth_t> truth;
};

const JudgedRecord& throwBy(const std::string& strategy) {
  static std::map<std::string, JudgedRecord> throws;
  const auto [place, is_new] = throws.try_emplace(strategy);
  JudgedRecord& judged = place->second;
  if (is_new) {
    judged.record = recordedThrow(kExperiment, strategy, [&](messaging::Endpoint& endpoint) {
      endpoint.subscribe<sim_truth_t>(messaging::kSimTruth,
                                      [&](const auto& m) { judged.truth.push_back(m); });
    });
  }
  return judged;
}

ReleaseSequence sequenceOf(const std::string& strategy) {
  return releaseSequence(throwBy(strategy).record, experiment());
}

class ReleaseSequenceTest : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(By,
                         ReleaseSequenceTest,
                         testing::Values("paper", "robust"),
                         [](const auto& test) { return test.param; });

TEST_P(ReleaseSequenceTest, TheBallIsWhereTheSimulatorHasIt) {
  const JudgedRecord& judged = throwBy(GetParam());
  const ReleaseSequence sequence = sequenceOf(GetParam());
  int compared = 0;
  for (const sim_truth_t& m : judged.truth) {
    const double t = 1e-6 * static_cast<double>(m.utime - judged.record.departed->utime);
    if (m.event != sim_truth_t::SAMPLE || t < sequence.t_swing || t > sequence.t_landing)
      continue;
    const Vector3d p(m.p_WBall);
    EXPECT_LT((sequence.at(t).p_WBall - p).norm(), 1e-3) << t;
    ++compared;
  }
  EXPECT_GT(compared, 50);
}

TEST_P(ReleaseSequenceTest, FingersTouchTheBallWhereTheyFeelIt) {
  const ThrowRecord& record = throwBy(GetParam()).record;
  const ReleaseSequence sequence = sequenceOf(GetParam());
  for (const hand_state_t& state : record.hand) {
    const double t = 1e-6 * static_cast<double>(state.utime - record.departed->utime);
    if (t < sequence.t_swing || t > 0.15)
      continue;
    const HandAndBall& tick = sequence.at(t);
    if (t <= sequence.t_command) {
      EXPECT_THAT(state.f_normal, Each(testing::Gt(0))) << t;
      EXPECT_THAT(tick.gap, Each(Lt(-0.5e-3))) << t;
      EXPECT_NEAR(tick.palm_gap, 0.012, 1e-9) << "as the hand's configuration has it";
    } else if (t > 0.01) {
      EXPECT_THAT(state.f_normal, Each(Lt(0.05))) << t << ": no more than the noise of the sensors";
      EXPECT_THAT(tick.gap, Each(testing::Gt(0.5e-3))) << t;
    }
  }
  EXPECT_GT(smallestGap(sequence, 0.01, 0.15), 0.5e-3);
  EXPECT_LT(smallestGap(sequence, -0.1, 0.15), -1e-3);
}

TEST_P(ReleaseSequenceTest, TheHandHoldsTheBallUntilItLeaves) {
  const ReleaseSequence sequence = sequenceOf(GetParam());
  const Vector3d& p_HBall = experiment().hand.p_HBall;
  EXPECT_LT(sequence.t_command, 0);
  EXPECT_LT(sequence.step_H.norm(), 2e-3);
  EXPECT_LT(openingAt(sequence, -0.002, p_HBall).way_out, 1e-12);
  const Opening early = openingAt(sequence, 0.02, p_HBall),
                late = openingAt(sequence, 0.04, p_HBall);
  EXPECT_GT(early.way_out, 0.004);
  EXPECT_GT(late.way_out, 2 * early.way_out);
  EXPECT_GT(late.gap, early.gap);
}

TEST(ReleaseSequence, ThePapersHandOpensItsThumbAndKeepsTheOtherTwo) {
  const ReleaseSequence sequence = sequenceOf("paper");
  // They open too once the ball is felt to have left, some 6 ms after it has.
  const Opening opening = openingAt(sequence, 0.01, experiment().hand.p_HBall);
  EXPECT_LT(opening.closed[model::kThumb], -0.25);
  EXPECT_LT(std::abs(opening.closed[model::kFingerA]), 0.05);
  EXPECT_LT(std::abs(opening.closed[model::kFingerB]), 0.05);
  EXPECT_NE(opening.nearest, model::kThumb);
}

TEST(ReleaseSequence, SaysWhichMessageIsMissing) {
  const auto refusal = [](const std::function<void(ThrowRecord&)>& spoil) {
    ThrowRecord record = throwBy("paper").record;
    spoil(record);
    try {
      releaseSequence(record, experiment());
    } catch (const std::runtime_error& e) {
      return std::string(e.what());
    }
    return std::string("not refused");
  };
  EXPECT_THAT(refusal([](ThrowRecord& r) { r.plan.reset(); }), HasSubstr("SWING_PLAN"));
  EXPECT_THAT(refusal([](ThrowRecord& r) { r.commanded.reset(); }), HasSubstr("command"));
  EXPECT_THAT(refusal([](ThrowRecord& r) { r.departed.reset(); }), HasSubstr("departure"));
  EXPECT_THAT(refusal([](ThrowRecord& r) { r.hand.clear(); }), HasSubstr("HAND_STATE"));
  EXPECT_THAT(refusal([](ThrowRecord& r) { r.track.clear(); }), HasSubstr("BALL_TRACK"));
  EXPECT_THAT(refusal([](ThrowRecord& r) {
                for (hand_state_t& state : r.hand)
                  state.tick += 1'000'000;
              }),
              HasSubstr("no tick with both"));
}

TEST(ReleaseSequence, LeavesOutTicksOfWhichOneHalfWasLost) {
  ThrowRecord record = throwBy("paper").record;
  const std::size_t all = releaseSequence(record, experiment()).ticks.size();
  record.hand.erase(record.hand.begin() + 100, record.hand.begin() + 110);
  record.arm.erase(record.arm.begin() + 500);
  EXPECT_EQ(releaseSequence(record, experiment()).ticks.size(), all - 11);
}

TEST(ThrowPlane, ShowsTheThrowToTheRightAndTheElbowUp) {
  std::mt19937 random(3);
  std::normal_distribution<> normal;
  const auto vector = [&] { return Vector3d(normal(random), normal(random), normal(random)); };
  for (int i = 0; i < 50; ++i) {
    const Vector3d v = vector(), p = vector();
    Eigen::Isometry3d X_WH = Eigen::Isometry3d::Identity();
    X_WH.linear() = Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitZ(), vector()).matrix();
    const ThrowPlane plane(v, X_WH);
    EXPECT_NEAR(plane.at({v.x(), v.y(), 0}).x(), std::hypot(v.x(), v.y()), 1e-12);
    EXPECT_LT(plane.at(X_WH.linear().col(2)).y(), 0);
    EXPECT_NEAR(plane.behind(X_WH.linear().col(2)), 0, 1e-12);
    EXPECT_NEAR(Vector3d(plane.at(p).x(), plane.at(p).y(), plane.behind(p)).norm(), p.norm(),
                1e-12);
  }
  const ThrowPlane upward({0, 0, 3}, Eigen::Isometry3d::Identity());
  EXPECT_NEAR(upward.at({2, 0, 0}).norm(), 2, 1e-12);
}

TEST(Outlines, LieOneRadiusFromTheAxis) {
  const Vector2d a(0.1, -0.2), b(0.13, 0.05);
  for (const auto& [start, end] : {std::pair(a, b), {b, a}, {a, a}}) {
    const Outline outline = capsuleOutline(start, end, 0.01);
    EXPECT_LT((outline.front() - outline.back()).norm(), 1e-12);
    const Vector2d along = end - start;
    for (const Vector2d& p : outline) {
      const double share =
          along.norm() > 0 ? std::clamp((p - start).dot(along) / along.squaredNorm(), 0.0, 1.0) : 0;
      EXPECT_NEAR((p - start - share * along).norm(), 0.01, 1e-12);
    }
  }
}

TEST(Outlines, ThePalmIsSeenAsABoxFromTheSide) {
  const model::HandParameters& hand = experiment().hand;
  const auto extent = [&](const Eigen::Isometry3d& X_WH) {
    Vector2d low(1, 1), high(-1, -1);
    for (const Vector2d& p : palmOutline(ThrowPlane({1, 0, 0}, X_WH), X_WH, hand)) {
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
    return Vector2d(high - low);
  };
  Eigen::Isometry3d X_WH = Eigen::Isometry3d::Identity();
  EXPECT_LT((extent(X_WH) - Vector2d(2 * hand.palm_radius, hand.palm_distance)).norm(), 1e-9);
  X_WH.linear() = Eigen::AngleAxisd(M_PI / 2, Vector3d::UnitY()).matrix();  // along the throw
  EXPECT_LT((extent(X_WH) - Vector2d(hand.palm_distance, 2 * hand.palm_radius)).norm(), 1e-9);
}

std::string contents(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

TEST(DrawRelease, WritesPicturesTheirNumbersAndACaption) {
  const config::TemporaryFolder folder;
  const std::string stem = folder.path().string() + "/release-1";
  const std::string caption =
      drawRelease(throwBy("paper").record, experiment(), "it's a throw", stem);
  EXPECT_EQ(contents(stem + ".png").substr(1, 3), "PNG");
  EXPECT_THAT(contents(stem + ".svg"), HasSubstr("it's a throw"));

  std::istringstream csv(contents(stem + ".csv"));
  std::string line;
  std::getline(csv, line);
  EXPECT_THAT(line, HasSubstr("thumb from ball (mm)"));
  std::vector<double> times;
  while (std::getline(csv, line))
    times.push_back(std::round(std::stod(line)));
  EXPECT_TRUE(std::is_sorted(times.begin(), times.end()));
  for (int ms = -20; ms <= 58; ms += 2)
    EXPECT_THAT(times, testing::Contains(ms));
  for (int ms = -300; ms <= 400; ms += 100)
    EXPECT_THAT(times, testing::Contains(ms));

  const ReleaseSequence sequence = sequenceOf("paper");
  const Opening opening = openingAt(sequence, 0.02, experiment().hand.p_HBall);
  EXPECT_THAT(caption, HasSubstr(fmt::format("{:.1f} ms before the ball leaves it at {:.2f} m/s",
                                             -1e3 * sequence.t_command, sequence.v_WBall.norm())));
  EXPECT_THAT(caption, HasSubstr(fmt::format("{:.1f} mm out of the hand", 1e3 * opening.way_out)));
}

}  // namespace
}  // namespace fastball::launch
