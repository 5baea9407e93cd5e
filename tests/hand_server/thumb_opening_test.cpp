// The thumb's way out of the ball's path.
#include "model/thumb_opening.h"

#include <gtest/gtest.h>

#include "tests/hand_server/scripted_hand.h"

namespace fastball::hand_server {
namespace {

TEST(ThumbOpening, IsPushedThenGuidedWithoutAJump) {
  const model::ThumbOpening::Settings config = loadConfig(kExperimentPath).release.thumb;
  const double torque = experiment().hand.finger_torque_max;
  model::ThumbOpening opening(config, torque);
  double q = -0.22, qd = 0;
  int pushed = 0, ticks = 0;
  for (; q > config.open_angle + 1e-3 && ticks < 200; ++ticks) {
    const model::ThumbOpening::Drive drive = opening.step(1000 * ticks, q, qd);
    if (drive.guided) {
      EXPECT_LT(std::abs(drive.q - q), 0.04) << "rad within a tick";
      EXPECT_LT(std::abs(drive.qd - qd), 2.5) << "rad/s within a tick";
      q = drive.q;
      qd = drive.qd;
    } else {
      EXPECT_EQ(drive.tau, -torque);
      ++pushed;
      qd += 1e-3 * drive.tau / 6e-4;
      q += 1e-3 * qd;
    }
    EXPECT_LT(-qd, experiment().hand.joint_speed_max);
  }
  EXPECT_GT(pushed, 5);
  EXPECT_LT(ticks, 70) << "ms";
  const model::ThumbOpening::Drive end = opening.step(1'000'000, q, qd);
  EXPECT_EQ(end.q, config.open_angle);
  EXPECT_EQ(end.qd, 0);
}

TEST(ThumbOpening, AThumbThatIsOpenStaysThere) {
  const model::ThumbOpening::Settings config = loadConfig(kExperimentPath).release.thumb;
  model::ThumbOpening opening(config, 1.2);
  const model::ThumbOpening::Drive drive = opening.step(0, config.open_angle - 0.1, 0);
  EXPECT_TRUE(drive.guided);
  EXPECT_EQ(drive.q, config.open_angle);
}

}  // namespace
}  // namespace fastball::hand_server
