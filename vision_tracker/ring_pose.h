#pragma once

#include <Eigen/Core>
#include <optional>
#include <utility>
#include <vector>

#include "model/camera.h"
#include "model/target.h"
#include "vision_tracker/camera_constants.h"

namespace fastball::vision_tracker {

/// The net's ring: the middle of its tube is a circle.
struct Ring {
  Eigen::Vector3d p_W = Eigen::Vector3d::Zero();    ///< [m], centre
  Eigen::Vector3d n_W = -Eigen::Vector3d::UnitX();  ///< unit normal of its front
  double radius = 0;                                ///< [m], of the middle of the tube

  /// Point [m] of the circle at an angle [rad] from the target plane's first axis. `jacobian` (may be null): by the centre
  /// [m], a turn about the plane's first and second axis [rad], and the radius [m].
  Eigen::Vector3d point(double angle, Eigen::Matrix<double, 3, 6>* jacobian = nullptr) const;
  /// A little moved by the parameters of `jacobian`.
  Ring moved(const Eigen::Matrix<double, 6, 1>& change) const;
  /// The target that this ring is. @param inner_radius [m]
  model::Target target(double inner_radius) const { return {p_W, n_W, inner_radius}; }
};

/// How one ring lies beside another: from.moved(between(from, to)) is `to`, for small turns.
Eigen::Matrix<double, 6, 1> between(const Ring& from, const Ring& to);

/// How well a ring is known before it is seen: standard deviations.
struct RingPrior {
  double tube = 0;      ///< [m], diameter; to a quarter of it the ring's radius is known
  double position = 0;  ///< [m], of the centre, per axis
  double tilt = 0;      ///< [rad], of the normal, per axis
  double bias = 0;  ///< [px], of the ring's image, common to all of its points, per camera and axis
};

/// Where a short piece of the ring was seen, across its image. Where the ring is seen nearly from its edge, the front and the
/// back run together: then the place is the mean of what lies in the piece.
struct RingPoint {
  int camera = 0;                                     ///< index
  Eigen::Vector2d across = Eigen::Vector2d::UnitX();  ///< unit vector in the image
  std::vector<std::pair<double, double>>
      angles;           ///< [rad] of the ring, and their shares, which sum to 1
  double place = 0;     ///< [px], across . (mean image of the angles)
  double variance = 0;  ///< [px^2]
};

/// A ring fitted to the points of all cameras.
struct RingEstimate {
  Ring ring;
  /// Of centre, turns and radius (see Ring::point), from the points' noise and the prior: without
  /// the errors of the cameras' constants.
  Eigen::Matrix<double, 6, 6> cov = Eigen::Matrix<double, 6, 6>::Zero();
  /// For each camera d (centre, turns, radius) / d its constants, the bias that of the ring's image.
  std::vector<Eigen::Matrix<double, 6, kCameraConstants>> gains;
  ConstantsEvidence evidence;  ///< what the points' residuals say of the cameras' constants
  /// [px], for each camera how far all its points together lie from the ring's image.
  std::vector<Eigen::Vector2d> shifts;
  double residual_px = 0;  ///< [px], rms of the points used, the shifts taken off
  int used = 0;            ///< points that were not cut away
};

/// Maximum likelihood of centre, normal and radius, from `prior` about `nominal`. Points that do not fit are cut, judged beside
/// the others of their camera: errors of the calibration move all of them. Nothing if it does not converge or fewer than eight
/// points remain.
std::optional<RingEstimate> fitRing(const std::vector<RingPoint>& points,
                                    const std::vector<model::Camera>& cameras,
                                    const Ring& nominal,
                                    const RingPrior& prior,
                                    const Ring& guess);

/// The estimate of a ring that nobody has seen: the nominal one, as well as it is known.
RingEstimate unseenRing(const Ring& nominal, const RingPrior& prior, std::size_t cameras);

}  // namespace fastball::vision_tracker
