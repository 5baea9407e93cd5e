#pragma once

#include <Eigen/Core>
#include <string>

#include "model/landing_biases.h"

namespace fastball::launch {

/// Of strategy `adaptive`: section `run.adaptive` of the experiment file.
struct AimSettings {
  double drag = 0;      ///< standard deviation of the bias before the first throw: share
  double velocity = 0;  ///< [m/s], of each component
  double place = 0;     ///< [m], of each component
  double drift =
      0;  ///< share of those by which the biases change from throw to throw: what is forgotten
  double scatter = 0;  ///< [m], of a landing about what the set-up adds, each axis
  double gate = 0;     ///< standard deviations beyond which a landing counts less
};

/// A Kalman filter on the biases of a set-up, with the flight's Jacobians: from the signed errors of measured
/// landings it knows where the next throw would land, and the planner aims beside that. Its gain lies between 0
/// and 1, so that throws that scatter never move the aim farther than they scatter themselves.
class AimFilter {
 public:
  using Covariance = Eigen::Matrix<double, model::kLandingBiases, model::kLandingBiases>;

  explicit AimFilter(const AimSettings& settings);

  /// A ball whose landing was predicted, with the biases known then, at `predicted` [m] has landed at `landing` [m] (right,
  /// up, from the target's centre), measured with `covariance` [m^2]. Numbers too large to compute with change nothing.
  void observe(const model::LandingJacobian& H,
               const Eigen::Vector2d& predicted,
               const Eigen::Vector2d& landing,
               const Eigen::Matrix2d& covariance);

  const model::LandingBiases& biases() const { return biases_; }
  const Covariance& covariance() const { return covariance_; }
  int throws() const { return throws_; }  ///< observed

  /// The filter as a file to read, keep and delete. @throw std::runtime_error if it cannot be written.
  void save(const std::string& path) const;
  /// Goes on from such a file; one that is not there changes nothing.
  /// @throw std::invalid_argument naming file and key if it is not one, or its numbers are no biases.
  void load(const std::string& path);

 private:
  AimSettings settings_;
  model::LandingBiases prior_sd_;
  model::LandingBiases biases_ = model::LandingBiases::Zero();
  Covariance covariance_;
  int throws_ = 0;
};

}  // namespace fastball::launch
