#pragma once

namespace fastball::model {

/// The urethane ball and how a finger feels on it; config/ball.yaml, with the source of every number there.
struct BallParameters {
  double radius = 0;             ///< a [m]
  double mass = 0;               ///< m [kg]
  double drag_coefficient = 0;   ///< of a sphere
  double air_density = 0;        ///< [kg/m^3]
  double youngs_modulus = 0;     ///< E [Pa] of Eq. (27)
  double damping_ratio = 0;      ///< zeta: damping force 2 zeta sqrt(k m) dy/dt with k = dF/dy
  double friction = 0;           ///< Coulomb mu between finger and ball
  double bristle_stiffness = 0;  ///< [N/m], tangential
  double bristle_damping = 0;    ///< [N s/m], tangential

  /// k of a = g - k |v| v [1/m].
  double dragPerMetre() const {
    return 0.5 * air_density * drag_coefficient * 3.14159265358979323846 * radius * radius / mass;
  }
  /// I = 2/5 m a^2 [kg m^2] (Eq. 19).
  double inertia() const { return 0.4 * mass * radius * radius; }
};

}  // namespace fastball::model
