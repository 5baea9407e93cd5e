// Rate, bandwidth and jitter of messages, from the times at which they came.
#include "launch/spy/arrival_window.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <vector>

namespace fastball::launch {
namespace {

constexpr int64_t kStart = 1'700'000'000'000'000;

TEST(Arrivals, OfAClockHaveItsRateAndNoJitter) {
  for (const int64_t period : {100, 1'000, 16'667, 1'000'000}) {
    ArrivalWindow window;
    int64_t now = kStart;
    for (int i = 0; i < 4'000'000 / period; ++i)
      window.take(now += period, 136);
    EXPECT_NEAR(window.rate(now) * 1e-6 * static_cast<double>(period), 1, 1e-12) << period;
    EXPECT_NEAR(window.bandwidth(now) / window.rate(now), 136, 1e-9) << period;
    EXPECT_NEAR(window.jitter(now).value(), 0, 1e-9) << period;
  }
}

TEST(Arrivals, JitterIsTheStandardDeviationOfTheGaps) {
  std::mt19937 random(3);
  std::uniform_int_distribution<int64_t> gap_us(0, 3000);
  ArrivalWindow window;
  int64_t now = kStart;
  window.take(now, 1);
  std::vector<double> gaps;
  for (int i = 0; i < 1000; ++i) {
    const int64_t gap = gap_us(random);
    window.take(now += gap, 1);
    gaps.push_back(1e-6 * static_cast<double>(gap));
  }
  const double n = static_cast<double>(gaps.size());
  const double mean = std::accumulate(gaps.begin(), gaps.end(), 0.0) / n;
  double squares = 0;
  for (const double gap : gaps)
    squares += (gap - mean) * (gap - mean);
  EXPECT_NEAR(window.jitter(now).value(), std::sqrt(squares / (n - 1)), 1e-9);
  EXPECT_NEAR(window.rate(now), 1 / mean, 1e-6);
}

TEST(Arrivals, OfLongAgoDoNotCount) {
  ArrivalWindow window;
  int64_t now = kStart;
  for (int i = 0; i < 1000; ++i)
    window.take(now += 10'000, 1);
  for (int i = 0; i < 3000; ++i)
    window.take(now += 1'000, 1);
  EXPECT_NEAR(window.rate(now), 1000, 1e-6);
  EXPECT_NEAR(window.jitter(now).value(), 0, 1e-9);
}

TEST(Arrivals, RateFallsAfterTheLastAndEndsWithTheWindow) {
  ArrivalWindow window;
  int64_t now = kStart;
  for (int i = 0; i < 1000; ++i)
    window.take(now += 1'000, 1);
  EXPECT_LT(window.rate(now + 500'000), 700);
  EXPECT_GT(window.rate(now + 500'000), 600);
  EXPECT_EQ(window.rate(now + 3'000'000), 0);
  EXPECT_EQ(window.bandwidth(now + 3'000'000), 0);
  EXPECT_FALSE(window.jitter(now + 3'000'000));
}

TEST(Arrivals, SlowerThanTheWindowHaveARateToo) {
  ArrivalWindow window;
  window.take(kStart, 1);
  EXPECT_EQ(window.rate(kStart), 0);
  window.take(kStart + 5'000'000, 10);
  for (const int64_t later : {0, 2'500'000, 4'900'000}) {
    EXPECT_NEAR(window.rate(kStart + 5'000'000 + later), 0.2, 1e-12) << later;
    EXPECT_NEAR(window.bandwidth(kStart + 5'000'000 + later), 2, 1e-12) << later;
  }
  EXPECT_EQ(window.rate(kStart + 16'000'000), 0);
}

TEST(Arrivals, AnyTimesGiveFiniteNumbers) {
  std::mt19937 random(4);
  ArrivalWindow window;
  int64_t now = kStart;
  for (int i = 0; i < 20'000; ++i) {
    const std::vector<int64_t> steps{0, 1, -5, 1000, -1'000'000, 100'000'000, -kStart / 3};
    now = std::max<int64_t>(now + steps[random() % steps.size()], 0);
    window.take(now, random() % 65'536);
    for (const int64_t at : {now - 10, now, now + 1'000'000}) {
      EXPECT_TRUE(std::isfinite(window.rate(at)) && window.rate(at) >= 0);
      EXPECT_TRUE(std::isfinite(window.bandwidth(at)));
      EXPECT_TRUE(std::isfinite(window.jitter(at).value_or(0)));
    }
  }
}

}  // namespace
}  // namespace fastball::launch
