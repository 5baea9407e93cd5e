#include "vision_tracker/flight_problem.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "vision_tracker/flight_path.h"
#include "vision_tracker/sphere_outline.h"

namespace fastball::vision_tracker {
namespace {

constexpr double kHuber = 2.0;  // standard deviations
constexpr double kCut = 4.5;    // standard deviations
constexpr double kTrust =
    16;  // the observations' own covariances count as much as so many residuals
constexpr double kMedian = 1.1774;  // of the length of a two-dimensional normal vector

}  // namespace

FlightProblem::FlightProblem(const std::vector<Observation>& observations,
                             std::size_t first,
                             const std::vector<model::Camera>& cameras,
                             const FlightPrior& prior)
    : observations_(observations), first_(first), cameras_(cameras), prior_(prior) {
  residuals_.resize(observations.size() - first);
}

void FlightProblem::start(const model::BallState& state, double drag) {
  x_.head<3>() = state.p_WBall;
  x_.segment<3>(3) = state.v_WBall;
  x_[6] = drag;
}

bool FlightProblem::evaluate() {
  FlightPath path({x_.head<3>(), x_.segment<3>(3)}, x_[6], prior_.gravity);
  std::vector<double> distances;
  distances.reserve(residuals_.size());
  for (std::size_t i = 0; i < residuals_.size(); ++i) {
    const Observation& o = observations_[first_ + i];
    path.moveTo(seconds(utime(), o.utime));
    const model::Camera& camera = cameras_[static_cast<std::size_t>(o.camera)];
    const Eigen::Vector3d p_W = path.state().p_WBall;
    if (!(camera.toCamera(p_W).z() > 3 * prior_.ball_radius))
      return false;
    Eigen::Matrix<double, 2, 3> projection;
    const Eigen::Vector2d centre = outlineCentre(camera, p_W, prior_.ball_radius, &projection);
    Residual& r = residuals_[i];
    r.error = o.centre - centre;
    r.jacobian = projection * path.sensitivity().topRows<3>();
    r.constants = byConstants(camera, p_W, centre, projection);
    r.weight = o.cov.inverse();
    r.distance = std::sqrt(r.error.dot(r.weight * r.error));
    distances.push_back(r.distance);
  }
  const auto middle = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2);
  std::nth_element(distances.begin(), middle, distances.end());
  spread_ = std::max(1.0, *middle / kMedian);
  return std::isfinite(spread_);
}

double FlightProblem::weight(const Residual& r, bool cutting) const {
  if (cutting)
    return r.distance > kCut * spread_ ? 0.0 : 1.0;
  return std::min(1.0, kHuber * spread_ / std::max(r.distance, 1e-12));
}

FlightCovariance FlightProblem::step(bool cutting, FlightVector* change) const {
  FlightCovariance information = FlightCovariance::Zero();
  FlightVector gradient = FlightVector::Zero();
  for (const Residual& r : residuals_) {
    const double w = weight(r, cutting);
    if (w == 0)
      continue;
    const Eigen::Matrix<double, kFlightParameters, 2> half = w * r.jacobian.transpose() * r.weight;
    information += half * r.jacobian;
    gradient += half * r.error;
  }
  information(6, 6) += dragWeight();
  gradient[6] += dragWeight() * (prior_.drag - x_[6]);
  *change = information.ldlt().solve(gradient);
  return information;
}

FlightEstimate FlightProblem::estimate(FlightCovariance information) const {
  FlightEstimate e;
  e.utime = utime();
  e.start = {x_.head<3>(), x_.segment<3>(3)};
  e.drag = x_[6];
  double squares = 0, normalised = 0;
  for (const Residual& r : residuals_) {
    if (weight(r, true) == 0)
      continue;
    ++e.used;
    squares += r.error.squaredNorm();
    normalised += r.distance * r.distance;
  }
  e.residual_px = std::sqrt(squares / std::max(1, 2 * e.used));
  const double freedom = std::max(1.0, 2.0 * e.used - 6);
  e.scale = std::sqrt((kTrust + normalised) / (kTrust + freedom));
  information(6, 6) -= dragWeight();
  information /= e.scale * e.scale;
  information(6, 6) += dragWeight();
  e.noise_cov = information.ldlt().solve(FlightCovariance::Identity());
  e.cov = e.noise_cov;
  const CameraConstants variances = constantVariances(prior_.bias_sigma, prior_.calibration);
  for (const FlightGain& sum : constantSums()) {
    const FlightGain gain = e.noise_cov * sum / (e.scale * e.scale);
    e.cov += gain * variances.asDiagonal() * gain.transpose();
    e.gains.push_back(gain);
  }
  return e;
}

/// sum J^T W G of each camera.
std::vector<FlightGain> FlightProblem::constantSums() const {
  std::vector<FlightGain> sums(cameras_.size(), FlightGain::Zero());
  for (std::size_t i = 0; i < residuals_.size(); ++i) {
    const Residual& r = residuals_[i];
    if (weight(r, true) != 0)
      sums[static_cast<std::size_t>(observations_[first_ + i].camera)] +=
          r.jacobian.transpose() * r.weight * r.constants;
  }
  return sums;
}

}  // namespace fastball::vision_tracker
