#include "config/hand_file.h"

#include <fmt/format.h>

#include <cmath>

#include "config/arm_file.h"
#include "model/contact.h"
#include "model/rigid_body.h"

namespace fastball::config {

namespace {

/// Load [N] that the ball must be able to carry: the fingers' 12 N with half as much again for the
/// swing.
constexpr double kLargestLoad = 18.0;
constexpr double kPi = 3.14159265358979323846;

void readFingers(Section& file, model::HandParameters* hand) {
  const bool even = file.choice("layout", {"two_behind", "even"}) == "even";
  const double behind = even ? kPi / 3 : kPi / 6;  // [rad], of A and B from -y
  hand->azimuth = {-kPi / 2 - behind, kPi / 2, -kPi / 2 + behind};
  hand->finger_mass = file.number("finger_mass", kPositive);
  hand->base_radius = file.number("base_radius", {0, 1});
  hand->base_distance = file.number("base_distance", {0, 1});
  hand->proximal_length = file.number("proximal_length", {1e-3, 1});
  hand->distal_length = file.number("distal_length", {1e-3, 1});
  hand->finger_radius = file.number("finger_radius", {1e-3, 1});
}

void readDrives(Section& file, model::HandParameters* hand) {
  hand->joint_inertia = file.number("joint_inertia", kPositive);
  hand->wrist_inertia = file.number("wrist_inertia", kPositive);
  hand->joint_speed_max = file.number("joint_speed_max", kPositive);
  hand->finger_torque_max = file.number("finger_torque_max", kPositive);
  hand->wrist_torque_max = file.number("wrist_torque_max", kPositive);
  hand->wrist_limit = file.number("wrist_limit", {1e-3, 2 * kPi});
  hand->actuator_lag = file.number("actuator_lag", {0, 1});
}

}  // namespace

model::BallParameters readBall(Section file) {
  model::BallParameters ball;
  ball.radius = file.number("radius", {1e-3, 1});
  ball.mass = file.number("mass", kPositive);
  ball.drag_coefficient = file.number("drag_coefficient", {0, 10});
  ball.air_density = file.number("air_density", {0, 10});
  ball.youngs_modulus = file.number("youngs_modulus", kPositive);
  ball.damping_ratio = file.number("damping_ratio", {0, 10});
  ball.friction = file.number("friction", {0, 10});
  ball.bristle_stiffness = file.number("bristle_stiffness", kPositive);
  ball.bristle_damping = file.number("bristle_damping", kNonNegative);
  file.finish();
  if (model::maximumForce(ball) < kLargestLoad) {
    const double least = kLargestLoad * 27 / (4 * kPi * ball.radius * ball.radius);
    throw file.error("youngs_modulus",
                     fmt::format("is {} Pa, with which the ball carries no more than {:.3g} N; "
                                 "for {} N it must be at least {:.0f} Pa",
                                 ball.youngs_modulus, model::maximumForce(ball), kLargestLoad,
                                 std::ceil(least)));
  }
  return ball;
}

model::HandParameters readHand(Section file, const model::BallParameters& ball) {
  model::HandParameters hand;
  hand.p_HBall = file.vector("ball_position", 3, {-1, 1});
  hand.palm_distance = file.number("palm_distance", {0, 1});
  hand.palm_radius = file.number("palm_radius", {1e-3, 1});
  hand.palm = readBody(file.section("palm"));
  readFingers(file, &hand);
  readDrives(file, &hand);
  const model::RigidBody whole = readBody(file.section("whole"));
  file.finish();

  const double parts = hand.palm.mass + model::kFingers * hand.finger_mass;
  if (std::abs(whole.mass - parts) > 1e-6) {
    throw file.error("whole", fmt::format("has a mass of {} kg, but palm and fingers have {} kg",
                                          whole.mass, parts));
  }
  if (hand.p_HBall.z() - ball.radius < hand.palm_distance) {
    throw file.error("ball_position",
                     fmt::format("puts the ball of radius {} m inside the palm, which is {} m from "
                                 "the tool plate",
                                 ball.radius, hand.palm_distance));
  }
  hand.payload = model::combine(whole, model::solidSphere(ball.mass, ball.radius, hand.p_HBall));
  return hand;
}

}  // namespace fastball::config
