#pragma once

#include <Eigen/Geometry>
#include <random>

#include "model/finger_surface.h"
#include "tests/model/example_hand.h"

namespace fastball::model {

/// A hand that swings about the world's z axis and rolls about its own forearm at once: the shoulder stands at the origin, the
/// ball's place in the hand `reach` [m] from it, the fingers point outwards, the ball lies in front of them in the sense of the
/// swing.
struct SwingPath {
  Eigen::Vector3d swing{0, 0,
                        0};  ///< [rad/s], [rad/s^2], [rad/s^3]: speed, acceleration, jerk at t = 0
  Eigen::Vector2d roll{0, 0};                         ///< [rad/s], [rad/s^2]
  Eigen::Vector3d push{0, 0, 0};                      ///< [m/s^2], even acceleration of everything
  double reach = 1;                                   ///< [m]
  Eigen::Matrix3d R_W = Eigen::Matrix3d::Identity();  ///< turns the whole against gravity

  HandMotion operator()(double t) const {
    using Eigen::AngleAxisd, Eigen::Matrix3d, Eigen::Vector3d;
    const double angle = swing[0] * t + swing[1] * t * t / 2 + swing[2] * t * t * t / 6;
    const double rate = swing[0] + swing[1] * t + swing[2] * t * t / 2;
    const double acceleration = swing[1] + swing[2] * t;
    const Matrix3d swung = R_W * AngleAxisd(angle, Vector3d::UnitZ()).toRotationMatrix();
    Matrix3d R_SwungH;  // z of H outwards, y of H along the swing
    R_SwungH << 0, 0, 1, 0, 1, 0, -1, 0, 0;
    const Matrix3d rolled =
        AngleAxisd(roll[0] * t + roll[1] * t * t / 2, Vector3d::UnitX()).toRotationMatrix();
    const Vector3d z = R_W * Vector3d::UnitZ(), x = swung.col(0);
    const double roll_rate = roll[0] + roll[1] * t;
    HandMotion hand;
    hand.X_WH.setIdentity();
    hand.X_WH.linear() = swung * rolled * R_SwungH;
    hand.w_WH = rate * z + roll_rate * x;
    hand.dw_WH = acceleration * z + roll[1] * x + rate * z.cross(roll_rate * x);
    const Vector3d arm = (reach - exampleHand().p_HBall.z()) * x;
    hand.X_WH.translation() = arm + push * t * t / 2;
    hand.v_WH = hand.w_WH.cross(arm) + push * t;
    hand.a_WH = hand.dw_WH.cross(arm) + hand.w_WH.cross(hand.w_WH.cross(arm)) + push;
    return hand;
  }
};

/// Fingers behind the ball: a plane, or the groove of the example hand's fingers.
inline FingerPair exampleFingers(bool groove) {
  FingerPair fingers;
  fingers.X_HF.linear() << 0, 0, -1, 0, 1, 0, 1, 0, 0;
  fingers.X_HF.translation() = exampleHand().p_HBall;
  if (groove) {
    fingers.half_spacing = 0.03;
    fingers.finger_radius = exampleHand().finger_radius;
  }
  return fingers;
}

/// A throw of the paper's size in a vertical plane: 5.2 to 6 m/s on a radius of 1 m, gravity in that plane. The hand pushes with
/// some 50 m/s^2 at first and ever less.
inline SwingPath exampleSwing() {
  SwingPath path;
  path.swing = {5.2, 45, -1200};
  path.R_W << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  return path;
}

/// A swing with roll and gravity from anywhere that pushes at first.
inline SwingPath randomSwing(std::mt19937& random) {
  std::uniform_real_distribution<> unit(-1, 1);
  SwingPath path;
  path.swing = {4 + 2 * unit(random), 45 + 15 * unit(random), -1200 + 300 * unit(random)};
  path.roll = {4 * unit(random), 40 * unit(random)};
  path.push = Eigen::Vector3d(unit(random), unit(random), unit(random));
  path.R_W = Eigen::AngleAxisd(0.5 * unit(random), Eigen::Vector3d::UnitX()) *
             Eigen::AngleAxisd(3 * unit(random), Eigen::Vector3d::UnitZ());
  path.reach = 0.9 + 0.2 * unit(random);
  return path;
}

}  // namespace fastball::model
