#include "vision_tracker/flight_path.h"

#include <gtest/gtest.h>

#include <Eigen/Core>

namespace fastball::vision_tracker {
namespace {

constexpr double kGravity = 9.81;

model::BallState stateOf(const Eigen::Matrix<double, 7, 1>& x) {
  return {x.head<3>(), x.segment<3>(3)};
}

TEST(FlightPath, FollowsTheModel) {
  const model::BallState start{{0.3, -0.2, 0.4}, {4.5, 0.3, 2.0}};
  FlightPath path(start, 0.07, kGravity);
  for (const double t : {0.004, 0.1, 0.5, 0.2, -0.05}) {
    path.moveTo(t);
    const model::BallState truth = model::fly(start, t, 0.07, kGravity);
    EXPECT_LT((path.state().p_WBall - truth.p_WBall).norm(), 1e-9) << t;
    EXPECT_LT((path.state().v_WBall - truth.v_WBall).norm(), 1e-8) << t;
  }
}

TEST(FlightPath, SensitivityMatchesFiniteDifferences) {
  for (const double speed : {0.0, 1e-6, 1.0, 8.0}) {
    for (const double drag : {0.0, 0.07, 1.0}) {
      for (const double t : {0.003, 0.3, 0.7, -0.1}) {
        Eigen::Matrix<double, 7, 1> x;
        x << 0.3, -0.2, 0.4, speed * Eigen::Vector3d(0.9, 0.1, 0.4), drag;
        FlightPath path(stateOf(x), drag, kGravity);
        path.moveTo(t);
        for (int i = 0; i < 7; ++i) {
          const Eigen::Matrix<double, 7, 1> h = 1e-5 * Eigen::Matrix<double, 7, 1>::Unit(i);
          const auto low = model::fly(stateOf(x - h), t, drag - h[6], kGravity);
          const auto high = model::fly(stateOf(x + h), t, drag + h[6], kGravity);
          Eigen::Matrix<double, 6, 1> slope;
          slope << (high.p_WBall - low.p_WBall) / 2e-5, (high.v_WBall - low.v_WBall) / 2e-5;
          EXPECT_LT((slope - path.sensitivity().col(i)).norm(), 1e-6 * (1 + slope.norm()))
              << "parameter " << i << " speed " << speed << " drag " << drag << " t " << t;
        }
      }
    }
  }
}

}  // namespace
}  // namespace fastball::vision_tracker
