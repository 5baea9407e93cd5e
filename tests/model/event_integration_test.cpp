#include "model/event_integration.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace fastball::model {
namespace {

EventTask oscillator(double omega) {
  EventTask task;
  task.derivative = [omega](double, const Eigen::VectorXd& y) -> Eigen::VectorXd {
    return Eigen::Vector2d(y[1], -omega * omega * y[0]);
  };
  return task;
}

TEST(EventIntegration, FollowsAnOscillationAtEverySample) {
  for (const double omega : {1.0, 100.0, 3000.0}) {
    EventTask task = oscillator(omega);
    int samples = 0;
    task.sample_step = 1e-3;
    task.sample = [&](double t, const Eigen::VectorXd& y) {
      EXPECT_NEAR(y[0], std::cos(omega * t), 1e-6) << t;
      EXPECT_NEAR(t, 1e-3 * samples++, 1e-15);
    };
    const EventEnd end = integrateToEvent(task, 0, Eigen::Vector2d(1, 0), 0.1);
    EXPECT_EQ(end.event, -1);
    EXPECT_EQ(end.t, 0.1);
    EXPECT_EQ(samples, 100);
  }
}

TEST(EventIntegration, StopsAtTheFirstFallThroughZeroAndNotAtARise) {
  EventTask task = oscillator(100);
  task.events = {[](double, const Eigen::VectorXd& y) { return -y[0]; },
                 [](double, const Eigen::VectorXd& y) { return y[0]; },
                 [](double, const Eigen::VectorXd& y) { return y[0] + 0.5; }};
  EventEnd end = integrateToEvent(task, 0, Eigen::Vector2d(1, 0), 0.1);
  EXPECT_EQ(end.event, 1);
  EXPECT_NEAR(end.t, M_PI / 2 / 100, 1e-10);
  // From there the first function is above zero, and the third falls next.
  end = integrateToEvent(task, end.t, end.y, 0.1);
  EXPECT_EQ(end.event, 2);
  EXPECT_NEAR(end.t, 2 * M_PI / 3 / 100, 1e-10);
}

TEST(EventIntegration, OfNoTimeIsWhereItStarted) {
  const EventEnd end = integrateToEvent(oscillator(1), 0.3, Eigen::Vector2d(1, 2), 0.3);
  EXPECT_EQ(end.t, 0.3);
  EXPECT_EQ(end.y, Eigen::Vector2d(1, 2));
}

TEST(EventIntegration, SaysWhatDoesNotStayFinite) {
  EventTask task;
  task.derivative = [](double, const Eigen::VectorXd& y) -> Eigen::VectorXd {
    return y.cwiseAbs2() * 1e3;
  };
  EXPECT_THROW(integrateToEvent(task, 0, Eigen::VectorXd::Ones(1), 1), std::runtime_error);
  EXPECT_THROW(integrateToEvent(task, 0, Eigen::VectorXd::Constant(1, NAN), 1), std::runtime_error);
  EXPECT_THROW(integrateToEvent(task, 1, Eigen::VectorXd::Ones(1), 0), std::runtime_error);
}

}  // namespace
}  // namespace fastball::model
