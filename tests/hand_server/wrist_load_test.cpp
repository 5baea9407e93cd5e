// The wrist's torque against the hand's momentum, differentiated numerically.
#include "hand_server/wrist_load.h"

#include <gtest/gtest.h>

#include <random>

#include "tests/hand_server/scripted_hand.h"

namespace fastball::hand_server {
namespace {

struct Momentum {
  Eigen::Vector3d p_com, L;  ///< [m]; [kg m^2/s] about the centre of mass
};

/// The arm at q + t qd + t^2/2 qdd, and the hand on it as a rigid body.
class MovingHand {
 public:
  MovingHand(const model::ArmMotion& motion, const Eigen::Vector2d& wrist)
      : motion_(motion), wrist_(wrist) {}

  Eigen::Isometry3d X_WT(double t) const {
    return arm_.X_WT(motion_.q + t * motion_.qd + 0.5 * t * t * motion_.qdd);
  }
  Eigen::Isometry3d X_WH(double t) const { return X_WT(t) * testHand().X_TH(wrist_[0], wrist_[1]); }
  Momentum momentum(double t) const {
    constexpr double h = 1e-5;
    const model::RigidBody& body = experiment().hand.payload;
    const Eigen::Matrix3d R = X_WH(t).linear();
    const Eigen::Matrix3d spin =
        (X_WH(t + h).linear() - X_WH(t - h).linear()) / (2 * h) * R.transpose();
    const Eigen::Vector3d w(spin(2, 1), spin(0, 2), spin(1, 0));
    return {X_WH(t) * body.p_BCom, R * body.I_BCom * R.transpose() * w};
  }
  /// Torque about the wrist's axes that makes the body move so.
  Eigen::Vector2d load() const {
    constexpr double h = 1e-3;
    const model::RigidBody& body = experiment().hand.payload;
    const Momentum before = momentum(-h), now = momentum(0), after = momentum(h);
    const Eigen::Vector3d a = (before.p_com - 2 * now.p_com + after.p_com) / (h * h);
    const Eigen::Vector3d force = body.mass * (a + Eigen::Vector3d(0, 0, experiment().arm.gravity));
    const Eigen::Vector3d moment =
        (after.L - before.L) / (2 * h) + (now.p_com - X_WT(0).translation()).cross(force);
    const Eigen::Matrix3d R_WT = X_WT(0).linear();
    const Eigen::Matrix3d R_WRoll = R_WT * testHand().X_TH(wrist_[0], 0).linear();
    return {R_WT.col(2).dot(moment), R_WRoll.col(0).dot(moment)};
  }

 private:
  model::Arm arm_ = testArm();
  model::ArmMotion motion_;
  Eigen::Vector2d wrist_;
};

TEST(WristLoad, IsTheRateOfChangeOfMomentum) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(-1, 1);
  const auto draw = [&](double size) -> Eigen::Vector4d {
    return Eigen::Vector4d(unit(random), unit(random), unit(random), unit(random)) * size;
  };
  for (const double size : {0.0, 1e-6, 1.0}) {
    for (int i = 0; i < 20; ++i) {
      const model::ArmMotion motion{draw(1.0), draw(3 * size), draw(30 * size)};
      const Eigen::Vector2d wrist(unit(random), unit(random));
      const Eigen::Vector2d load = wristLoad(testArm(), experiment().hand, motion, wrist);
      EXPECT_LT((load - MovingHand(motion, wrist).load()).norm(), 1e-3) << size;
    }
  }
}

}  // namespace
}  // namespace fastball::hand_server
