#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "planner/hand_departure.h"
#include "planner/window_throw.h"

namespace fastball::planner {

/// The targets for which an atlas holds throws. Joint 1 turns about the vertical, and so does gravity's world: a throw
/// to a target at some azimuth is the throw to the target straight ahead, turned. So distance and height are enough.
struct AtlasGrid {
  Eigen::Vector2d distance = Eigen::Vector2d::Zero();  ///< [m], horizontal, from and to
  Eigen::Vector2d height = Eigen::Vector2d::Zero();    ///< [m], world z, from and to
  double step = 0;                                     ///< [m], of both

  int columns() const { return count(distance); }
  int rows() const { return count(height); }
  int nodes() const { return columns() * rows(); }
  int node(int column, int row) const { return row * columns() + column; }
  /// Distance and height [m] of a node.
  Eigen::Vector2d place(int node) const {
    const int column = node % columns(), row = node / columns();
    return {distance[0] + step * column, height[0] + step * row};
  }

 private:
  int count(const Eigen::Vector2d& range) const {
    return 1 + static_cast<int>((range[1] - range[0]) / step + 1e-6);
  }
};

/// What makes a throw.
enum class ThrowKind {
  kWindow,     ///< a release window
  kHeldSwing,  ///< the kinetic chain, joint 2 held
  kFreeSwing,  ///< the kinetic chain with joint 2
  kFlatSwing,  ///< the same with the shortest flight instead of the greatest speed
};

/// Decision variables of a window throw or of a swing.
using AtlasVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kWindowVariables, 1>;

/// A throw to a target straight ahead (on the x axis).
struct AtlasThrow {
  AtlasVector x;
  double window = 0;   ///< [s], length of the release window; 0 of a swing
  int elbow_sign = 0;  ///< of a swing
  double lead = 0;     ///< [s], of a swing: the command, counted from t = 0 of its base functions
  /// [m], where the ball as it moves in the hand is aimed, less the target: the fingers do the rest. In the plane of the ring.
  Eigen::Vector3d aim = Eigen::Vector3d::Zero();
  HandDeparture departure;
  bool interpolated = true;  ///< false: it is the throw to a node nearby
  bool departs_alike =
      true;  ///< false: the departure may be another one, as it differs between the nodes around
  Eigen::Vector3d v_arrival = Eigen::Vector3d::Zero();  ///< [m/s], of the ball at the target
  Eigen::Vector3d v_aimed = Eigen::Vector3d::Zero();    ///< [m/s], of the ball that is aimed, there
  Eigen::Vector4d q_ready = Eigen::Vector4d::Zero();    ///< [rad], where the swing begins
  /// 1: keeps all limits; 0: exceeds them a little, and is but a start; between them what is interpolated from both.
  double inside = 1;
  double cost = 0;  ///< of throws of one kind the least is the best

  /// The same throw with its aim in the plane of another ring, through which the aimed ball comes a little earlier or later.
  AtlasThrow through(const model::Target& target, double gravity) const;
  /// Sine of the angle at which the ball meets the plane of a ring with normal `n_W`; positive: from its front.
  double steepness(const Eigen::Vector3d& n_W) const { return -n_W.dot(v_arrival.normalized()); }
};

/// Whether a throw between two can be had by interpolation.
bool alike(const AtlasThrow& a, const AtlasThrow& b);
/// The throw seen in a mirror: left and right exchanged.
AtlasThrow mirrored(AtlasThrow x);
/// The throw turned about the vertical through the shoulder by `angle` [rad].
AtlasThrow turned(AtlasThrow x, double angle);

/// Throws of one kind that continue each other from node to node; a node without a throw is out of reach, or no longer continues.
struct AtlasLayer {
  ThrowKind kind = ThrowKind::kWindow;
  std::vector<std::optional<AtlasThrow>> nodes;
};

/// Throws for a grid of targets, as starts for throws to the targets between them.
class Atlas {
 public:
  Atlas() = default;
  /// @param layers each with as many nodes as the grid.
  Atlas(const AtlasGrid& grid, std::vector<AtlasLayer> layers);

  const AtlasGrid& grid() const { return grid_; }
  const std::vector<AtlasLayer>& layers() const { return layers_; }
  /// How many throws there are.
  int throws() const;
  /// Whether a throw inside the limits leads to a node.
  bool holdsThrow(int node) const;

  /// Throws from the nodes around a target at that horizontal distance and height [m]: of each
  /// layer of that kind, for each sort of throw at these nodes one. It is interpolated if all four
  /// nodes are alike (or three, which then define a plane), else it is that of the nearest node.
  /// Beyond the grid as at its border.
  std::vector<AtlasThrow> near(double distance, double height, ThrowKind kind) const;

 private:
  AtlasGrid grid_;
  std::vector<AtlasLayer> layers_;
};

}  // namespace fastball::planner
