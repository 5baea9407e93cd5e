#include "messaging/clock_survey.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "messaging/heartbeat.h"
#include "messaging/local_network.h"

namespace fastball::messaging {
namespace {

/// Another machine's clock.
class OtherClock : public Clock {
 public:
  explicit OtherClock(const ManualClock& ours) : ours_(ours) {}
  int64_t monotonicUs() const override { return ours_.monotonicUs(); }
  int64_t wallUs() const override { return ours_.wallUs() + offset_us; }
  int64_t offset_us = 0;

 private:
  const ManualClock& ours_;
};

/// Two machines that can only talk about the time.
struct TwoMachines {
  TwoMachines() { clock.advanceUs(1'000'000'000); }
  /// One question and its answer, so long under way.
  void round(int64_t there_us, int64_t back_us) {
    survey.ask();
    clock.advanceUs(there_us);
    there.drain();
    clock.advanceUs(back_us);
    here.drain();
  }
  HostClock measured() const { return survey.clocks().at(hostName()); }

  ManualClock clock;
  OtherClock other{clock};
  LocalNetwork network{clock};
  Endpoint& here = network.addEndpoint();
  Endpoint& there = network.addEndpoint();
  ClockAnswer answer{there, other, "vision_tracker"};
  ClockSurvey survey{here, clock};
};

TEST(ClockSurveyTest, EqualDelaysGiveTheOffsetExactly) {
  for (const int64_t offset :
       {int64_t{0}, int64_t{1}, int64_t{-250'000}, int64_t{86'400'000'000}}) {
    TwoMachines machines;
    machines.other.offset_us = offset;
    machines.round(400, 400);
    EXPECT_DOUBLE_EQ(machines.measured().offset, static_cast<double>(offset) * 1e-6);
    EXPECT_DOUBLE_EQ(machines.measured().error, 400e-6);
  }
}

TEST(ClockSurveyTest, WhateverTheDelaysTheOffsetIsRightToItsError) {
  std::mt19937 random(3);
  std::uniform_int_distribution<int64_t> offset(-500'000'000, 500'000'000), delay(0, 100'000);
  for (int i = 0; i < 200; ++i) {
    TwoMachines machines;
    machines.other.offset_us = offset(random);
    for (int k = 0; k < 4; ++k)
      machines.round(delay(random), delay(random));
    EXPECT_EQ(machines.measured().answers, 4);
    EXPECT_LE(
        std::abs(machines.measured().offset - static_cast<double>(machines.other.offset_us) * 1e-6),
        machines.measured().error + 1e-9);
  }
}

TEST(ClockSurveyTest, TheShortestRoundTripCounts) {
  TwoMachines machines;
  machines.other.offset_us = 7000;
  machines.round(50'000, 100);
  EXPECT_NEAR(machines.measured().offset, 0.007 + 0.02495, 1e-9);
  machines.round(200, 200);
  EXPECT_DOUBLE_EQ(machines.measured().offset, 0.007);
  machines.round(100, 90'000);
  EXPECT_DOUBLE_EQ(machines.measured().offset, 0.007);
  EXPECT_DOUBLE_EQ(machines.measured().error, 200e-6);
}

TEST(ClockSurveyTest, AnswersToSomebodyElseAreNotTaken) {
  TwoMachines machines;
  clock_probe_t stray{};
  stray.name = "planner";
  stray.host = "vision";
  stray.asker_host = "elsewhere";
  stray.asker_pid = 1;
  stray.utime = stray.asked_utime = stray.heard_utime = 5;
  ASSERT_TRUE(machines.there.publish(kClock, stray));
  machines.here.drain();
  EXPECT_TRUE(machines.survey.clocks().empty());
}

}  // namespace
}  // namespace fastball::messaging
