#pragma once

#include <Eigen/Core>
#include <array>

#include "model/ball_parameters.h"
#include "model/contact.h"
#include "model/hand_parameters.h"
#include "sim_bullet/arm_hand.h"
#include "sim_bullet/world.h"

namespace fastball::sim_bullet {

/// Force of a finger on the ball, as its tactile sensor feels it.
struct FingerForce {
  double normal = 0;  ///< [N], 0 or positive
  /// [N], in the contact plane: along the hand's z axis (distal), and along n x (that), n the normal towards the ball.
  Eigen::Vector2d tangential = Eigen::Vector2d::Zero();
};

/// Force and torque on the ball about its centre, in the world.
struct Wrench {
  Eigen::Vector3d force = Eigen::Vector3d::Zero();   ///< [N]
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();  ///< [N m]
};

/// The compliant contacts between the ball and the hand: six phalanges (capsules) and the palm (a disc), each with the law of
/// model::Contact. Bullet's own contacts are rigid, and the forces of three rigid fingers are not determined.
class BallContacts {
 public:
  static constexpr int kPalm = model::kFingers;  ///< index of the palm behind the fingers

  /// @param unevenness factor on the ball's modulus under finger A, thumb and finger B.
  BallContacts(const model::HandParameters& hand,
               const model::BallParameters& ball,
               const std::array<double, model::kFingers>& unevenness = {1, 1, 1});

  /// Contact forces for the coming step of dt [s]: applies the reactions to the links, returns what acts on the ball.
  /// @param hand with current kinematics.
  Wrench step(ArmHand& hand, const BallMotion& ball, double dt);

  /// Of the last step; the two phalanges of a finger added.
  const std::array<FingerForce, model::kFingers>& forces() const { return forces_; }
  /// Who pushed the ball in the last step: fingers A, thumb, B, palm.
  const std::array<bool, model::kFingers + 1>& touching() const { return touching_; }

 private:
  struct Touch {
    Eigen::Vector3d n_W;  ///< unit, towards the ball's centre
    double deformation;   ///< y [m]
  };
  void touchFinger(int finger, ArmHand& hand, const BallMotion& ball, double dt, Wrench* wrench);
  void touchPalm(ArmHand& hand, const BallMotion& ball, double dt, Wrench* wrench);
  /// Force [N] on the ball of one contact; its reaction goes to the link.
  Eigen::Vector3d apply(const model::BallParameters& felt,
                        const Touch& touch,
                        int link,
                        ArmHand& hand,
                        const BallMotion& ball,
                        double dt,
                        model::Contact* contact,
                        Wrench* wrench);

  model::HandParameters hand_;
  model::BallParameters ball_;
  std::array<model::BallParameters, model::kFingers> finger_balls_;  ///< as each finger feels it
  std::array<std::array<model::Contact, 2>, model::kFingers> finger_contacts_;
  model::Contact palm_contact_;
  std::array<FingerForce, model::kFingers> forces_;
  std::array<bool, model::kFingers + 1> touching_{};
};

}  // namespace fastball::sim_bullet
