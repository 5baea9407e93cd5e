#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <functional>
#include <vector>

#include "model/hand.h"
#include "model/hand_motion.h"

namespace fastball::model {

/// The hand's motion at a time [s].
using HandPath = std::function<HandMotion(double)>;

/// What the ball rolls on, fixed in the hand: a plane, or a straight finger of round section and without ends.
struct FingerSurface {
  Eigen::Vector3d p_H;          ///< [m], on the plane or on the finger's axis
  Eigen::Vector3d direction_H;  ///< unit: a plane's normal, out of it; a finger's axis
  double radius = 0;            ///< [m]; 0: a plane
};

/// Where a surface is nearest to the ball.
struct SurfaceMeeting {
  Eigen::Vector3d n_H;  ///< unit, from the surface to the ball's centre
  double distance = 0;  ///< [m], of the ball's centre from the surface
};
/// p_HBall [m]. Has no direction, and n_H is zero, for a centre on a finger's axis.
SurfaceMeeting meet(const FingerSurface& surface, const Eigen::Vector3d& p_HBall);

/// The two fingers of Fig. 7 behind the ball: parallel, straight, moving as one. Frame F: x along the fingers (the paper's x'),
/// y from them to the ball (y'), z = x cross y; its origin is the ball's centre when it touches without deformation.
struct FingerPair {
  Eigen::Isometry3d X_HF = Eigen::Isometry3d::Identity();
  double half_spacing = 0;   ///< w [m], of the fingers' axes from the plane z = 0
  double finger_radius = 0;  ///< r_f [m]; with w = 0 too: a flat finger plane

  /// No groove: a plane, or a single round finger.
  bool flat() const { return half_spacing == 0; }
  /// cos beta, sin beta = w / (a + r_f): beta is the contact normals' angle to y. 1 without a
  /// groove.
  /// @throw std::invalid_argument if the ball falls through between the fingers, the ball's radius
  /// is not positive, or another length is negative or no number.
  double cosBeta(double ball_radius) const;
  /// h [m], of the ball's centre above the line about which it rolls: a on a plane, a cos beta in
  /// the groove. @throw as cosBeta(), and so does surfaces().
  double rollingHeight(double ball_radius) const { return ball_radius * cosBeta(ball_radius); }
  /// One plane or two round fingers, in H. A pair of spacing 0 with a radius is one round finger.
  std::vector<FingerSurface> surfaces(double ball_radius) const;
};

/// The hand's fingers A and B where they touch the ball in its nominal place without pressing, y between their normals.
/// @throw std::invalid_argument if they stand on opposite sides of the ball.
FingerPair fingersBehind(const HandParameters& hand, double ball_radius);

/// The fingers' frame, its origin's velocity [m/s] and acceleration [m/s^2] and the hand's turning
/// [rad/s], [rad/s^2], everything in F's own axes (the primed quantities of Eq. 18).
struct FingerFrameMotion {
  Eigen::Isometry3d X_WF;
  Eigen::Vector3d v_F, a_F;   ///< v0', alpha0'
  Eigen::Vector3d w_F, dw_F;  ///< omega0', its derivative
};
FingerFrameMotion fingerFrameMotion(const FingerPair& fingers, const HandMotion& hand);

}  // namespace fastball::model
