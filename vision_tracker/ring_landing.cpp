#include "vision_tracker/ring_landing.h"

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
  landing->noise_cov += by_ring * ring.cov * by_ring.transpose();
  landing->cov = landing->noise_cov;
  // The centres of the ball and the ring's image have each their own bias; the rest is the camera's.
  const CameraConstants of_ring_bias = constantVariances(ring_prior.bias, {});
  const CameraConstants shared =
      constantVariances(flight_prior.bias_sigma, flight_prior.calibration);
  for (std::size_t c = 0; c < landing->gains.size(); ++c) {
    const LandingGain by_ring_constants = by_ring * ring.gains[c];
    LandingGain& gain = landing->gains[c];
    gain.rightCols<kCameraConstants - 2>() += by_ring_constants.rightCols<kCameraConstants - 2>();
    landing->cov += gain * shared.asDiagonal() * gain.transpose() +
                    by_ring_constants * of_ring_bias.asDiagonal() * by_ring_constants.transpose();
  }
  return landing;
}

}  // namespace fastball::vision_tracker
