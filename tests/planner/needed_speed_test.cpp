#include "planner/needed_speed.h"

#include <gtest/gtest.h>

#include <cmath>

namespace fastball::planner {
namespace {

model::Target targetAt(double x, double z) {
  return {{x, 0, z}, -Eigen::Vector3d::UnitX(), 0.1};
}

TEST(NeededSpeed, IsThatOfTheParabolaOfLeastEnergyWithoutDrag) {
  // v^2 = g (h + sqrt(h^2 + d^2)) from the origin; the search looks at elevations 5 degrees apart.
  for (const double d : {1.0, 3.0, 8.0}) {
    for (const double h : {-1.0, 0.0, 1.0}) {
      const double exact = std::sqrt(9.81 * (h + std::hypot(h, d)));
      const auto found = neededSpeed(targetAt(d, h), 0, 0, 9.81);
      ASSERT_TRUE(found);
      EXPECT_GE(*found, exact - 1e-3);
      EXPECT_LE(*found, 1.01 * exact + 5e-3);
    }
  }
}

TEST(NeededSpeed, GrowsWithDragAndFallsWithReach) {
  const double bare = *neededSpeed(targetAt(5, 0), 0, 0, 9.81);
  const double dragged = *neededSpeed(targetAt(5, 0), 0, 0.07, 9.81);
  EXPECT_GT(dragged, 1.1 * bare);
  EXPECT_LT(*neededSpeed(targetAt(5, 0), 1, 0.07, 9.81), dragged);
}

TEST(NeededSpeed, DoesNotExistFarAway) {
  EXPECT_FALSE(neededSpeed(targetAt(200, 0), 1, 0.07, 9.81));
}

}  // namespace
}  // namespace fastball::planner
