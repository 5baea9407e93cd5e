#pragma once

#include "model/rolling_ball.h"

namespace fastball::model {

/// The ball on its fingers at one time, elastic.
struct ElasticSample : RollingSample {
  std::vector<double> normal;       ///< [N], of each finger
  std::vector<double> deformation;  ///< y [m] of the ball at each finger; negative: apart
  double stored = 0;                ///< [J], in the deformed ball and the bristles
  double work =
      0;  ///< [J] done by the contact forces on the slip and the deformation since the start
};

/// How the elastic ball starts: place [m] and velocity [m/s] in the fingers' frame, spin [rad/s] of the ball less the hand's.
struct ElasticStart {
  Eigen::Vector3d p_FBall = Eigen::Vector3d::Zero();
  Eigen::Vector3d v_FBall = Eigen::Vector3d::Zero();
  Eigen::Vector3d w_F = Eigen::Vector3d::Zero();
};

struct ElasticMotion : RollingMotion {
  std::vector<ElasticSample> elastic;  ///< in place of `samples`, which stay empty
};

/// @throw std::invalid_argument if E, damping ratio or bristle make no sense.
void requireElastic(const BallParameters& ball);

/// At rest in the hand where the fingers' normal forces carry the ball's inertia and weight along y' (Eq. 22 with x' = 0); apart
/// from the fingers by nothing if they need not push.
/// @throw as elasticOnFingers(), and std::invalid_argument if the load is more than the ball can
/// carry (Eq. 27) or presses it through between the fingers.
ElasticStart settledStart(const BallParameters& ball,
                          const FingerPair& fingers,
                          const HandPath& hand_at,
                          const RollingTask& task);

/// The ball as an elastic one in all six degrees of freedom: at each finger Eq. (27) with damping and bristle friction, the law
/// of model/contact.h as a differential equation:
///     N = max(0, F(y) + 2 zeta sqrt(m dF/dy) dy/dt),    pull = k s + c u,    friction = -pull, clipped to mu N
///     ds/dt = (friction of opposite sign - k s) / c, which is the slip velocity u while nothing is clipped
/// s the bristle's stretch, in the contact plane and zero while apart. The ball has left when
/// nothing has pressed on it for 3 ms, or it comes to the fingertips; t_release is the last touch.
/// @throw as rollOnFingers(), and as requireElastic().
ElasticMotion elasticOnFingers(const BallParameters& ball,
                               const FingerPair& fingers,
                               const HandPath& hand_at,
                               const ElasticStart& start,
                               const RollingTask& task);

}  // namespace fastball::model
