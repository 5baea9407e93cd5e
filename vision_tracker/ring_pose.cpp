#include "vision_tracker/ring_pose.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace fastball::vision_tracker {
namespace {

constexpr int kIterations = 12;
constexpr int kRobustIterations = 2;  // with Huber's weights, before anything is cut
constexpr double kHuber = 2.0;        // standard deviations
constexpr double kCut = 4.0;          // standard deviations
constexpr int kLeastPoints = 8;
constexpr double kTubeDoubt =
    0.25;  // of the tube's diameter, standard deviation of the ring's radius
constexpr double kMedian = 0.6745;  // of the absolute value of a normal number

using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Vector6 = Eigen::Matrix<double, 6, 1>;

Matrix6 priorInformation(const RingPrior& prior) {
  Vector6 sigma;
  sigma << Eigen::Vector3d::Constant(prior.position), Eigen::Vector2d::Constant(prior.tilt),
      kTubeDoubt * prior.tube;
  return sigma.cwiseAbs2().cwiseInverse().asDiagonal();
}

/// One point against the ring assumed.
struct Residual {
  double error = 0;                       ///< [px]
  Eigen::Matrix<double, 1, 6> jacobian;   ///< of the predicted place
  Eigen::Matrix<double, 1, 9> constants;  ///< of the place, by the camera's constants
  double weight = 1;
};

Residual residualOf(const RingPoint& point, const model::Camera& camera, const Ring& ring) {
  Residual r;
  r.error = point.place;
  r.jacobian.setZero();
  r.constants.setZero();
  for (const auto& [angle, share] : point.angles) {
    Eigen::Matrix<double, 3, 6> motion;
    const Eigen::Vector3d p_W = ring.point(angle, &motion);
    Eigen::Matrix<double, 2, 3> projection;
    const Eigen::Vector2d pixel = camera.project(p_W, &projection);
    r.error -= share * point.across.dot(pixel);
    r.jacobian += share * point.across.transpose() * projection * motion;
    r.constants += share * point.across.transpose() * byConstants(camera, p_W, pixel, projection);
  }
  return r;
}

class RingProblem {
 public:
  RingProblem(const std::vector<RingPoint>& points,
              const std::vector<model::Camera>& cameras,
              const Ring& nominal,
              const RingPrior& prior)
      : points_(points),
        cameras_(cameras),
        nominal_(nominal),
        information_(priorInformation(prior)),
        shifts_(cameras.size(), Eigen::Vector2d::Zero()) {}

  void evaluate(const Ring& ring) {
    ring_ = ring;
    before_ = std::move(residuals_);
    residuals_.clear();
    for (const RingPoint& point : points_)
      residuals_.push_back(
          residualOf(point, cameras_[static_cast<std::size_t>(point.camera)], ring));
  }

  /// The weights of the evaluation before.
  void keepWeights() {
    for (std::size_t i = 0; i < residuals_.size(); ++i)
      residuals_[i].weight = before_[i].weight;
  }

  /// Weights from the residuals beside those of the same camera.
  void weigh(bool cutting) {
    for (int repeat = 0; repeat < 3; ++repeat) {
      for (std::size_t c = 0; c < cameras_.size(); ++c)
        shifts_[c] = shiftOf(static_cast<int>(c));
      std::vector<double> distances;
      for (std::size_t i = 0; i < points_.size(); ++i)
        distances.push_back(distance(i));
      const auto middle = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2);
      std::nth_element(distances.begin(), middle, distances.end());
      const double spread = std::max(1.0, *middle / kMedian);
      for (std::size_t i = 0; i < points_.size(); ++i) {
        const double d = distance(i) / spread;
        residuals_[i].weight = cutting ? (d > kCut ? 0.0 : 1.0) : std::min(1.0, kHuber / d);
      }
    }
  }

  Vector6 step() const {
    Matrix6 information = information_;
    Vector6 gradient = information_ * between(ring_, nominal_);
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const Residual& r = residuals_[i];
      const double w = r.weight / points_[i].variance;
      information += w * r.jacobian.transpose() * r.jacobian;
      gradient += w * r.jacobian.transpose() * r.error;
    }
    return information.ldlt().solve(gradient);
  }

  RingEstimate estimate() const {
    RingEstimate e;
    e.ring = ring_;
    e.shifts = shifts_;
    double squares = 0, normalised = 0;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      if (residuals_[i].weight == 0)
        continue;
      ++e.used;
      squares += std::pow(alone(i), 2);
      normalised += std::pow(distance(i), 2);
    }
    e.residual_px = std::sqrt(squares / std::max(1, e.used));
    const double freedom = std::max(1.0, static_cast<double>(e.used) - 6);
    const double scale = std::max(1.0, normalised / freedom);
    Matrix6 information = information_;
    std::vector<Eigen::MatrixXd> sums(cameras_.size(), Eigen::MatrixXd::Zero(6, kCameraConstants));
    std::vector<Eigen::Matrix<double, kCameraConstants, kCameraConstants>> squared(
        cameras_.size(), Eigen::Matrix<double, kCameraConstants, kCameraConstants>::Zero());
    std::vector<CameraConstants> gradients(cameras_.size(), CameraConstants::Zero());
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const Residual& r = residuals_[i];
      const auto c = static_cast<std::size_t>(points_[i].camera);
      const double w = r.weight / (points_[i].variance * scale);
      information += w * r.jacobian.transpose() * r.jacobian;
      sums[c] += w * r.jacobian.transpose() * r.constants;
      squared[c] += w * r.constants.transpose() * r.constants;
      gradients[c] += w * r.constants.transpose() * r.error;
    }
    e.cov = information.inverse();
    for (const Eigen::MatrixXd& sum : sums)
      e.gains.emplace_back(e.cov * sum);
    e.evidence = evidenceOf(squared, gradients, sums, e.cov);
    return e;
  }

 private:
  /// Residual beside the camera's others.
  double alone(std::size_t i) const {
    return residuals_[i].error -
           points_[i].across.dot(shifts_[static_cast<std::size_t>(points_[i].camera)]);
  }
  double distance(std::size_t i) const {
    return std::abs(alone(i)) / std::sqrt(points_[i].variance);
  }
  Eigen::Vector2d shiftOf(int camera) const {
    constexpr double kWeak = 1;  // [1/px^2], calibrations are not farther off than pixels
    Eigen::Matrix2d information = kWeak * Eigen::Matrix2d::Identity();
    Eigen::Vector2d gradient = Eigen::Vector2d::Zero();
    for (std::size_t i = 0; i < points_.size(); ++i) {
      if (points_[i].camera != camera)
        continue;
      const double w = residuals_[i].weight / points_[i].variance;
      information += w * points_[i].across * points_[i].across.transpose();
      gradient += w * points_[i].across * residuals_[i].error;
    }
    return information.inverse() * gradient;
  }

  const std::vector<RingPoint>& points_;
  const std::vector<model::Camera>& cameras_;
  Ring nominal_, ring_;
  Matrix6 information_;  ///< of the prior
  std::vector<Residual> residuals_, before_;
  std::vector<Eigen::Vector2d> shifts_;
};

}  // namespace

Eigen::Matrix<double, 6, 1> between(const Ring& from, const Ring& to) {
  const model::Target target = from.target(from.radius);
  const Eigen::Vector3d turn = from.n_W.cross(to.n_W);
  Vector6 change;
  change << to.p_W - from.p_W, turn.dot(target.rightAxis()), turn.dot(target.upAxis()),
      to.radius - from.radius;
  return change;
}

Eigen::Vector3d Ring::point(double angle, Eigen::Matrix<double, 3, 6>* jacobian) const {
  const model::Target plane = target(radius);
  const Eigen::Vector3d right = plane.rightAxis(), up = plane.upAxis();
  const Eigen::Vector3d outward = std::cos(angle) * right + std::sin(angle) * up;
  if (jacobian != nullptr)
    *jacobian << Eigen::Matrix3d::Identity(), right.cross(radius * outward),
        up.cross(radius * outward), outward;
  return p_W + radius * outward;
}

Ring Ring::moved(const Eigen::Matrix<double, 6, 1>& change) const {
  const model::Target plane = target(radius);
  const Eigen::Vector3d turn = change[3] * plane.rightAxis() + change[4] * plane.upAxis();
  Ring ring{p_W + change.head<3>(), n_W, radius + change[5]};
  if (turn.norm() > 0)
    ring.n_W = (Eigen::AngleAxisd(turn.norm(), turn.normalized()) * n_W).normalized();
  return ring;
}

std::optional<RingEstimate> fitRing(const std::vector<RingPoint>& points,
                                    const std::vector<model::Camera>& cameras,
                                    const Ring& nominal,
                                    const RingPrior& prior,
                                    const Ring& guess) {
  constexpr double kConverged = 1e-7;  // [m], [rad]
  if (points.size() < kLeastPoints)
    return std::nullopt;
  RingProblem problem(points, cameras, nominal, prior);
  Ring ring = guess;
  for (int i = 0; i < kIterations; ++i) {
    problem.evaluate(ring);
    // At last with fixed weights: a point at the limit would come and go.
    if (i < kIterations - 4)
      problem.weigh(i >= kRobustIterations);
    else
      problem.keepWeights();
    const Vector6 change = problem.step();
    if (!change.allFinite() || change.head<3>().norm() > 10 * prior.position ||
        change.segment<2>(3).norm() > 1)
      return std::nullopt;
    if (i > kRobustIterations && change.norm() < kConverged) {
      const RingEstimate estimate = problem.estimate();
      if (estimate.used < kLeastPoints || !estimate.cov.allFinite())
        return std::nullopt;
      return estimate;
    }
    ring = ring.moved(change);
  }
  return std::nullopt;
}

RingEstimate unseenRing(const Ring& nominal, const RingPrior& prior, std::size_t cameras) {
  RingEstimate estimate;
  estimate.ring = nominal;
  estimate.cov = priorInformation(prior).inverse();
  estimate.gains.assign(cameras, Eigen::Matrix<double, 6, 9>::Zero());
  const auto constants = static_cast<Eigen::Index>(cameras * kCameraConstants);
  estimate.evidence = {Eigen::MatrixXd::Zero(constants, constants),
                       Eigen::VectorXd::Zero(constants)};
  estimate.shifts.assign(cameras, Eigen::Vector2d::Zero());
  return estimate;
}

}  // namespace fastball::vision_tracker
