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

TEST(FlightPath, LiftIsWhatItSaysAndItsSensitivityToo) {
  using Vector10 = Eigen::Matrix<double, 10, 1>;
  const auto flown = [](const Vector10& x, double t) {
    const model::BallState s =
        flyLifted({x.head<3>(), x.segment<3>(3)}, t, x[6], x.tail<3>(), kGravity);
    Eigen::Matrix<double, 6, 1> state;
    state << s.p_WBall, s.v_WBall;
    return state;
  };
  for (const double lift : {0.0, 1e-3, 0.2, 2.0}) {
    Vector10 x;
    x << 0.3, -0.2, 0.4, 4.5, 0.3, 2.0, 0.07, lift * Eigen::Vector3d(0.2, -1, 0.4);
    for (const double t : {0.003, 0.3, 0.7, -0.1}) {
      FlightPath path({x.head<3>(), x.segment<3>(3)}, x[6], kGravity, x.tail<3>(), true);
      path.moveTo(t);
      // The acceleration, from three states.
      const double h = 1e-4;
      const Eigen::Vector3d a = (flown(x, t + h) - flown(x, t - h)).tail<3>() / (2 * h);
      const Eigen::Vector3d v = path.state().v_WBall, S = x.tail<3>();
      EXPECT_LT((a - model::flightAcceleration(v, x[6], kGravity) - S.cross(v)).norm(), 1e-4);
      for (int i = 0; i < 10; ++i) {
        const Vector10 step = 1e-5 * Vector10::Unit(i);
        // Away from no lift at all, where flyLifted() takes the simpler way.
        const Eigen::Matrix<double, 6, 1> slope = (flown(x + step, t) - flown(x - step, t)) / 2e-5;
        EXPECT_LT((slope - path.sensitivity().col(i)).norm(), 1e-6 * (1 + slope.norm()))
            << "parameter " << i << " lift " << lift << " t " << t;
      }
    }
  }
}

TEST(FlightPath, WithoutLiftIsTheModel) {
  const model::BallState start{{0.3, -0.2, 0.4}, {4.5, 0.3, 2.0}};
  const model::BallState a = flyLifted(start, 0.4, 0.07, Eigen::Vector3d::Zero(), kGravity);
  const model::BallState b = model::fly(start, 0.4, 0.07, kGravity);
  EXPECT_EQ(a.p_WBall, b.p_WBall);
  EXPECT_EQ(a.v_WBall, b.v_WBall);
}

}  // namespace
}  // namespace fastball::vision_tracker
