// The loop at 1 kHz does not allocate: from the grasp to the cleared hand.
#include <gtest/gtest.h>

#include "tests/hand_server/scripted_hand.h"
#include "tests/kit/allocation_count.h"

namespace fastball::hand_server {
namespace {

constexpr int kStart = 600;  // tick in which the plan starts

/// @param window [s], of the plan: decides how the ball is let go.
void throwWithout(double window) {
  HandController controller(testArm(), testHand(), experiment().ball, loadConfig(kExperimentPath));
  ScriptedHand hand;
  HandPlan plan = throwPlan(1, window);
  plan.adapts = true;  // then the fingers try to open before the swing
  ASSERT_TRUE(controller.offerPlan(plan));
  ASSERT_TRUE(controller.startThrow({1, 1, 1000 * kStart}));
  const model::Arm arm = testArm();
  const model::BallParameters& ball = experiment().ball;
  const Eigen::Isometry3d X_TH = testHand().X_TH(plan.q_wrist[0], plan.q_wrist[1]);
  const long before = test_kit::allocations();
  ASSERT_GT(before, 0) << "the counter counts";
  Phase last = Phase::kOpen;
  for (int i = 0; i < kStart + 700; ++i) {
    const double force = i < kStart + 510 ? 2.0 : 0.0;
    HandSample sample{1000 * i, 1, i, hand.q, hand.qd, {force, force, force}};
    sample.tangential[0][0] =
        ball.mass * carryingAcceleration(arm, plan.arm.at((i - kStart) * 1e-3), X_TH,
                                         testHand().parameters().p_HBall)
                        .z();
    const auto answer = controller.answer(sample);
    controller.watchArm(1, 1000 * i, plan.arm.at((i - kStart) * 1e-3).q);
    last = answer->phase;
    hand.tick(*answer);
  }
  EXPECT_EQ(test_kit::allocations() - before, 0);
  EXPECT_EQ(last, Phase::kClear);
}

TEST(Allocation, NoneInALoopWithAnAbruptRelease) {
  throwWithout(0);
}

TEST(Allocation, NoneInALoopWithARetreat) {
  throwWithout(0.04);
}

}  // namespace
}  // namespace fastball::hand_server
