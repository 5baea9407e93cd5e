// The loop at 1 kHz does not allocate: neither in a swing nor while braking.
#include <gtest/gtest.h>

#include "tests/controller/closed_loop.h"
#include "tests/kit/allocation_count.h"

namespace fastball::controller {
namespace {

TEST(Allocation, NoneInALoop) {
  ArmController controller = testController();
  SimulatedArm robot{testArm(), kBack};
  ASSERT_TRUE(controller.offerPlan(swingPlan()));
  ASSERT_TRUE(controller.startThrow({1, 1, 600'000}));
  const auto run = [&](int from, int to) {
    const long before = test_kit::allocations();
    for (int i = from; i < to; ++i)
      robot.tick(controller.answer({1000 * i, 1, i, robot.q, robot.qd})->tau);
    return test_kit::allocations() - before;
  };
  EXPECT_EQ(run(0, 1000), 0);
  controller.stop("ESTOP: test");
  EXPECT_GT(test_kit::allocations(), 0) << "the counter counts";
  run(1000, 1001);
  EXPECT_EQ(run(1001, 1500), 0);
}

}  // namespace
}  // namespace fastball::controller
