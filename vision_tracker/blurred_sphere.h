#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

namespace fastball::vision_tracker {

/// Where a pixel is relative to the outline.
struct Edge {
  double inside = 0;        ///< [px], distance from the outline, positive within
  Eigen::Vector2d outward;  ///< unit normal of the outline
  double per_radius = 1;    ///< d inside / d radius
  double slope =
      0;  ///< [1/px], how fast the distance from the middle, 1 at the outline, grows outwards
  Eigen::Vector2d w;                ///< the place in a disc of radius 1
  Eigen::Matrix<double, 2, 3> w_x;  ///< d w / d (centre, radius)
};

/// @param offset [px], of the pixel from the centre of the outline; @param radius [px], mean radius of the outline.
/// @param unit_inverse maps the outline divided by its mean radius onto the unit circle.
[[gnu::always_inline]] inline Edge edgeAt(const Eigen::Vector2d& offset,
                                          double radius,
                                          const Eigen::Matrix2d& unit_inverse) {
  Edge edge;
  const double curvature = 1 / radius;
  edge.w = curvature * (unit_inverse * offset);
  const double rho = edge.w.norm();
  edge.w_x << -curvature * unit_inverse, -curvature * edge.w;
  if (rho < 0.05) {
    edge.inside = radius;
    edge.outward = Eigen::Vector2d::UnitX();
    edge.slope = curvature;
    return edge;
  }
  const Eigen::Vector2d gradient = (curvature / rho) * (unit_inverse.transpose() * edge.w);
  edge.slope = gradient.norm();
  const double per_slope = 1 / edge.slope;  // one division for all
  edge.inside = (1 - rho) * per_slope;
  edge.outward = per_slope * gradient;
  edge.per_radius = rho * curvature * per_slope;
  return edge;
}

/// What a blur makes of an edge at a distance of s standard deviations, with a standard normal z.
struct BlurredEdge {
  double share = 0;    ///< P(s + z > 0)
  double density = 0;  ///< its derivative
  double root = 0;     ///< E sqrt(max(0, s + z))
  double root_s = 0;   ///< its derivative
};

/// Tables of BlurredEdge from -5 to 7 standard deviations: cubics between entries, by values and
/// slopes, good to 2e-6 (the derivative of `root` to 4e-4). Beyond 7 the first terms of the series
/// in 1 / s: `root` to 2e-4, its derivative to 2e-3.
class BlurTable {
 public:
  BlurTable();
  /// @param s distance inside of the edge over the standard deviation of the blur.
  BlurredEdge at(double s) const {
    if (s >= kHighest) {
      const double root = std::sqrt(s);
      return {1, 0, root * (1 - 1 / (8 * s * s)), 0.5 / root};
    }
    if (s <= kLowest)
      return {};
    const double place = (s - kLowest) * kPerSpacing;
    const int i = std::min(static_cast<int>(place), kEntries - 1);
    const double t = place - i, rest = 1 - t;
    const auto cubic = [&](const Entry* e) {
      return rest * rest * (1 + 2 * t) * e[i].value + t * t * (3 - 2 * t) * e[i + 1].value +
             kSpacing * t * rest * (rest * e[i].slope - t * e[i + 1].slope);
    };
    return {cubic(share_), cubic(density_), cubic(root_),
            rest * root_[i].slope + t * root_[i + 1].slope};
  }

 private:
  struct Entry {
    double value = 0, slope = 0;
  };

  static constexpr int kEntries = 120;
  static constexpr double kLowest = -5, kHighest = 7, kSpacing = 0.1, kPerSpacing = 10;
  Entry share_[kEntries + 1], density_[kEntries + 1], root_[kEntries + 1];
};

/// The normal of a sphere (two axes of the disc, and towards the camera), zero outside of it, as it looks through a blur. At the
/// limb it turns away from the camera within a pixel: without the blur the dark side would be drawn in.
struct BlurredNormal {
  Eigen::Vector3d normal;
  Eigen::Matrix3d normal_x;      ///< d normal / d (centre, radius)
  Eigen::Vector3d normal_sigma;  ///< [1/px], d normal / d sigma
};

/// @param s distance inside of the outline over the blur's `sigma` [px]
inline BlurredNormal blurredNormal(const Edge& edge,
                                   double s,
                                   double sigma,
                                   const BlurredEdge& blurred) {
  const double share = blurred.share, density = blurred.density, per_sigma = 1 / sigma;
  const Eigen::RowVector3d inside_x(edge.outward.x(), edge.outward.y(), edge.per_radius);
  const Eigen::Vector2d outwards = -edge.w_x.leftCols<2>() * edge.outward;  // d w / d distance
  const double rho = std::max(0.0, 1 - edge.inside * edge.slope);
  // sqrt(1 - rho^2) = sqrt(1 + rho) sqrt(slope sigma) sqrt(s)
  const double stretch = std::sqrt((1 + rho) * edge.slope * sigma);
  const double facing = stretch * blurred.root;
  const double facing_inside = stretch * blurred.root_s * per_sigma;
  BlurredNormal n;
  n.normal << share * edge.w - sigma * density * outwards, facing;
  n.normal_x.topRows<2>() =
      density * per_sigma * (edge.w + s * sigma * outwards) * inside_x + share * edge.w_x;
  n.normal_x.row(2) = (facing_inside - facing * edge.slope / (2 * (1 + rho))) * inside_x;
  n.normal_sigma << -density * per_sigma * s * edge.w - density * (1 + s * s) * outwards,
      facing / 2 * per_sigma - facing_inside * s;
  return n;
}

}  // namespace fastball::vision_tracker
