#include "launch/aim_filter.h"

#include <Eigen/Cholesky>
#include <cmath>

namespace fastball::launch {

AimFilter::AimFilter(const AimSettings& settings) : settings_(settings) {
  prior_sd_ << settings.drag, settings.velocity, settings.velocity, settings.velocity,
      settings.place, settings.place;
  covariance_ = prior_sd_.array().square().matrix().asDiagonal();
}

void AimFilter::observe(const model::LandingJacobian& H,
                        const Eigen::Vector2d& predicted,
                        const Eigen::Vector2d& landing,
                        const Eigen::Matrix2d& covariance) {
  const Eigen::Vector2d innovation = landing - predicted;
  Eigen::Matrix2d R = covariance;
  R.diagonal().array() += settings_.scatter * settings_.scatter;
  const Eigen::Matrix2d spread = H * covariance_ * H.transpose();
  const double distance = std::sqrt(innovation.dot((spread + R).llt().solve(innovation)));
  if (distance > settings_.gate)
    R *= std::pow(distance / settings_.gate, 2);
  const Eigen::Matrix<double, model::kLandingBiases, 2> gain =
      (spread + R).llt().solve(H * covariance_).transpose();
  const model::LandingBiases biases = biases_ + gain * innovation;
  // Joseph's form keeps the covariance symmetric and positive.
  const Covariance rest = Covariance::Identity() - gain * H;
  const Covariance remaining = rest * covariance_ * rest.transpose() + gain * R * gain.transpose();
  if (!biases.allFinite() || !remaining.allFinite())
    return;
  biases_ = biases;
  covariance_ = remaining;
  // Until the next throw what is forgotten goes back to the prior: the spread stays bounded.
  const double keep = 1 - settings_.drift * settings_.drift;
  biases_ *= std::sqrt(keep);
  covariance_ = keep * covariance_;
  covariance_.diagonal() += (1 - keep) * prior_sd_.array().square().matrix();
  ++throws_;
}

}  // namespace fastball::launch
