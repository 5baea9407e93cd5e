// The detector on balls drawn by rays, with the true centre known.
#include "bench/ball_images.h"

#include <gtest/gtest.h>

#include <cmath>

namespace fastball::bench {
namespace {

struct Kind {
  double radius, contrast, lamp;
};

class BallImages : public ::testing::TestWithParam<Kind> {};

TEST_P(BallImages, CentreIsRightOnSideLitBalls) {
  BallImageOptions options;
  options.radius = GetParam().radius;
  options.contrast = GetParam().contrast;
  options.lamp = GetParam().lamp;
  constexpr int kBalls = 20;
  double along = 0, squares = 0;
  for (int seed = 500; seed < 500 + kBalls; ++seed) {
    const BallImageTrial trial = ballImageTrial(options, seed);
    ASSERT_TRUE(trial.found) << "seed " << seed;
    along += trial.error.dot(trial.light) / kBalls;
    squares += trial.error.squaredNorm() / (2 * kBalls);
  }
  EXPECT_LT(std::abs(along), 0.05);
  EXPECT_LT(std::sqrt(squares), 0.10);
}

INSTANTIATE_TEST_SUITE_P(
    Kinds,
    BallImages,
    ::testing::Values(Kind{6, 20, 100}, Kind{8, 20, 100}, Kind{8, 50, 30}, Kind{15, 20, 60}));

}  // namespace
}  // namespace fastball::bench
