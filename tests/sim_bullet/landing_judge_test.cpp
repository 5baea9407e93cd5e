#include "sim_bullet/landing_judge.h"

#include <gtest/gtest.h>

#include "tests/sim_bullet/test_scene.h"

namespace fastball::sim_bullet {
namespace {

/// A ball that floats at 1 m/s in front of the target: what touches it is the test's business.
class Judge : public testing::Test {
 protected:
  void steps(int n, bool held, const std::array<bool, 4>& touches) {
    for (int i = 0; i < n; ++i) {
      JudgedStep step;
      step.dt = 1e-4;
      step.time = ++count_ * step.dt;
      step.before = {{(count_ - 1) * 1e-4, 0, 0}, {1, 0, 0}};
      step.after = {{count_ * 1e-4, 0, 0}, {1, 0, 0}};
      step.held = held;
      step.hand_touches = touches;
      judge_.step(step, &events_);
    }
  }

  LandingJudge judge_{experiment().target, 0, 9.81};
  std::vector<SceneEvent> events_;
  int count_ = 0;
};

constexpr std::array<bool, 4> kNone{};
constexpr std::array<bool, 4> kFingerB{false, false, true, false};
constexpr std::array<bool, 4> kPalm{false, false, false, true};

TEST_F(Judge, ReleaseIsTheLastTouchBeforeThreeFreeMilliseconds) {
  steps(50, true, kNone);
  steps(50, false, kFingerB);
  steps(20, false, kNone);  // 2 ms: chatter
  steps(1, false, kFingerB);
  steps(29, false, kNone);
  EXPECT_TRUE(events_.empty());
  steps(2, false, kNone);
  ASSERT_EQ(events_.size(), 1u);
  EXPECT_EQ(events_[0].kind, SceneEvent::Kind::kReleased);
  EXPECT_NEAR(events_[0].time, 0.0121, 1e-9);
  EXPECT_NEAR(events_[0].ball.p_WBall.x(), 0.0121, 1e-9);
  EXPECT_TRUE(judge_.released());
}

TEST_F(Judge, TouchesAfterTheReleaseAreNamedOnceAnEpisode) {
  steps(10, false, kFingerB);
  steps(40, false, kNone);
  steps(5, false, kPalm);
  steps(10, false, kNone);
  steps(5, false, kPalm);
  steps(40, false, kNone);
  steps(5, false, kFingerB);
  ASSERT_EQ(events_.size(), 3u);
  EXPECT_EQ(events_[1].kind, SceneEvent::Kind::kTouched);
  EXPECT_STREQ(events_[1].note, "palm");
  EXPECT_NEAR(events_[1].time, 0.0051, 1e-9);
  EXPECT_STREQ(events_[2].note, "finger B");
}

TEST_F(Judge, ABallThatNothingHoldsIsReleasedAtTheBeginning) {
  steps(40, false, kNone);
  ASSERT_EQ(events_.size(), 1u);
  EXPECT_EQ(events_[0].time, 0);
  EXPECT_EQ(events_[0].ball.v_WBall.x(), 1);
}

TEST_F(Judge, ABallInTheFeederIsNotReleased) {
  steps(1000, true, kNone);
  EXPECT_TRUE(events_.empty());
}

}  // namespace
}  // namespace fastball::sim_bullet
