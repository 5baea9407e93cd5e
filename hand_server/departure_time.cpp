#include "hand_server/departure_time.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace fastball::hand_server {
namespace {

constexpr double kExponent = 1.25;
constexpr double kTick = 1;           // [ms], over which a reading is a mean
constexpr double kSearchStep = 0.05;  // [ms]
constexpr double kLawError = 0.1;     // of the force, what the exponent leaves out

/// Mean over the tick that ends at `time` of (end - t)^kExponent, nothing from `end` on.
double meanShape(double end, double time) {
  const auto integral = [](double left) { return std::pow(std::max(left, 0.0), kExponent + 1); };
  return (integral(end - time + kTick) - integral(end - time)) / (kExponent + 1);
}

/// Weighted sum of squares that the best b leaves.
double misfit(const std::array<ForceReading, 3>& readings,
              const std::array<double, 3>& weight,
              double end) {
  std::array<double, 3> shape{};
  double shape_force = 0, shape_shape = 0;
  for (std::size_t i = 0; i < shape.size(); ++i) {
    shape[i] = meanShape(end, readings[i].time);
    shape_force += weight[i] * shape[i] * readings[i].force;
    shape_shape += weight[i] * shape[i] * shape[i];
  }
  const double b = shape_shape > 0 ? shape_force / shape_shape : 0;
  double sum = 0;
  for (std::size_t i = 0; i < shape.size(); ++i)
    sum += weight[i] * std::pow(readings[i].force - b * shape[i], 2);
  return sum;
}

}  // namespace

double endOfForce(const std::array<ForceReading, 3>& readings, double noise) {
  constexpr double kLeastVariance = 1e-12;  // [N^2]
  std::array<double, 3> weight{};
  for (std::size_t i = 0; i < weight.size(); ++i) {
    weight[i] = 1 / (noise * noise + std::pow(kLawError * readings[i].force, 2) + kLeastVariance);
  }
  const double last = readings[1].time;
  double best = last, least = std::numeric_limits<double>::infinity();
  const auto steps = std::lround(2 * kTick / kSearchStep);
  for (long i = 0; i <= steps; ++i) {
    const double end = last - kTick + kSearchStep * static_cast<double>(i);
    const double left = misfit(readings, weight, end);
    if (left < least) {
      least = left;
      best = end;
    }
  }
  return best;
}

}  // namespace fastball::hand_server
