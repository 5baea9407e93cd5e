#include "launch/campaign/statistics.h"

#include <algorithm>
#include <cmath>

namespace fastball::launch {
namespace {

constexpr double kZ = 1.959963984540054;  // 97.5 % of a standard normal
constexpr std::size_t kSettledFrom = 2;   // the third throw

double wilson(const Rate& rate, double side) {
  if (rate.of == 0)
    return side < 0 ? 0 : 1;
  const double n = rate.of, p = rate.value(), z2 = kZ * kZ;
  const double centre = p + z2 / (2 * n);
  const double half = kZ * std::sqrt(p * (1 - p) / n + z2 / (4 * n * n));
  return std::clamp((centre + side * half) / (1 + z2 / n), 0.0, 1.0);
}

void add(Rate& rate, bool success) {
  rate.count += success;
  ++rate.of;
}

}  // namespace

double Rate::low() const {
  return wilson(*this, -1);
}

double Rate::high() const {
  return wilson(*this, 1);
}

RateDifference difference(const Rate& of, const Rate& from) {
  const double value = of.value() - from.value();
  return {value, value - std::hypot(of.value() - of.low(), from.high() - from.value()),
          value + std::hypot(of.high() - of.value(), from.value() - from.low())};
}

CaseSummary summarise(const std::map<Unit, UnitResult>& record, int case_index) {
  CaseSummary summary;
  std::vector<Eigen::Vector2d> landings;
  double speeds = 0;
  for (const auto& [unit, result] : record) {
    if (unit.case_index != case_index)
      continue;
    for (std::size_t k = 0; k < result.throws.size(); ++k) {
      const ThrowOutcome& one = result.throws[k];
      add(summary.hits, one.hit);
      add(summary.cleans, one.clean);
      if (k >= kSettledFrom) {
        add(summary.settled_hits, one.hit);
        add(summary.settled_cleans, one.clean);
      }
      summary.by_throw.resize(std::max(summary.by_throw.size(), k + 1));
      add(summary.by_throw[k], one.hit);
      speeds += one.release_speed;
      if (one.landing)
        landings.push_back(*one.landing);
    }
  }
  summary.landed = static_cast<int>(landings.size());
  for (const Eigen::Vector2d& landing : landings)
    summary.bias += landing / summary.landed;
  for (const Eigen::Vector2d& landing : landings)
    summary.covariance += (landing - summary.bias) * (landing - summary.bias).transpose() /
                          std::max(1, summary.landed - 1);
  summary.release_speed = summary.hits.of > 0 ? speeds / summary.hits.of : 0;
  return summary;
}

}  // namespace fastball::launch
