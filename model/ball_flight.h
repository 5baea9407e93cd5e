#pragma once

#include <Eigen/Core>
#include <optional>

#include "model/ball_parameters.h"
#include "model/target.h"

namespace fastball::model {

/// Position and velocity of the ball's centre in the world.
struct BallState {
  Eigen::Vector3d p_WBall = Eigen::Vector3d::Zero();  ///< [m]
  Eigen::Vector3d v_WBall = Eigen::Vector3d::Zero();  ///< [m/s]
};

// In all that follows drag_per_metre is k [1/m], of BallParameters::dragPerMetre(), and gravity is
// along -z of the world [m/s^2].

/// a = g - k |v| v [m/s^2].
Eigen::Vector3d flightAcceleration(const Eigen::Vector3d& v_W,
                                   double drag_per_metre,
                                   double gravity);

/// The ball `duration` [s] later, or earlier if that is negative (Runge-Kutta 4, steps of at most
/// 5 ms).
BallState fly(const BallState& start, double duration, double drag_per_metre, double gravity);

/// The same with first derivatives by the velocity at the start; by the position they are the
/// identity and zero, by the duration they are velocity and acceleration at the end. With the
/// default steps [s] right to 1e-9 m.
struct FlightDerivatives {
  BallState state;
  Eigen::Matrix3d dp_dv;  ///< [s]
  Eigen::Matrix3d dv_dv;
};
FlightDerivatives flyWithDerivatives(const BallState& start,
                                     double duration,
                                     double drag_per_metre,
                                     double gravity,
                                     double largest_step = 0.02);

/// The velocity [m/s] with which a ball at p_W is at `p_WGoal` after `duration` > 0 [s]; fly() then
/// ends within 1e-4 m of it. `guess`, if known, makes it faster. Not finite where drag forbids so
/// short a flight.
Eigen::Vector3d velocityToReach(const Eigen::Vector3d& p_W,
                                const Eigen::Vector3d& p_WGoal,
                                double duration,
                                double drag_per_metre,
                                double gravity,
                                const std::optional<Eigen::Vector3d>& guess = {});

/// Where and when the ball's centre crosses the target plane from its front.
struct Landing {
  double time = 0;                                    ///< [s] after the start
  Eigen::Vector2d landing = Eigen::Vector2d::Zero();  ///< [m], plane coordinates
  BallState state;                                    ///< at the crossing
};
/// Nothing if the plane is not crossed within `max_time` [s].
std::optional<Landing> land(const BallState& start,
                            const Target& target,
                            double drag_per_metre,
                            double gravity,
                            double max_time = 3.0);

}  // namespace fastball::model
