#include "vision_tracker/ring_landing.h"

#include <Eigen/Cholesky>
#include <cmath>

namespace fastball::vision_tracker {
namespace {

/// d landing / d (centre, turns, radius) of the ring, the flight a straight line near its crossing.
Eigen::Matrix<double, 2, 6> byRing(const model::BallState& crossing, const Ring& ring) {
  constexpr double kStep = 1e-5;  // [m], [rad]
  const auto landing = [&](const Eigen::Matrix<double, 6, 1>& change) {
    const model::Target target = ring.moved(change).target(ring.radius);
    const double time = -target.distance(crossing.p_WBall) / crossing.v_WBall.dot(target.n_WTarget);
    return target.planeCoordinates(crossing.p_WBall + time * crossing.v_WBall);
  };
  Eigen::Matrix<double, 2, 6> derivative;
  for (int i = 0; i < 6; ++i) {
    const Eigen::Matrix<double, 6, 1> change = kStep * Eigen::Matrix<double, 6, 1>::Unit(i);
    derivative.col(i) = (landing(change) - landing(-change)) / (2 * kStep);
  }
  return derivative;
}

}  // namespace

std::optional<LandingEstimate> landingOf(const FlightEstimate& flight,
                                         const RingEstimate& ring,
                                         double inner_radius,
                                         const FlightPrior& flight_prior,
                                         const RingPrior& ring_prior) {
  const model::Target target = ring.ring.target(inner_radius);
  std::optional<LandingEstimate> landing = landingOf(flight, target, flight_prior.gravity);
  if (!landing)
    return std::nullopt;
  const Eigen::Matrix<double, 2, 6> by_ring = byRing(landing->state, ring.ring);
  // What the constants explain of the flight's residuals is no noise.
  const double quiet = std::pow(flight.quiet_scale / flight.scale, 2);
  landing->noise_cov *= quiet;
  landing->noise_cov += by_ring * ring.cov * by_ring.transpose();
  landing->cov = landing->noise_cov;
  // All constants: of each camera the bias of the ball's centres, that of the ring's image, and the shared ones.
  constexpr Eigen::Index kOwn = 2, kShared = kCameraConstants - kOwn, kAll = 2 * kOwn + kShared;
  const auto cameras = static_cast<Eigen::Index>(landing->gains.size());
  Eigen::MatrixXd of_flight = Eigen::MatrixXd::Zero(kCameraConstants * cameras, kAll * cameras);
  Eigen::MatrixXd of_ring = of_flight;
  Eigen::MatrixXd information = Eigen::MatrixXd::Zero(kAll * cameras, kAll * cameras);
  Eigen::MatrixXd gain = Eigen::MatrixXd::Zero(2, kAll * cameras);
  const CameraConstants variances =
      constantVariances(flight_prior.bias_sigma, flight_prior.calibration);
  for (Eigen::Index c = 0; c < cameras; ++c) {
    const Eigen::Index row = kCameraConstants * c, col = kAll * c;
    of_flight.block(row, col, kOwn, kOwn).setIdentity();
    of_ring.block(row, col + kOwn, kOwn, kOwn).setIdentity();
    of_flight.block(row + kOwn, col + 2 * kOwn, kShared, kShared).setIdentity();
    of_ring.block(row + kOwn, col + 2 * kOwn, kShared, kShared).setIdentity();
    gain.middleCols(col, kAll) = landing->gains[static_cast<std::size_t>(c)] *
                                     of_flight.block(row, col, kCameraConstants, kAll) +
                                 by_ring * ring.gains[static_cast<std::size_t>(c)] *
                                     of_ring.block(row, col, kCameraConstants, kAll);
    Eigen::Matrix<double, kAll, 1> sigma_squared;
    sigma_squared << variances.head<kOwn>(),
        Eigen::Vector2d::Constant(ring_prior.bias * ring_prior.bias), variances.tail<kShared>();
    information.diagonal().segment(col, kAll) =
        sigma_squared.cwiseMax(kLeastVariance).cwiseInverse();
  }
  information += of_flight.transpose() * flight.evidence.information * of_flight / quiet +
                 of_ring.transpose() * ring.evidence.information * of_ring;
  const Eigen::VectorXd gradient = of_flight.transpose() * flight.evidence.gradient / quiet +
                                   of_ring.transpose() * ring.evidence.gradient;
  const Eigen::MatrixXd posterior =
      information.ldlt().solve(Eigen::MatrixXd::Identity(kAll * cameras, kAll * cameras));
  landing->landing -= gain * (posterior * gradient);
  landing->cov = landing->noise_cov + gain * posterior * gain.transpose();
  for (Eigen::Index c = 0; c < cameras; ++c) {
    LandingGain& own = landing->gains[static_cast<std::size_t>(c)];
    own.leftCols<kOwn>() = gain.middleCols<kOwn>(kAll * c);
    own.rightCols<kShared>() = gain.middleCols<kShared>(kAll * c + 2 * kOwn);
  }
  return landing;
}

}  // namespace fastball::vision_tracker
