#pragma once

#include <Eigen/Core>
#include <memory>

#include "model/ball_parameters.h"
#include "model/target.h"
#include "sim_bullet/arm_hand.h"
#include "sim_bullet/config.h"

namespace fastball::sim_bullet {

/// Pose and motion of the ball in the world.
struct BallMotion {
  Eigen::Vector3d p_WBall = Eigen::Vector3d::Zero();  ///< [m], centre
  Eigen::Matrix3d R_WBall = Eigen::Matrix3d::Identity();
  Eigen::Vector3d v_WBall = Eigen::Vector3d::Zero();  ///< [m/s]
  Eigen::Vector3d w_WBall = Eigen::Vector3d::Zero();  ///< [rad/s]
};

/// The Bullet world: arm and hand, the ball as a rigid sphere, the net's ring and the floor. Gravity and the contacts of the
/// ball with ring and floor are Bullet's; the hand has no Bullet contacts at all, its forces come
/// from BallContacts.
class World {
 public:
  /// @param arm_hand must outlive the world. @param gravity [m/s^2], along -z.
  World(ArmHand& arm_hand,
        const model::BallParameters& ball,
        const model::Target& target,
        const NetSettings& net,
        const FloorSettings& floor,
        double gravity);
  ~World();
  World(const World&) = delete;
  World& operator=(const World&) = delete;

  void setBall(const BallMotion& motion);
  BallMotion ball() const;
  /// Force [N] at the ball's centre and torque [N m] about it for the coming step.
  void addBallForce(const Eigen::Vector3d& f_W, const Eigen::Vector3d& m_W);

  /// One physics step of dt [s], semi-implicit Euler.
  void step(double dt);
  /// Whether the ball was pushed by the ring, or by the floor, in the last step.
  bool touchesRing() const { return touches_ring_; }
  bool touchesFloor() const { return touches_floor_; }

 private:
  struct Bullet;
  void readContacts();

  std::unique_ptr<Bullet> bullet_;
  bool touches_ring_ = false;
  bool touches_floor_ = false;
};

}  // namespace fastball::sim_bullet
