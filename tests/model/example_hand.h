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
  return hand;
}

/// Grip, and a thumb that opens with all its torque.
inline ReleaseCommand exampleRelease() {
  ReleaseCommand release;
  release.grip_force = 6;
  release.thumb_delay = 0.001;
  release.thumb_acceleration = 3000;
  release.thumb_speed = 31.4;
  release.finger_stiffness = 1.6e4;
  return release;
}

}  // namespace fastball::model
