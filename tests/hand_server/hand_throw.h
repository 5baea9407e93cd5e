#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "hand_server/release_condition.h"
#include "tests/hand_server/scripted_hand.h"

namespace fastball::hand_server {

inline constexpr int64_t kSceneUs = 10'000'000;
inline constexpr int64_t kStartUs = kSceneUs + 600'000;

/// The hand's controller through a throw whose plan begins at kStartUs of scene 1, tick by tick.
class HandThrow : public testing::Test {
 protected:
  void arm(double window = 0) {
    ASSERT_TRUE(controller_.offerPlan(throwPlan(1, window)));
    ASSERT_TRUE(controller_.startThrow({1, 1, kStartUs}));
  }
  HandSample sample() const {
    HandSample sample{utime_, scene_, tick_, hand_.q, hand_.qd, force_};
    // The fingers carry this share of what the ball's mass takes along them.
    const double t = 1e-6 * static_cast<double>(utime_ - kStartUs);
    const HandPlan plan = throwPlan();
    const Eigen::Isometry3d X_TH = testHand().X_TH(plan.q_wrist[0], plan.q_wrist[1]);
    sample.tangential[0][0] =
        carried_ * experiment().ball.mass *
        carryingAcceleration(testArm(), plan.arm.at(t), X_TH, experiment().hand.p_HBall).z();
    return sample;
  }
  HandAnswer tick() {
    const HandAnswer answer = controller_.answer(sample()).value();
    while (const auto event = controller_.takeEvent())
      events_.push_back(*event);
    obey(answer);
    ++tick_;
    utime_ += 1000;
    return answer;
  }
  HandAnswer run(int ticks) {
    HandAnswer last;
    for (int i = 0; i < ticks; ++i)
      last = tick();
    return last;
  }

  virtual void obey(const HandAnswer& answer) { hand_.tick(answer); }

  HandServerConfig config_ = loadConfig(kExperimentPath);
  HandController controller_{testArm(), testHand(), experiment().ball, config_};
  ScriptedHand hand_;
  double carried_ = 1;
  FingerForces force_{4 / std::sqrt(3.0), 4.0, 4 / std::sqrt(3.0)};
  std::vector<ReleaseEvent> events_;
  int64_t scene_ = 1, tick_ = 0, utime_ = kSceneUs;
};

}  // namespace fastball::hand_server
