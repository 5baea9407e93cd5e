// When the hand lets go: by what it has learned of its delay, and by the dead times of its fingers.
#include "hand_server/release_timing.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <vector>

#include "tests/hand_server/hand_throw.h"

namespace fastball::hand_server {
namespace {

/// Throws of plans that expect the ball to leave 10 ms after the command; it leaves some 5 ms later.
class LearningHand : public HandThrow {
 protected:
  /// @return [us], when the command came, from the start of the plan.
  int64_t throwLate(int64_t number, bool adapts, double window = 0) {
    HandPlan plan = throwPlan(number, window);
    plan.adapts = adapts;
    scene_ = number;
    tick_ = 0;
    utime_ = kSceneUs * number;
    force_ = {2, 4, 2};
    events_.clear();
    EXPECT_TRUE(controller_.offerPlan(plan));
    EXPECT_TRUE(controller_.startThrow({number, number, utime_ + 600'000}));
    while (events_.empty() && tick_ < 2000)
      tick();
    run(15);
    force_ = {0, 0, 0};
    run(20);
    EXPECT_EQ(events_.size(), 2u);
    return events_[0].utime - kSceneUs * number - 600'000;
  }
};

TEST_F(LearningHand, PredictsTheDelayItHasFelt) {
  int64_t off = 0;
  for (int number = 1; number <= 10; ++number) {
    throwLate(number, false);
    EXPECT_EQ(events_[0].predicted_utime, events_[1].predicted_utime);
    off = events_[1].utime - events_[1].predicted_utime;
    EXPECT_TRUE(number > 1 || off > 3000) << off;
  }
  EXPECT_LT(std::abs(off), 700);
}

TEST_F(LearningHand, CommandsEarlierOnlyForAPlanThatAdaptsAndHasNoWindow) {
  const int64_t first = throwLate(1, true);
  EXPECT_NEAR(static_cast<double>(first), 500e3, 1e3)
      << "but for the tick by which the hand is late";
  const int64_t off = events_[1].utime - events_[1].planned_utime;
  EXPECT_GT(off, 3000);
  EXPECT_EQ(throwLate(2, false), 500'000);
  const int64_t command = throwLate(3, true);
  EXPECT_NEAR(static_cast<double>(command), 500e3 - 2.0 / 3.0 * static_cast<double>(off), 1e3);
  EXPECT_LT(events_[1].utime, events_[1].planned_utime + 2 * off / 3);
  EXPECT_EQ(throwLate(4, true, 0.04), 500'000) << "in a window the moment does not matter";
}

TEST_F(LearningHand, ShiftsNoCommandByMoreThanTheLimit) {
  config_.command_shift_max = 0.001;
  controller_ = HandController(testArm(), testHand(), experiment().ball, config_);
  for (int number = 1; number <= 5; ++number)
    throwLate(number, true);
  EXPECT_EQ(throwLate(6, true), 499'000);
}

/// Fingers that obey some ticks late.
class LateHand : public HandThrow {
 protected:
  void throwWith(const std::array<int, model::kFingers>& late, bool adapts, double window) {
    late_ = late;
    HandPlan plan = throwPlan(1, window);
    plan.adapts = adapts;
    ASSERT_TRUE(controller_.offerPlan(plan));
    ASSERT_TRUE(controller_.startThrow({1, 1, kStartUs}));
    run(1200);
    ASSERT_FALSE(events_.empty());
  }
  void obey(const HandAnswer& answer) override {
    told_.push_back(answer);
    HandAnswer arrived = answer;
    for (const model::Finger finger : {model::kFingerA, model::kThumb, model::kFingerB}) {
      const int newest = static_cast<int>(told_.size()) - 1;
      const HandAnswer& old = told_[static_cast<std::size_t>(std::max(0, newest - late_[finger]))];
      const auto [first, joints] = model::Hand::jointsOf(finger);
      arrived.q.segment(first, joints) = old.q.segment(first, joints);
      arrived.qd.segment(first, joints) = old.qd.segment(first, joints);
      arrived.tau.segment(first, joints) = old.tau.segment(first, joints);
      arrived.kp.segment(first, joints) = old.kp.segment(first, joints);
      if (utime_ >= kStartUs + 400'000 &&
          arrived.tau[first + joints - 2] < told_[1000].tau[first + joints - 2])
        began_.emplace(finger, utime_ - kStartUs);
    }
    hand_.tick(arrived);
  }

  std::array<int, model::kFingers> late_{};
  std::vector<HandAnswer> told_;
  std::map<model::Finger, int64_t> began_;  ///< [us], when a finger began to let go
};

TEST_F(LateHand, LetsGoWithAllFingersWhenThePlanSays) {
  throwWith({4, 9, 0}, true, 0.04);
  EXPECT_NEAR(static_cast<double>(events_[0].utime - kStartUs), 491e3, 1e3);
  ASSERT_TRUE(events_[0].dead_times);
  const double last = (*events_[0].dead_times)[model::kThumb];
  EXPECT_NEAR(last, 0.009, 0.5e-3);
  EXPECT_NEAR(static_cast<double>(events_[0].predicted_utime - events_[0].utime), 10e3 + 1e6 * last,
              1);
  ASSERT_EQ(began_.size(), 3u);
  for (const auto& [finger, begin] : began_)
    EXPECT_NEAR(static_cast<double>(begin), 500e3, 1.1e3) << finger;
}

TEST_F(LateHand, OpensTheThumbWhenThePlanSaysWhereThereIsNoWindow) {
  throwWith({4, 9, 0}, true, 0);
  EXPECT_NEAR(static_cast<double>(began_.at(model::kThumb)), 500e3, 1.1e3);
}

TEST_F(LateHand, FeelsNothingForAPlanThatDoesNotAdapt) {
  throwWith({4, 9, 0}, false, 0.04);
  EXPECT_EQ(events_[0].utime, kStartUs + 500'000);
  EXPECT_FALSE(events_[0].dead_times);
  EXPECT_NEAR(static_cast<double>(began_.at(model::kThumb)), 509e3, 1.1e3);
}

}  // namespace
}  // namespace fastball::hand_server
