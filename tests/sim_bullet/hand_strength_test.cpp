// The simulated hand is the paper's (section 4.1): 180 degrees in 0.1 s, 300 rpm, 12 N at a fingertip.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/sim_bullet/test_scene.h"

namespace fastball::sim_bullet {
namespace {

/// A proximal joint pushed open with all its torque from the stop on one side to that on the other.
TEST(HandStrength, AFingerTurnsHalfAroundInATenthOfASecondAtItsFullSpeed) {
  Scene scene(experiment(), simulation(), {}, restStart());
  const double speed_max = experiment().hand.joint_speed_max;
  HandCommand command = scene.openHand();
  for (int k = 0; k < 1000; ++k)
    scene.brake(command);  // the ball falls out of the way
  command.q[model::kProximalThumb] = simulation().flexion_limit - 0.1;
  for (int k = 0; k < 300; ++k)
    scene.brake(command);
  const double from = scene.state().q.hand[model::kProximalThumb];
  command.kp[model::kProximalThumb] = command.kd[model::kProximalThumb] = 0;
  command.tau[model::kProximalThumb] = -experiment().hand.finger_torque_max;
  double fastest = 0, turned = 0;
  int ticks = 0;
  for (; turned < M_PI && ticks < 500; ++ticks) {
    scene.brake(command);
    turned = from - scene.state().q.hand[model::kProximalThumb];
    fastest = std::max(fastest, -scene.state().qd.hand[model::kProximalThumb]);
  }
  EXPECT_GT(fastest, 0.95 * speed_max);
  // What its torque adds within the drive's lag is on top.
  EXPECT_LT(fastest, 1.08 * speed_max);
  // The run-up adds half of the time it takes to full speed.
  EXPECT_GT(ticks * kTick, 0.100);
  EXPECT_LT(ticks * kTick, 0.115);
}

TEST(HandStrength, AFingertipPressesWithTwelveNewton) {
  const model::Hand hand(experiment().hand);
  const model::HandVector straight = hand.posture(0, 0, {0.045, 0.045, 0.045});
  const model::Segment distal = hand.phalanges(model::kThumb, straight)[1];
  const Eigen::Vector3d inwards(0, -1, 0);
  const double per_newton =
      hand.fingerTorque(model::kThumb, straight, distal.p_end, inwards).cwiseAbs().maxCoeff();
  EXPECT_NEAR(experiment().hand.finger_torque_max / per_newton, 12, 1.5);
}

}  // namespace
}  // namespace fastball::sim_bullet
