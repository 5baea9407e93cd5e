#pragma once

#include <Eigen/Core>

#include "model/ball_parameters.h"

namespace fastball::model {

/// Normal force [N] of the elastic ball for a deformation y [m], F = pi E (1 - y/a) y^2 (Eq. 27); 0 for y <= 0, and
/// maximumForce() from y = 2 a / 3 on, where the law itself would fall again.
double elasticForce(const BallParameters& ball, double y);
/// dF/dy [N/m]; 0 where the force is constant.
double elasticStiffness(const BallParameters& ball, double y);
/// Energy [J] stored in the deformation y [m], the integral of elasticForce().
double elasticEnergy(const BallParameters& ball, double y);
/// Largest force [N] the law can carry, 4 pi E a^2 / 27 at y = 2 a / 3.
double maximumForce(const BallParameters& ball);
/// Deformation y [m] that carries `force` [N].
/// @throw std::invalid_argument if force is above maximumForce() or negative.
double deformation(const BallParameters& ball, double force);

/// One contact between a finger and the ball: Eq. (27) with the damping force 2 zeta sqrt(m dF/dy) dy/dt, both together never
/// pulling; tangentially a bristle (spring and damper) whose foot slides at the Coulomb limit mu N. The bristle is the only
/// state. Signs: every force is that of the finger on the ball, so the normal part points along +n_W and friction against v_W.
/// The force acts on the ball at -(a - y) n_W from its centre. No function allocates or throws.
class Contact {
 public:
  /// Force [N] of the finger on the ball, and advances the bristle by dt.
  /// @param n_W unit normal from the finger to the ball's centre.
  /// @param y deformation [m], positive in touch.
  /// @param v_W velocity [m/s] of the ball's material point at the contact relative to the finger's: dy/dt = -n_W . v_W.
  /// @param dt step [s], positive.
  Eigen::Vector3d step(const BallParameters& ball,
                       const Eigen::Vector3d& n_W,
                       double y,
                       const Eigen::Vector3d& v_W,
                       double dt);
  /// The next touch begins with a relaxed bristle; step() does so by itself while y <= 0.
  void reset() { bristle_W_.setZero(); }
  /// Whether friction was at the Coulomb limit in the last step.
  bool slipping() const { return slipping_; }
  /// Stretch of the bristle [m], in the contact plane.
  const Eigen::Vector3d& bristle() const { return bristle_W_; }

 private:
  Eigen::Vector3d friction(const BallParameters& ball,
                           const Eigen::Vector3d& n_W,
                           double normal,
                           const Eigen::Vector3d& v_slip,
                           double dt);

  Eigen::Vector3d bristle_W_ = Eigen::Vector3d::Zero();  ///< [m]
  bool slipping_ = false;
};

}  // namespace fastball::model
