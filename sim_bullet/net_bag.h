#pragma once

#include "model/target.h"
#include "sim_bullet/config.h"
#include "sim_bullet/world.h"

namespace fastball::sim_bullet {

/// The bag behind the ring: a tube of soft fabric with a bottom. It takes the speed of a ball that has come in through the ring
/// and keeps it inside; any other ball passes as if it were not there.
class NetBag {
 public:
  NetBag(const model::Target& target, const NetSettings& net, const model::BallParameters& ball);

  /// Force [N] on the ball; call once a step, in order: remembers whether the ball came in through the ring.
  Eigen::Vector3d force(const BallMotion& ball);

 private:
  model::Target target_;
  NetSettings net_;
  double ball_radius_;
  double ball_mass_;
  double depth_before_ = 0;  ///< [m], behind the plane
  bool inside_ = false;
};

}  // namespace fastball::sim_bullet
