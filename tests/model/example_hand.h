#pragma once

#include <cmath>

#include "model/ball_parameters.h"
#include "model/hand.h"
#include "model/release.h"

namespace fastball::model {

/// A foam ball of radius 5 cm.
inline BallParameters exampleBall() {
  BallParameters ball;
  ball.radius = 0.05;
  ball.mass = 0.033;
  ball.drag_coefficient = 0.47;
  ball.air_density = 1.2;
  ball.youngs_modulus = 5e5;
  ball.damping_ratio = 0.2;
  ball.friction = 0.8;
  ball.bristle_stiffness = 1e4;
  ball.bristle_damping = 20;
  return ball;
}

/// A hand that can hold it: fingers A and B at -120 and -60 degrees, the thumb at 90 degrees.
inline HandParameters exampleHand() {
  HandParameters hand;
  hand.p_HBall = {0, 0, 0.15};
  hand.palm_distance = 0.088;
  hand.palm_radius = 0.03;
  hand.azimuth = {-2 * M_PI / 3, M_PI / 2, -M_PI / 3};
  hand.base_radius = 0.045;
  hand.base_distance = 0.0665;
  hand.proximal_length = 0.06;
  hand.distal_length = 0.05;
  hand.finger_radius = 0.01;
  hand.finger_mass = 0.1;
  hand.joint_inertia = 1.5e-4;
  hand.wrist_inertia = 1e-3;
  hand.joint_speed_max = 31.4;
  hand.finger_torque_max = 1.2;
  hand.wrist_torque_max = 10;
  hand.actuator_lag = 1e-3;
  hand.payload.mass = 0.8;
  hand.payload.p_BCom = {0, 0, 0.07};
  hand.payload.I_BCom = Eigen::Vector3d(0.0013, 0.0013, 0.001).asDiagonal();
  return hand;
}

/// Servo gains, and an abrupt thumb.
inline ReleaseSettings exampleRelease() {
  ReleaseSettings settings;
  settings.kp << 500, 1500, 30, 120, 50, 120, 50, 30, 120, 50;
  settings.kd << 3, 8, 0.12, 0.5, 0.15, 0.5, 0.15, 0.12, 0.5, 0.15;
  settings.thumb = {-1.5, 28, 1200};
  settings.open_distance = 0.085;
  return settings;
}

}  // namespace fastball::model
