#pragma once

#include <Eigen/Core>
#include <cmath>
#include <vector>

#include "launch/campaign/record.h"

namespace fastball::launch {

/// A rate with its 95 % interval of Wilson's (1927): also near 0 and 1 it holds what it says. Of
/// nothing: from 0 to 1.
struct Rate {
  int count = 0, of = 0;
  double value() const { return of > 0 ? static_cast<double>(count) / of : 0; }
  double low() const;
  double high() const;
};

/// A difference of two independent rates with its 95 % interval, by Newcombe (1998), method 10.
struct RateDifference {
  double value, low, high;
};
RateDifference difference(const Rate& of, const Rate& from);

/// What a case's throws came to.
struct CaseSummary {
  Rate hits, cleans;
  Rate settled_hits, settled_cleans;  ///< from the third throw of each set-up on
  std::vector<Rate> by_throw;         ///< hits of the first, second, ... throws of the set-ups
  int landed = 0;                     ///< throws that crossed the target plane
  Eigen::Vector2d bias = Eigen::Vector2d::Zero();        ///< [m], mean landing (right, up)
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();  ///< [m^2], of the landings about it
  /// [m/s], mean; a ball that never left the hand counts as 0.
  double release_speed = 0;

  /// [m], standard deviation of the landings. @param axis 0: right, 1: up
  double deviation(int axis) const { return std::sqrt(covariance(axis, axis)); }
};

/// @param record of a campaign; the results of case number `case_index` count.
CaseSummary summarise(const std::map<Unit, UnitResult>& record, int case_index);

}  // namespace fastball::launch
