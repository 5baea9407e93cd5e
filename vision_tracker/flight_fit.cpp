#include "vision_tracker/flight_fit.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "vision_tracker/flight_path.h"
#include "vision_tracker/sphere_outline.h"

namespace fastball::vision_tracker {
namespace {

constexpr int kIterations = 15;
constexpr int kRobustIterations = 2;  // with Huber's weights, before anything is cut
constexpr double kHuber = 2.0;        // standard deviations
constexpr double kCut = 4.5;          // standard deviations
constexpr std::size_t kLeastObservations = 8;
constexpr double kMedian = 1.1774;  // of the length of a two-dimensional normal vector

double seconds(int64_t from, int64_t to) {
  return static_cast<double>(to - from) * 1e-6;
}

/// One observation against the flight assumed.
struct Residual {
  Eigen::Vector2d error;                 ///< [px]
  Eigen::Matrix<double, 2, 7> jacobian;  ///< of the predicted centre
  Eigen::Matrix2d weight;                ///< inverse covariance
  double distance = 0;                   ///< Mahalanobis
};

class FlightProblem {
 public:
  FlightProblem(const std::vector<Observation>& observations,
                std::size_t first,
                const std::vector<model::Camera>& cameras,
                const FlightPrior& prior)
      : observations_(observations), first_(first), cameras_(cameras), prior_(prior) {
    residuals_.resize(observations.size() - first);
    x_ = Eigen::VectorXd::Zero(7 + 2 * static_cast<Eigen::Index>(cameras.size()));
  }

  int64_t utime() const { return observations_[first_].utime; }
  void start(const model::BallState& state) {
    x_.head<3>() = state.p_WBall;
    x_.segment<3>(3) = state.v_WBall;
    x_[6] = prior_.drag;
  }

  /// Residuals at the present parameters. False if the flight leaves the space before a camera.
  bool evaluate() {
    FlightPath path({x_.head<3>(), x_.segment<3>(3)}, x_[6], prior_.gravity);
    std::vector<double> distances;
    distances.reserve(residuals_.size());
    for (std::size_t i = 0; i < residuals_.size(); ++i) {
      const Observation& o = observations_[first_ + i];
      path.moveTo(seconds(utime(), o.utime));
      const model::Camera& camera = cameras_[static_cast<std::size_t>(o.camera)];
      if (!(camera.toCamera(path.state().p_WBall).z() > 3 * prior_.ball_radius))
        return false;
      Eigen::Matrix<double, 2, 3> projection;
      const Eigen::Vector2d centre =
          outlineCentre(camera, path.state().p_WBall, prior_.ball_radius, &projection);
      Residual& r = residuals_[i];
      r.error = o.centre - centre - x_.segment<2>(7 + 2 * o.camera);
      r.jacobian = projection * path.sensitivity().topRows<3>();
      r.weight = o.cov.inverse();
      r.distance = std::sqrt(r.error.dot(r.weight * r.error));
      distances.push_back(r.distance);
    }
    const auto middle = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2);
    std::nth_element(distances.begin(), middle, distances.end());
    spread_ = std::max(1.0, *middle / kMedian);
    return std::isfinite(spread_);
  }

  double weight(const Residual& r, bool cutting) const {
    if (cutting)
      return r.distance > kCut * spread_ ? 0.0 : 1.0;
    return std::min(1.0, kHuber * spread_ / std::max(r.distance, 1e-12));
  }

  /// Solves for one step; returns the information matrix.
  Eigen::MatrixXd step(bool cutting, Eigen::VectorXd* change) const {
    const Eigen::Index n = x_.size();
    Eigen::MatrixXd information = Eigen::MatrixXd::Zero(n, n);
    Eigen::VectorXd gradient = Eigen::VectorXd::Zero(n);
    for (std::size_t i = 0; i < residuals_.size(); ++i) {
      const Residual& r = residuals_[i];
      const double w = weight(r, cutting);
      if (w == 0)
        continue;
      const Eigen::Index bias = 7 + 2 * observations_[first_ + i].camera;
      const Eigen::Matrix2d weighted = w / prior_.alike * r.weight;
      const Eigen::Matrix<double, 7, 2> half = r.jacobian.transpose() * weighted;
      information.topLeftCorner<7, 7>() += half * r.jacobian;
      information.block<7, 2>(0, bias) += half;
      information.block<2, 7>(bias, 0) += half.transpose();
      information.block<2, 2>(bias, bias) += weighted;
      gradient.head<7>() += half * r.error;
      gradient.segment<2>(bias) += weighted * r.error;
    }
    const double drag_weight = 1 / (prior_.drag_sigma * prior_.drag_sigma);
    information(6, 6) += drag_weight;
    gradient[6] += drag_weight * (prior_.drag - x_[6]);
    const double bias_weight = 1 / (prior_.bias_sigma * prior_.bias_sigma);
    for (Eigen::Index i = 7; i < n; ++i) {
      information(i, i) += bias_weight;
      gradient[i] -= bias_weight * x_[i];
    }
    *change = information.ldlt().solve(gradient);
    return information;
  }

  void move(const Eigen::VectorXd& change) { x_ += change; }

  FlightEstimate estimate(const Eigen::MatrixXd& information) const {
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
    const double freedom = std::max(1.0, 2.0 * e.used - 6);
    e.residual_px = std::sqrt(squares / std::max(1, 2 * e.used));
    e.scale = std::max(1.0, std::sqrt(normalised / freedom));
    const Eigen::MatrixXd cov =
        information.ldlt().solve(Eigen::MatrixXd::Identity(x_.size(), x_.size()));
    e.cov = e.scale * e.scale * cov.topLeftCorner<7, 7>();
    return e;
  }

  bool finite() const { return x_.allFinite(); }

 private:
  const std::vector<Observation>& observations_;
  std::size_t first_;
  const std::vector<model::Camera>& cameras_;
  const FlightPrior& prior_;
  std::vector<Residual> residuals_;
  Eigen::VectorXd x_;
  double spread_ = 1;
};

/// Whether the observations of one time agree with a flight that was fitted without them.
bool agrees(const std::vector<Observation>& observations,
            std::size_t first,
            std::size_t end,
            const std::vector<model::Camera>& cameras,
            const FlightPrior& prior,
            const FlightEstimate& flight) {
  constexpr double kGate =
      16;  // squared distance of two dimensions: one in 3000 true ones is refused
  FlightPath path(flight.start, flight.drag, prior.gravity);
  path.moveTo(seconds(flight.utime, observations[first].utime));
  for (std::size_t i = first; i < end; ++i) {
    const Observation& o = observations[i];
    Eigen::Matrix<double, 2, 3> projection;
    const Eigen::Vector2d centre =
        outlineCentre(cameras[static_cast<std::size_t>(o.camera)], path.state().p_WBall,
                      prior.ball_radius, &projection);
    const Eigen::Matrix<double, 2, 7> jacobian = projection * path.sensitivity().topRows<3>();
    const Eigen::Matrix2d cov = flight.scale * flight.scale * o.cov +
                                jacobian * flight.cov * jacobian.transpose() +
                                prior.bias_sigma * prior.bias_sigma * Eigen::Matrix2d::Identity();
    const Eigen::Vector2d error = o.centre - centre;
    if (!(error.dot(cov.inverse() * error) < kGate))
      return false;
  }
  return true;
}

/// Index of the first observation of each time; observations less than half a millisecond apart are of one time.
std::vector<std::size_t> timesOf(const std::vector<Observation>& observations) {
  std::vector<std::size_t> times;
  for (std::size_t i = 0; i < observations.size(); ++i)
    if (times.empty() || observations[i].utime - observations[times.back()].utime > 500)
      times.push_back(i);
  return times;
}

}  // namespace

model::BallState FlightEstimate::at(int64_t time, double gravity) const {
  return model::fly(start, seconds(utime, time), drag, gravity);
}

std::optional<FlightEstimate> fitFlight(const std::vector<Observation>& observations,
                                        std::size_t first,
                                        const std::vector<model::Camera>& cameras,
                                        const FlightPrior& prior,
                                        const model::BallState& guess,
                                        int64_t guess_utime) {
  if (observations.size() < first + kLeastObservations)
    return std::nullopt;
  FlightProblem problem(observations, first, cameras, prior);
  problem.start(
      model::fly(guess, seconds(guess_utime, problem.utime()), prior.drag, prior.gravity));
  for (int i = 0; i < kIterations; ++i) {
    if (!problem.evaluate())
      return std::nullopt;
    Eigen::VectorXd change;
    const bool cutting = i >= kRobustIterations;
    const Eigen::MatrixXd information = problem.step(cutting, &change);
    if (!change.allFinite())
      return std::nullopt;
    problem.move(change);
    if (cutting && change.head<3>().norm() < 1e-7 && change.segment<3>(3).norm() < 1e-6) {
      const FlightEstimate estimate = problem.estimate(information);
      if (estimate.used < static_cast<int>(kLeastObservations) || !estimate.cov.allFinite())
        return std::nullopt;
      return estimate;
    }
  }
  return std::nullopt;
}

std::optional<FlightEstimate> fitFreeFlight(const std::vector<Observation>& observations,
                                            const std::vector<model::Camera>& cameras,
                                            const FlightPrior& prior,
                                            const model::BallState& guess,
                                            int64_t guess_utime,
                                            std::size_t* begin) {
  constexpr std::size_t kLeastTimes = 10;
  constexpr std::size_t kMargin = 2;  // times after the first that agrees: a finger may still touch
  const std::vector<std::size_t> times = timesOf(observations);
  const auto end_of = [&](std::size_t k) {
    return k + 1 < times.size() ? times[k + 1] : observations.size();
  };
  const auto agreed = [&](std::size_t k, const FlightEstimate& flight) {
    return agrees(observations, times[k], end_of(k), cameras, prior, flight);
  };
  std::size_t first =
      times.size() - std::min(times.size(), std::max(kLeastTimes, times.size() / 2));
  std::optional<FlightEstimate> flight =
      times.empty() ? std::nullopt
                    : fitFlight(observations, times[first], cameras, prior, guess, guess_utime);
  bool ended = false;
  while (flight && first > 0 && !ended) {
    // Back by a third at most, then fit again: a fit to few predicts the past badly.
    const std::size_t reach = std::max<std::size_t>(2, (times.size() - first) / 3);
    std::size_t back = first;
    while (back > 0 && first - back < reach && !ended) {
      // One bad time among good ones is an outlier; the fit will cut it.
      const bool good = agreed(back - 1, *flight) ||
                        (back >= 3 && agreed(back - 2, *flight) && agreed(back - 3, *flight));
      ended = !good;
      if (good)
        --back;
    }
    if (back == first)
      break;
    if (ended && times.size() - back > kLeastTimes + kMargin)
      back += kMargin;
    first = back;
    flight = fitFlight(observations, times[first], cameras, prior, flight->start, flight->utime);
  }
  if (flight && begin != nullptr)
    *begin = times[first];
  return flight;
}

std::optional<LandingEstimate> landingOf(const FlightEstimate& flight,
                                         const model::Target& target,
                                         double gravity) {
  const std::optional<model::Landing> crossing =
      model::land(flight.start, target, flight.drag, gravity);
  if (!crossing || !(std::abs(crossing->state.v_WBall.dot(target.n_WTarget)) > 1e-3))
    return std::nullopt;
  FlightPath path(flight.start, flight.drag, gravity);
  path.moveTo(crossing->time);
  // The crossing moves along the flight with the time it takes: dx - v (n . dx) / (n . v).
  const Eigen::Vector3d v = crossing->state.v_WBall;
  const Eigen::Matrix3d along =
      Eigen::Matrix3d::Identity() - v * target.n_WTarget.transpose() / v.dot(target.n_WTarget);
  Eigen::Matrix<double, 2, 3> axes;
  axes.row(0) = target.rightAxis();
  axes.row(1) = target.upAxis();
  const Eigen::Matrix<double, 2, 7> jacobian = axes * along * path.sensitivity().topRows<3>();
  LandingEstimate landing;
  landing.utime = flight.utime + std::llround(crossing->time * 1e6);
  landing.landing = crossing->landing;
  landing.cov = jacobian * flight.cov * jacobian.transpose();
  landing.state = crossing->state;
  return landing;
}

}  // namespace fastball::vision_tracker
