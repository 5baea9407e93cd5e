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
// Medians of the length of a normal vector of two and of three dimensions.
constexpr double kMedian2 = 1.1774, kMedian3 = 1.5382;

/// d mean radius / d p_W, of an outline with this mean radius [px]: its area goes as (c^2 - R^2)^1/2 (Z^2 - R^2)^-3/2. What the
/// lens changes across the image is left out.
Eigen::RowVector3d radiusSlope(const model::Camera& camera,
                               const Eigen::Vector3d& p_W,
                               double ball_radius,
                               double mean_radius) {
  const Eigen::Vector3d c = camera.toCamera(p_W);
  const double squared = ball_radius * ball_radius;
  const Eigen::Vector3d slope =
      mean_radius * (0.5 / (c.squaredNorm() - squared) * c -
                     1.5 * c.z() / (c.z() * c.z() - squared) * Eigen::Vector3d::UnitZ());
  return slope.transpose() * camera.R_CW;
}

}  // namespace

FlightProblem::FlightProblem(const std::vector<Observation>& observations,
                             std::size_t first,
                             const std::vector<model::Camera>& cameras,
                             const FlightPrior& prior)
    : observations_(observations),
      first_(first),
      cameras_(cameras),
      prior_(prior),
      with_radius_(cameras.size() == 1),
      plain_(!with_radius_ && !(prior.clock_sigma > 0) && !(prior.magnus_sigma > 0)),
      residuals_(observations.size() - first),
      estimated_(kUnknowns, true) {
  mean_[6] = prior.drag;
  prior_weight_[6] = 1 / (prior.drag_sigma * prior.drag_sigma);
  const auto know = [&](int i, double sigma, bool used) {
    estimated_[static_cast<std::size_t>(i)] = used && sigma > 0;
    prior_weight_[i] = used && sigma > 0 ? 1 / (sigma * sigma) : 1;
  };
  for (int i = 7; i < kClock; ++i)
    know(i, prior.magnus_sigma, true);
  for (int camera = 1; camera < model::kMostCameras; ++camera)
    know(kClock + camera - 1, prior.clock_sigma, camera < static_cast<int>(cameras.size()));
  know(kSize, prior.radius_sigma, with_radius_);
  know(kSizeRate, prior.radius_sigma, with_radius_);
}

void FlightProblem::start(const model::BallState& state) {
  x_ = mean_;
  x_.head<3>() = state.p_WBall;
  x_.segment<3>(3) = state.v_WBall;
}

void FlightProblem::start(const FlightEstimate& flight) {
  start(flight.at(utime(), prior_.gravity));
  x_[6] = flight.drag;
  x_.segment<3>(7) = flight.lift;
  for (std::size_t camera = 1; camera < flight.clock.size(); ++camera)
    x_[kClock + static_cast<int>(camera) - 1] = flight.clock[camera];
}

bool FlightProblem::evaluate() {
  FlightPath path({x_.head<3>(), x_.segment<3>(3)}, x_[6], prior_.gravity, x_.segment<3>(7),
                  prior_.magnus_sigma > 0);
  std::vector<double> distances;
  distances.reserve(residuals_.size());
  for (std::size_t i = 0; i < residuals_.size(); ++i) {
    const Observation& o = observations_[first_ + i];
    path.moveTo(seconds(utime(), o.utime) - clockOf(o.camera));
    const model::Camera& camera = cameras_[static_cast<std::size_t>(o.camera)];
    if (!(camera.toCamera(path.state().p_WBall).z() > 3 * prior_.ball_radius))
      return false;
    compare(o, path.state(), path.sensitivity(), residuals_[i]);
    distances.push_back(residuals_[i].distance);
  }
  const auto middle = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2);
  std::nth_element(distances.begin(), middle, distances.end());
  spread_ = std::max(1.0, *middle / (with_radius_ ? kMedian3 : kMedian2));
  return std::isfinite(spread_);
}

void FlightProblem::compare(const Observation& o,
                            const model::BallState& ball,
                            const FlightSensitivity& sensitivity,
                            Residual& r) const {
  const model::Camera& camera = cameras_[static_cast<std::size_t>(o.camera)];
  const Eigen::Vector3d& p_W = ball.p_WBall;
  Eigen::Matrix<double, 2, 3> projection;
  const Eigen::Vector2d centre = outlineCentre(camera, p_W, prior_.ball_radius, &projection);
  r.error.setZero();
  r.error.head<2>() = o.centre - centre;
  r.jacobian.setZero();
  r.jacobian.topLeftCorner<2, kFlightParameters>() = projection * sensitivity.topRows<3>();
  if (o.camera > 0 && prior_.clock_sigma > 0)
    r.jacobian.col(kClock + o.camera - 1).head<2>() = -projection * ball.v_WBall;
  r.constants = byConstants(camera, p_W, centre, projection);
  r.weight.setZero();
  r.weight.topLeftCorner<2, 2>() = o.cov.inverse();
  if (with_radius_ && o.radius_variance > 0)
    compareRadius(o, p_W, sensitivity, r);
  r.distance = std::sqrt(r.error.dot(r.weight * r.error));
}

void FlightProblem::compareRadius(const Observation& o,
                                  const Eigen::Vector3d& p_W,
                                  const FlightSensitivity& sensitivity,
                                  Residual& r) const {
  const model::Camera& camera = cameras_[static_cast<std::size_t>(o.camera)];
  const double radius = sphereOutline(camera, p_W, prior_.ball_radius).meanRadius();
  const double time = seconds(utime(), o.utime);
  const double size = 1 + x_[kSize] + time * x_[kSizeRate];
  r.error[2] = o.radius - radius * size;
  r.jacobian.row(2).head<kFlightParameters>() =
      size * radiusSlope(camera, p_W, prior_.ball_radius, radius) * sensitivity.topRows<3>();
  if (estimated_[kSize]) {
    r.jacobian(2, kSize) = radius;
    r.jacobian(2, kSizeRate) = radius * time;
  }
  r.weight(2, 2) = 1 / o.radius_variance;
}

double FlightProblem::weight(const Residual& r, bool cutting) const {
  if (cutting)
    return r.distance > kCut * spread_ ? 0.0 : 1.0;
  return std::min(1.0, kHuber * spread_ / std::max(r.distance, 1e-12));
}

template <int Rows, int Columns>
void FlightProblem::addEquations(bool cutting, Information& information, Unknowns& gradient) const {
  Eigen::Matrix<double, Columns, Columns> squares = Eigen::Matrix<double, Columns, Columns>::Zero();
  Eigen::Matrix<double, Columns, 1> sum = Eigen::Matrix<double, Columns, 1>::Zero();
  for (const Residual& r : residuals_) {
    const double w = weight(r, cutting);
    if (w == 0)
      continue;
    const Eigen::Matrix<double, Rows, Columns> jacobian =
        r.jacobian.template topLeftCorner<Rows, Columns>();
    const Eigen::Matrix<double, Columns, Rows> half =
        w * jacobian.transpose() * r.weight.template topLeftCorner<Rows, Rows>();
    squares += half * jacobian;
    sum += half * r.error.template head<Rows>();
  }
  information.template topLeftCorner<Columns, Columns>() = squares;
  gradient.template head<Columns>() = sum;
}

FlightProblem::Information FlightProblem::step(bool cutting, Unknowns* change) const {
  constexpr int kPlain = 7;  // start and drag
  Information information = Information::Zero();
  Unknowns gradient = Unknowns::Zero();
  if (plain_)
    addEquations<2, kPlain>(cutting, information, gradient);
  else
    addEquations<3, kUnknowns>(cutting, information, gradient);
  gradient += prior_weight_.cwiseProduct(mean_ - x_);
  Information all = information;
  all.diagonal() += prior_weight_;
  change->setZero();
  if (plain_)
    change->head<kPlain>() =
        all.topLeftCorner<kPlain, kPlain>().ldlt().solve(gradient.head<kPlain>());
  else
    *change = all.ldlt().solve(gradient);
  return information;
}

FlightEstimate FlightProblem::estimate(const Information& information) const {
  FlightEstimate e;
  e.utime = utime();
  e.start = {x_.head<3>(), x_.segment<3>(3)};
  e.drag = x_[6];
  e.lift = x_.segment<3>(7);
  double squares = 0, normalised = 0;
  for (const Residual& r : residuals_) {
    if (weight(r, true) == 0)
      continue;
    ++e.used;
    squares += r.error.head<2>().squaredNorm();
    normalised += r.distance * r.distance;
  }
  e.residual_px = std::sqrt(squares / std::max(1, 2 * e.used));
  const double freedom = std::max(1.0, (with_radius_ ? 3.0 : 2.0) * e.used - 6);
  e.scale = std::sqrt((kTrust + normalised) / (kTrust + freedom));
  Information all = information / (e.scale * e.scale);
  all.diagonal() += prior_weight_;
  Information inverse = all.ldlt().solve(Information::Identity());
  for (int i = 0; i < kUnknowns; ++i) {
    if (!estimated_[static_cast<std::size_t>(i)]) {
      inverse.row(i).setZero();
      inverse.col(i).setZero();
    }
  }
  e.noise_cov = inverse.topLeftCorner<kFlightParameters, kFlightParameters>();
  e.cov = e.noise_cov;
  const CameraConstants variances = constantVariances(prior_.bias_sigma, prior_.calibration);
  for (const Eigen::MatrixXd& sum : constantSums()) {
    const FlightGain gain = inverse.topRows<kFlightParameters>() * sum / (e.scale * e.scale);
    e.cov += gain * variances.asDiagonal() * gain.transpose();
    e.gains.push_back(gain);
  }
  for (int camera = 0; camera < static_cast<int>(cameras_.size()); ++camera) {
    const int i = kClock + camera - 1;
    e.clock.push_back(clockOf(camera));
    e.clock_sigma.push_back(camera == 0 ? 0 : std::sqrt(inverse(i, i)));
  }
  e.evidence = evidence(inverse, e.scale);
  const double square = e.scale * e.scale;
  const auto constants = static_cast<Eigen::Index>(cameras_.size());
  Eigen::MatrixXd likely = square * e.evidence.information;
  likely.diagonal() += variances.cwiseMax(kLeastVariance).cwiseInverse().replicate(constants, 1);
  const Eigen::VectorXd gradient = square * e.evidence.gradient;
  const double explained = gradient.dot(likely.ldlt().solve(gradient));
  e.quiet_scale = std::sqrt((kTrust + std::max(0.0, normalised - explained)) / (kTrust + freedom));
  return e;
}

ConstantsEvidence FlightProblem::evidence(const Information& inverse, double scale) const {
  using Square = Eigen::Matrix<double, kCameraConstants, kCameraConstants>;
  const double share = 1 / (scale * scale);
  std::vector<Square> squares(cameras_.size(), Square::Zero());
  std::vector<CameraConstants> gradients(cameras_.size(), CameraConstants::Zero());
  for (std::size_t i = 0; i < residuals_.size(); ++i) {
    const Residual& r = residuals_[i];
    if (weight(r, true) == 0)
      continue;
    const auto c = static_cast<std::size_t>(observations_[first_ + i].camera);
    const Eigen::Matrix2d weight_px = share * r.weight.topLeftCorner<2, 2>();
    squares[c] += r.constants.transpose() * weight_px * r.constants;
    gradients[c] += r.constants.transpose() * weight_px * r.error.head<2>();
  }
  std::vector<Eigen::MatrixXd> sums = constantSums();
  for (Eigen::MatrixXd& sum : sums)
    sum *= share;
  return evidenceOf(squares, gradients, sums, inverse);
}

/// sum J^T W G of each camera.
std::vector<Eigen::MatrixXd> FlightProblem::constantSums() const {
  std::vector<Eigen::MatrixXd> sums(cameras_.size(),
                                    Eigen::MatrixXd::Zero(kUnknowns, kCameraConstants));
  for (std::size_t i = 0; i < residuals_.size(); ++i) {
    const Residual& r = residuals_[i];
    if (weight(r, true) != 0)
      sums[static_cast<std::size_t>(observations_[first_ + i].camera)] +=
          r.jacobian.topRows<2>().transpose() * r.weight.topLeftCorner<2, 2>() * r.constants;
  }
  return sums;
}

}  // namespace fastball::vision_tracker
