#include "hand_server/grip_settling.h"

#include <algorithm>
#include <cmath>

#include "model/contact.h"

namespace fastball::hand_server {
namespace {

/// [m], a ball that lies further off than this and the deformation is not one that the hand can throw.
constexpr double kMostChange = 0.015;

constexpr double kLittle = 0.1;      // of the planned force
constexpr double kSeekSpeed = 0.15;  // [m/s]: a finger meets the ball with less than 2 N a tick

}  // namespace

GripSettling::GripSettling(const model::GraspGeometry& grasp,
                           const model::BallParameters& ball,
                           const model::HandParameters& hand,
                           double time_constant)
    : proximal_length_(hand.proximal_length), grasp_(grasp) {
  for (int i = 0; i < model::kFingers; ++i)
    rate_[i] = 1 / (model::elasticStiffness(ball, grasp.fingers[i].deformation) * time_constant);
}

void GripSettling::step(const FingerForces& force, bool closing, double dt) {
  for (int i = 0; i < model::kFingers; ++i) {
    const double excess = force[i] - grasp_.fingers[i].force;
    if (closing && excess < 0)
      continue;
    const bool feels_nothing = force[i] < kLittle * grasp_.fingers[i].force;
    const double speed = feels_nothing ? -kSeekSpeed : rate_[i] * excess;
    change_[i] = std::clamp(change_[i] + speed * dt, -kMostChange, kMostChange);
  }
}

void GripSettling::apply(model::HandVector& q) const {
  for (const model::Finger finger : {model::kFingerA, model::kThumb, model::kFingerB}) {
    const int proximal = model::Hand::proximalJoint(finger);
    const double inward = std::sin(q[proximal]) - change_[finger] / proximal_length_;
    const double turn = std::asin(std::clamp(inward, -1.0, 1.0)) - q[proximal];
    q[proximal] += turn;
    q[proximal + 1] -= turn;
  }
}

model::GraspGeometry GripSettling::settled() const {
  model::GraspGeometry grasp = grasp_;
  for (int i = 0; i < model::kFingers; ++i)
    grasp.fingers[i].distance += change_[i];
  apply(grasp.q);
  return grasp;
}

}  // namespace fastball::hand_server
