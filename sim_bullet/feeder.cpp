#include "sim_bullet/feeder.h"

#include <Eigen/Geometry>

namespace fastball::sim_bullet {

using Eigen::Vector3d;

Feeder::Feeder(const Vector3d& p_HBall, const model::BallParameters& ball, double frequency)
    : p_HBall_(p_HBall),
      stiffness_(ball.mass * frequency * frequency),
      damping_(2 * ball.mass * frequency),
      turning_stiffness_(ball.inertia() * frequency * frequency),
      turning_damping_(2 * ball.inertia() * frequency) {}

BallMotion Feeder::rest(const ArmHand& hand) const {
  const LinkMotion& motion = hand.motion(kHandLink);
  BallMotion ball;
  ball.p_WBall = motion.X_WF * p_HBall_;
  ball.R_WBall = motion.X_WF.linear();
  ball.v_WBall = motion.velocityAt(ball.p_WBall);
  ball.w_WBall = motion.w_WF;
  return ball;
}

Wrench Feeder::step(ArmHand& hand, const BallMotion& ball) const {
  const BallMotion place = rest(hand);
  const Eigen::AngleAxisd turned(Eigen::Matrix3d(place.R_WBall * ball.R_WBall.transpose()));
  Wrench wrench;
  wrench.force =
      stiffness_ * (place.p_WBall - ball.p_WBall) + damping_ * (place.v_WBall - ball.v_WBall);
  wrench.moment = turning_stiffness_ * turned.angle() * turned.axis() +
                  turning_damping_ * (place.w_WBall - ball.w_WBall);
  hand.addForceAt(kHandLink, ball.p_WBall, -wrench.force);
  hand.addMoment(kHandLink, -wrench.moment);
  return wrench;
}

}  // namespace fastball::sim_bullet
