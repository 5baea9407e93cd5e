#include "sim_bullet/net_bag.h"

#include <algorithm>

namespace fastball::sim_bullet {

using Eigen::Vector3d;

NetBag::NetBag(const model::Target& target,
               const NetSettings& net,
               const model::BallParameters& ball)
    : target_(target), net_(net), ball_radius_(ball.radius), ball_mass_(ball.mass) {}

Vector3d NetBag::force(const BallMotion& ball) {
  const double depth = -target_.distance(ball.p_WBall);
  const Vector3d r_W = ball.p_WBall - target_.p_WTarget;
  const Vector3d across_W = r_W + depth * target_.n_WTarget;
  const double off_axis = across_W.norm();
  if (depth_before_ < 0 && depth >= 0)
    inside_ = off_axis < target_.radius;
  inside_ = inside_ && depth >= 0;
  depth_before_ = depth;
  if (!inside_)
    return Vector3d::Zero();

  Vector3d f_W = -ball_mass_ / net_.bag_time * ball.v_WBall;
  const double sideways = off_axis - std::max(0.0, target_.radius - ball_radius_);
  if (sideways > 0 && off_axis > 0)
    f_W -= net_.bag_stiffness * sideways / off_axis * across_W;
  const double beyond = depth - (net_.bag_depth - ball_radius_);
  if (beyond > 0)
    f_W += net_.bag_stiffness * beyond * target_.n_WTarget;
  return f_W;
}

}  // namespace fastball::sim_bullet
