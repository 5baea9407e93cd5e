#include "planner/atlas.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "planner/release_window.h"
#include "planner/swing_curve.h"

namespace fastball::planner {
namespace {

// How far variables of throws may be apart that are alike.
constexpr double kAlikeAngles = 0.3;      // [rad], the pose at the begin of a window or of a swing
constexpr double kAlikeTimes = 0.15;      // [s], flight, run-up and braking
constexpr double kAlikeDeparture = 0.05;  // [m/s], of the ball in the hand as it departs
constexpr int kCrossingSteps = 4;         // Newton's, to the plane of a ring
constexpr double kAlikeSwing = 1.0;       // [rad, rad/s, 1/s] parameters of the base functions

AtlasThrow scaled(AtlasThrow t, double weight) {
  t.x *= weight;
  t.aim *= weight;
  t.departure.delay *= weight;
  t.departure.p_H *= weight;
  t.departure.v_H *= weight;
  t.v_arrival *= weight;
  t.v_aimed *= weight;
  t.q_ready *= weight;
  t.cost *= weight;
  t.inside *= weight;
  return t;
}

void add(AtlasThrow& sum, const AtlasThrow& t, double weight) {
  sum.x += weight * t.x;
  sum.aim += weight * t.aim;
  sum.departure.delay += weight * t.departure.delay;
  sum.departure.p_H += weight * t.departure.p_H;
  sum.departure.v_H += weight * t.departure.v_H;
  sum.v_arrival += weight * t.v_arrival;
  sum.v_aimed += weight * t.v_aimed;
  sum.q_ready += weight * t.q_ready;
  sum.cost += weight * t.cost;
  sum.inside += weight * t.inside;
}

/// The four nodes around a target: (0, 0), (1, 0), (0, 1), (1, 1), and where between them it lies.
struct Cell {
  std::array<int, 4> nodes{};
  double u = 0, v = 0;  ///< 0 to 1

  std::array<double, 4> weights() const {
    return {(1 - u) * (1 - v), u * (1 - v), (1 - u) * v, u * v};
  }
  /// Corners, the nearest first.
  std::array<int, 4> byDistance() const {
    std::array<int, 4> order{0, 1, 2, 3};
    const auto w = weights();
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return w[a] > w[b]; });
    return order;
  }
};

Cell cellAround(const AtlasGrid& grid, double distance, double height) {
  const double x = std::clamp((distance - grid.distance[0]) / grid.step, 0.0, grid.columns() - 1.0);
  const double y = std::clamp((height - grid.height[0]) / grid.step, 0.0, grid.rows() - 1.0);
  const int column = std::min(static_cast<int>(x), std::max(grid.columns() - 2, 0));
  const int row = std::min(static_cast<int>(y), std::max(grid.rows() - 2, 0));
  const int next_column = std::min(column + 1, grid.columns() - 1);
  const int next_row = std::min(row + 1, grid.rows() - 1);
  return {{grid.node(column, row), grid.node(next_column, row), grid.node(column, next_row),
           grid.node(next_column, next_row)},
          x - column,
          y - row};
}

/// What the corners that are like `base` say about the target.
AtlasThrow blended(const std::array<const AtlasThrow*, 4>& corners,
                   AtlasThrow base,
                   std::array<double, 4> weights) {
  int missing = -1, count = 0;
  for (int c = 0; c < 4; ++c) {
    if (corners[c] != nullptr && alike(*corners[c], base)) {
      ++count;
    } else {
      missing = c;
    }
  }
  if (count < 3) {
    base.interpolated = base.departs_alike = false;
    return base;
  }
  if (count == 3) {
    // On the plane through the others the missing corner is the sum of its neighbours less the one across.
    const double weight = weights[missing];
    weights[missing ^ 1] += weight;
    weights[missing ^ 2] += weight;
    weights[missing ^ 3] -= weight;
    weights[missing] = 0;
  }
  AtlasThrow sum = scaled(base, 0);
  for (int c = 0; c < 4; ++c) {
    if (weights[c] == 0)
      continue;
    add(sum, *corners[c], weights[c]);
    const Eigen::Vector3d v_gap = corners[c]->departure.v_H - base.departure.v_H;
    sum.departs_alike = sum.departs_alike && v_gap.norm() <= kAlikeDeparture;
  }
  return sum;
}

}  // namespace

bool alike(const AtlasThrow& a, const AtlasThrow& b) {
  if (a.window != b.window || a.elbow_sign != b.elbow_sign || a.lead != b.lead ||
      (a.q_ready - b.q_ready).cwiseAbs().maxCoeff() > kAlikeAngles)
    return false;
  const AtlasVector gap = (a.x - b.x).cwiseAbs();
  if (a.window == 0)
    return gap.maxCoeff() <= kAlikeSwing;
  return gap.head<4>().maxCoeff() <= kAlikeAngles && gap[4] <= kAlikeTimes &&
         gap.segment<8>(10).maxCoeff() <= kAlikeTimes;
}

AtlasThrow AtlasThrow::through(const model::Target& target, double gravity) const {
  // Along a parabola; what drag does in so short a time is nothing.
  const Eigen::Vector3d& n = target.n_WTarget;
  const Eigen::Vector3d fall = -gravity / 2 * Eigen::Vector3d::UnitZ();
  double later = 0;
  for (int i = 0; i < kCrossingSteps; ++i) {
    const double rate = n.dot(v_aimed + 2 * later * fall);
    if (rate >= 0)
      return *this;
    later -= n.dot(aim + later * (v_aimed + later * fall)) / rate;
  }
  AtlasThrow result = *this;
  result.aim += later * (v_aimed + later * fall);
  result.v_aimed += 2 * later * fall;
  result.x[window > 0 ? kTimeToGo : static_cast<int>(kFlightTime)] += later;
  return result;
}

AtlasThrow mirrored(AtlasThrow t) {
  if (t.window > 0) {
    for (const int i : {0, 2, 5, 6, 7})
      t.x[i] = -t.x[i];
    for (const int joint : {0, 2}) {
      t.x[18 + joint] = -t.x[18 + joint];
      t.x[22 + joint] = -t.x[22 + joint];
    }
  } else {
    for (const int i : {kAlpha1, kC1, kAlpha3, kC3})
      t.x[i] = -t.x[i];
    // Y of H lies at (-sin, cos) of the roll in the tool frame, whose y axis the mirror turns round.
    t.x[kWristRoll] = std::remainder(M_PI - t.x[kWristRoll], 2 * M_PI);
  }
  for (const int joint : {0, 2})
    t.q_ready[joint] = -t.q_ready[joint];
  t.aim.y() = -t.aim.y();
  t.v_arrival.y() = -t.v_arrival.y();
  t.v_aimed.y() = -t.v_aimed.y();
  // The hand's y axis is along the throw, z along the forearm.
  t.departure.p_H.x() = -t.departure.p_H.x();
  t.departure.v_H.x() = -t.departure.v_H.x();
  return t;
}

AtlasThrow turned(AtlasThrow t, double angle) {
  t.x[t.window > 0 ? 0 : static_cast<int>(kC1)] += angle;
  t.q_ready[0] += angle;
  const Eigen::AngleAxisd about_z(angle, Eigen::Vector3d::UnitZ());
  t.aim = about_z * t.aim;
  t.v_arrival = about_z * t.v_arrival;
  t.v_aimed = about_z * t.v_aimed;
  return t;
}

Atlas::Atlas(const AtlasGrid& grid, std::vector<AtlasLayer> layers)
    : grid_(grid), layers_(std::move(layers)) {}

int Atlas::throws() const {
  int count = 0;
  for (const AtlasLayer& layer : layers_)
    count += static_cast<int>(std::count_if(layer.nodes.begin(), layer.nodes.end(),
                                            [](const auto& node) { return node.has_value(); }));
  return count;
}

bool Atlas::holdsThrow(int node) const {
  return std::any_of(layers_.begin(), layers_.end(), [&](const AtlasLayer& layer) {
    return layer.nodes[node] && layer.nodes[node]->inside == 1;
  });
}

std::vector<AtlasThrow> Atlas::near(double distance, double height, ThrowKind kind) const {
  std::vector<AtlasThrow> found;
  const Cell cell = cellAround(grid_, distance, height);
  const auto order = cell.byDistance();
  for (const AtlasLayer& layer : layers_) {
    if (layer.kind != kind)
      continue;
    std::array<const AtlasThrow*, 4> corners{};
    for (int c = 0; c < 4; ++c) {
      const std::optional<AtlasThrow>& node = layer.nodes[cell.nodes[c]];
      if (node)
        corners[c] = &*node;
    }
    std::array<bool, 4> done{};
    for (const int c : order) {
      if (corners[c] == nullptr || done[c])
        continue;
      for (int other = 0; other < 4; ++other)
        done[other] |= corners[other] != nullptr && alike(*corners[other], *corners[c]);
      found.push_back(blended(corners, *corners[c], cell.weights()));
    }
  }
  return found;
}

}  // namespace fastball::planner
