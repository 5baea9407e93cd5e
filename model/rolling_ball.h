#pragma once

#include <Eigen/Core>
#include <limits>
#include <vector>

#include "model/ball_flight.h"
#include "model/ball_parameters.h"
#include "model/finger_surface.h"

namespace fastball::model {

/// How a reference motion of the ball on its fingers is computed.
struct RollingTask {
  double t_start = 0,
         t_end = 0.2;     ///< [s]; the hand's motion is asked for from t_start to 1 ms after t_end
  double gravity = 9.81;  ///< [m/s^2], along -z of the world
  double sample_step = 1e-4;  ///< [s]
  double tolerance = 1e-10;   ///< of the integration: SI, absolute and relative
  /// x' [m] of the fingertips: a ball that has rolled there comes off, with the velocity it has.
  double fingertip = std::numeric_limits<double>::infinity();
};

/// The ball on its fingers at one time.
struct RollingSample {
  double t = 0;  ///< [s]
  Eigen::Vector3d p_FBall =
      Eigen::Vector3d::Zero();  ///< [m]: rolling distance x', displacement y', z'
  Eigen::Vector3d v_FBall = Eigen::Vector3d::Zero();  ///< [m/s], as the hand sees it
  Eigen::Vector3d force_F =
      Eigen::Vector3d::Zero();  ///< [N], F' of Eq. (18): of all fingers on the ball
  bool slipping = false;        ///< any finger
};

/// A motion on the fingers until the ball leaves them.
struct RollingMotion {
  std::vector<RollingSample> samples;  ///< at whole multiples of the sample step, and at the end
  bool released = false;               ///< the ball has left; false: still on at t_end
  bool rolled_off = false;             ///< at the fingertips, before the normal force came to zero
  double t_release = 0;                ///< [s], or t_end
  double t_slip = -1;                  ///< [s], first slip; negative: none
  BallState ball;                      ///< at t_release, in the world; Eq. (23)
  Eigen::Vector3d w_WBall = Eigen::Vector3d::Zero();  ///< [rad/s]
};

/// Rigid ball and fingers, Eqs. (18) to (23): the ball starts at rest in the hand at the fingers' origin and rolls along x', y'
/// and z' stay zero (Eq. 20). With D = -alpha0x' + gx' + (wy'^2 + wz'^2) x' and the rolling height h
///     ddx' = {D + I/(m h) dwz'} / (1 + I/(m h^2))                         (Eq. 21; 5/7 {...} on a plane, h = a)
///     F'y = m {alpha0y' - gy' + 2 wz' dx' + (dwz' + wx' wy') x'}          (Eq. 22)
/// while the friction that this needs is at most mu F'y / cos beta, the fingers' normal forces together; then it slides, until
/// it rolls again or F'y comes to zero. Rolling does not last until then, because the friction it needs stays. Air drag adds to
/// g'. The force that keeps z' zero is not counted against the friction.
/// @throw std::invalid_argument if mass, radius, friction, sample step or tolerance make no sense,
/// or the ball falls through between the fingers; std::runtime_error as integrateToEvent().
RollingMotion rollOnFingers(const BallParameters& ball,
                            const FingerPair& fingers,
                            const HandPath& hand_at,
                            const RollingTask& task);

/// Velocity of the ball in the world, Eq. (23): v0 + R dr' + omega x R r'.
/// @param r_F, v_F place [m] and velocity [m/s] in the fingers' frame.
Eigen::Vector3d releaseVelocity(const FingerFrameMotion& fingers,
                                const Eigen::Vector3d& r_F,
                                const Eigen::Vector3d& v_F);

/// @throw std::invalid_argument if mass, radius, friction, sample step or tolerance make no sense.
void requireRolling(const BallParameters& ball, const RollingTask& task);

}  // namespace fastball::model
