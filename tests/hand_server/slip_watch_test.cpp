#include "hand_server/slip_watch.h"

#include <gtest/gtest.h>

namespace fastball::hand_server {
namespace {

TangentialForces carrying(double force) {
  return {Eigen::Vector2d(force / 3, 1), Eigen::Vector2d(force / 3, -2),
          Eigen::Vector2d(force / 3, 0)};
}

TEST(SlipWatch, SaysOnceThatTheBallGetsLessThanItTakes) {
  for (const double needed : {-2.0, 0.0, 2.0}) {
    SlipWatch watch;
    for (int k = 0; k < 100; ++k)
      EXPECT_FALSE(watch.step(needed, carrying(0.85 * needed)));
    int said = 0;
    for (int k = 0; k < 100; ++k) {
      if (const auto slip = watch.step(needed, carrying(needed - 0.6))) {
        ++said;
        EXPECT_EQ(k, 4) << "after five in a row";
        EXPECT_NEAR(slip->carried, needed - 0.6, 1e-12);
        EXPECT_EQ(slip->needed, needed);
      }
    }
    EXPECT_EQ(said, 1);
  }
}

TEST(SlipWatch, ASingleJoltIsNoSlip) {
  SlipWatch watch;
  for (int k = 0; k < 100; ++k)
    EXPECT_FALSE(watch.step(1.5, carrying(k % 5 == 0 ? 1.5 : 0)));
}

}  // namespace
}  // namespace fastball::hand_server
