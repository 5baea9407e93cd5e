#include "planner/held_ball.h"

namespace fastball::planner {

HeldBall::HeldBall(const model::Hand& hand, double roll, double flexion) {
  const Eigen::Isometry3d X_TH = hand.X_TH(roll, flexion);
  const Eigen::Vector3d& p_HBall = hand.parameters().p_HBall;
  R_TH = X_TH.linear();
  // The hand rolls about z of T, then flexes about its own x.
  for (int i = 0; i < 3; ++i)
    R_by_roll.col(i) = Eigen::Vector3d::UnitZ().cross(R_TH.col(i));
  R_by_flexion << Eigen::Vector3d::Zero(), R_TH.col(2), -R_TH.col(1);
  p_TBall = X_TH * p_HBall;
  p_by_roll = R_by_roll * p_HBall;
  p_by_flexion = R_by_flexion * p_HBall;
}

}  // namespace fastball::planner
