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
constexpr double kTrust =
    16;  // the observations' own covariances count as much as so many residuals
constexpr std::size_t kLeastObservations = 8;
constexpr double kMedian = 1.1774;  // of the length of a two-dimensional normal vector

double seconds(int64_t from, int64_t to) {
  return static_cast<double>(to - from) * 1e-6;
}

using Information = Eigen::Matrix<double, 7, 7>;

/// d centre / d what stays the same through a flight, of one camera: bias [px], small rotation of the camera [rad], its position
/// [m], relative focal length.
Eigen::Matrix<double, 2, 9> byConstants(const model::Camera& camera,
                                        const Eigen::Vector3d& p_W,
                                        const Eigen::Vector2d& centre,
                                        const Eigen::Matrix<double, 2, 3>& projection) {
  const Eigen::Vector3d p_C = camera.toCamera(p_W);
  Eigen::Matrix3d cross;
  cross << 0, -p_C.z(), p_C.y(), p_C.z(), 0, -p_C.x(), -p_C.y(), p_C.x(), 0;
  Eigen::Matrix<double, 2, 9> derivative;
  derivative << Eigen::Matrix2d::Identity(), projection * camera.R_CW.transpose() * cross,
      projection, centre - Eigen::Vector2d(camera.cx, camera.cy);
  return derivative;
}

/// Variances of the same.
Eigen::Matrix<double, 9, 1> constantVariances(const FlightPrior& prior) {
  Eigen::Matrix<double, 9, 1> sigma;
  sigma << Eigen::Vector2d::Constant(prior.bias_sigma),
      Eigen::Vector3d::Constant(prior.calibration.rotation),
      Eigen::Vector3d::Constant(prior.calibration.position), prior.calibration.focal_length;
  return sigma.cwiseAbs2();
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
      r.error = o.centre - centre;
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

  /// Solves for one step.
  Information step(bool cutting, Eigen::Matrix<double, 7, 1>* change) const {
    Information information = Information::Zero();
    Eigen::Matrix<double, 7, 1> gradient = Eigen::Matrix<double, 7, 1>::Zero();
    for (const Residual& r : residuals_) {
      const double w = weight(r, cutting);
      if (w == 0)
        continue;
      const Eigen::Matrix<double, 7, 2> half = w * r.jacobian.transpose() * r.weight;
      information += half * r.jacobian;
      gradient += half * r.error;
    }
    information(6, 6) += dragWeight();
    gradient[6] += dragWeight() * (prior_.drag - x_[6]);
    *change = information.ldlt().solve(gradient);
    return information;
  }

  void move(const Eigen::Matrix<double, 7, 1>& change) { x_ += change; }

  FlightEstimate estimate(Information information) const {
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
    const Information inverse = information.ldlt().solve(Information::Identity());
    e.cov = inverse;
    const Eigen::Matrix<double, 9, 1> variances = constantVariances(prior_);
    for (const Eigen::Matrix<double, 7, 9>& sum : constantSums()) {
      const Eigen::Matrix<double, 7, 9> gain = inverse * sum / (e.scale * e.scale);
      e.cov += gain * variances.asDiagonal() * gain.transpose();
    }
    return e;
  }

 private:
  double dragWeight() const { return 1 / (prior_.drag_sigma * prior_.drag_sigma); }

  /// sum J^T W G of each camera.
  std::vector<Eigen::Matrix<double, 7, 9>> constantSums() const {
    std::vector<Eigen::Matrix<double, 7, 9>> sums(cameras_.size(),
                                                  Eigen::Matrix<double, 7, 9>::Zero());
    FlightPath path({x_.head<3>(), x_.segment<3>(3)}, x_[6], prior_.gravity);
    for (std::size_t i = 0; i < residuals_.size(); ++i) {
      const Residual& r = residuals_[i];
      if (weight(r, true) == 0)
        continue;
      const Observation& o = observations_[first_ + i];
      path.moveTo(seconds(utime(), o.utime));
      const auto camera = static_cast<std::size_t>(o.camera);
      const Eigen::Vector3d p_W = path.state().p_WBall;
      Eigen::Matrix<double, 2, 3> projection;
      const Eigen::Vector2d centre =
          outlineCentre(cameras_[camera], p_W, prior_.ball_radius, &projection);
      sums[camera] += r.jacobian.transpose() * r.weight *
                      byConstants(cameras_[camera], p_W, centre, projection);
    }
    return sums;
  }

  const std::vector<Observation>& observations_;
  std::size_t first_;
  const std::vector<model::Camera>& cameras_;
  const FlightPrior& prior_;
  std::vector<Residual> residuals_;
  Eigen::Matrix<double, 7, 1> x_ = Eigen::Matrix<double, 7, 1>::Zero();
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
    Eigen::Matrix<double, 7, 1> change;
    const bool cutting = i >= kRobustIterations;
    const Information information = problem.step(cutting, &change);
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
  // Fewer bad times in a row among good ones are outliers, which the fit will cut; a hand that holds the ball leads it away
  // from the flight for good.
  constexpr std::size_t kBadTimes = 4;
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
    const std::size_t reach = std::max<std::size_t>(kBadTimes, (times.size() - first) / 3);
    std::size_t back = first, bad = 0;
    for (std::size_t k = first; k > 0 && first - back < reach && !ended; --k) {
      if (agreed(k - 1, *flight)) {
        back = k - 1;
        bad = 0;
      } else {
        ended = ++bad == kBadTimes;
      }
    }
    if (back == first && !ended)
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
