#include "bench/flight_trials.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <random>

#include "bench/flight_bound.h"
#include "bench/synthetic_throw.h"
#include "vision_tracker/flight_landing.h"
#include "vision_tracker/free_flight.h"
#include "vision_tracker/sphere_outline.h"

namespace fastball::bench {
namespace {

constexpr double kClear = 1.2;       // ball radii before the plane, as the tracker
constexpr double kInside95 = 5.991;  // 95 % quantile of a chi-square of two dimensions
constexpr int64_t kStart = 5000000;  // [us]

/// A flight, what was seen of it, and what could have been seen.
struct SeenFlight {
  SyntheticThrow made;
  std::vector<vision_tracker::Observation> observations;
  std::vector<View> views;
};

class Trial {
 public:
  Trial(const std::vector<model::Camera>& cameras,
        double rate,
        const config::Experiment& experiment,
        const vision_tracker::TrackerOptions& tracker,
        const FlightTrialOptions& options)
      : cameras_(cameras),
        rate_(rate),
        experiment_(experiment),
        tracker_(tracker),
        options_(options),
        random_(static_cast<unsigned>(options.seed)) {}

  SeenFlight fly(int index) {
    SeenFlight seen;
    std::normal_distribution<double> normal;
    const vision_tracker::FlightPrior& prior = tracker_.prior;
    const double drag = std::max(0.0, prior.drag + prior.drag_sigma * normal(random_));
    seen.made = makeFlight(experiment_, options_.seed * 100000 + index, drag);
    clocks_.assign(cameras_.size(), 0);
    for (std::size_t i = 1; i < clocks_.size() && prior.clock_sigma > 0; ++i)
      clocks_[i] = prior.clock_sigma * normal(random_);
    const double end = options_.seen * seen.made.landing.time;
    for (int k = 0; k / rate_ < end; ++k) {
      const int64_t utime = kStart + std::llround(k * 1e6 / rate_);
      const double time = static_cast<double>(utime - kStart) * 1e-6;
      const model::BallState ball = model::fly(seen.made.release, time, drag, prior.gravity);
      if (experiment_.target.distance(ball.p_WBall) < kClear * prior.ball_radius)
        break;
      for (int camera = 0; camera < static_cast<int>(cameras_.size()); ++camera)
        look(utime, time, camera, ball, seen);
    }
    std::stable_sort(seen.observations.begin(), seen.observations.end(),
                     [](const auto& a, const auto& b) { return a.utime < b.utime; });
    return seen;
  }

  /// The cameras as a calibration with errors tells them.
  std::vector<model::Camera> miscalibrated() {
    std::normal_distribution<double> normal;
    const auto drawn = [&](double sigma) {
      return Eigen::Vector3d(sigma * normal(random_), sigma * normal(random_),
                             sigma * normal(random_));
    };
    std::vector<model::Camera> cameras = cameras_;
    for (model::Camera& camera : cameras) {
      vision_tracker::CameraConstants error = vision_tracker::CameraConstants::Zero();
      error.segment<3>(5) = drawn(options_.calibration.position);
      error.segment<3>(2) = drawn(options_.calibration.rotation);
      error[8] = options_.calibration.focal_length * normal(random_);
      camera = vision_tracker::displaced(camera, error);
    }
    return cameras;
  }

 private:
  void look(int64_t utime,
            double time,
            int camera,
            const model::BallState& ball,
            SeenFlight& seen) {
    std::normal_distribution<double> normal;
    std::uniform_real_distribution<double> uniform;
    const model::Camera& eye = cameras_[static_cast<std::size_t>(camera)];
    vision_tracker::Observation o;
    o.utime = utime + std::llround(1e6 * clocks_[static_cast<std::size_t>(camera)]);
    o.camera = camera;
    o.centre = vision_tracker::outlineCentre(eye, ball.p_WBall, tracker_.prior.ball_radius) +
               options_.sigma * Eigen::Vector2d(normal(random_), normal(random_));
    o.cov = options_.sigma * options_.sigma * Eigen::Matrix2d::Identity();
    seen.views.push_back({time, camera, options_.sigma});
    const double share = time / seen.made.landing.time;
    const bool hidden = share > options_.hidden_from && share < options_.hidden_to;
    const bool lost = uniform(random_) < options_.lost || hidden;
    const bool outlier = uniform(random_) < options_.outliers;
    const double u = uniform(random_), v = uniform(random_);
    if (outlier)
      o.centre += options_.outlier_size * Eigen::Vector2d(2 * u - 1, 2 * v - 1);
    if (!lost)
      seen.observations.push_back(o);
  }

  const std::vector<model::Camera>& cameras_;
  double rate_;
  const config::Experiment& experiment_;
  const vision_tracker::TrackerOptions& tracker_;
  const FlightTrialOptions& options_;
  std::mt19937 random_;
  std::vector<double> clocks_;  ///< [s], ahead of the first camera's
};

/// A start as the tracker finds it from its first images: a few centimetres and per cent wrong.
model::BallState roughly(const model::BallState& state) {
  return {state.p_WBall + Eigen::Vector3d(0.02, -0.02, 0.01), 1.03 * state.v_WBall};
}

}  // namespace

FlightTrialResult flightTrials(const std::vector<model::Camera>& cameras,
                               double rate,
                               const config::Experiment& experiment,
                               const vision_tracker::TrackerOptions& tracker,
                               const FlightTrialOptions& options) {
  Trial trial(cameras, rate, experiment, tracker, options);
  FlightTrialResult result;
  double squares = 0, bound = 0, normalised = 0;
  int inside = 0, landed = 0;
  for (int i = 0; i < options.throws; ++i) {
    const SeenFlight seen = trial.fly(i);
    const double gravity = tracker.prior.gravity;
    const auto flight =
        vision_tracker::fitFreeFlight(seen.observations, trial.miscalibrated(), tracker.prior,
                                      roughly(seen.made.release), kStart, nullptr);
    const auto landing =
        flight ? vision_tracker::landingOf(*flight, experiment.target, gravity) : std::nullopt;
    ++result.throws;
    if (!landing) {
      ++result.failures;
      continue;
    }
    ++landed;
    const Eigen::Vector2d error = landing->landing - seen.made.landing.landing;
    const double distance = error.dot(landing->cov.inverse() * error);
    squares += error.squaredNorm();
    normalised += distance;
    inside += distance < kInside95 ? 1 : 0;
    bound += landingBound(seen.made.release, seen.views, cameras, experiment.target,
                          {gravity, seen.made.drag, tracker.prior.drag_sigma,
                           tracker.prior.ball_radius, tracker.prior.clock_sigma})
                 .trace();
  }
  const double count = std::max(1, landed);
  result.rms = std::sqrt(squares / count);
  result.bound = std::sqrt(bound / count);
  result.nees = normalised / count;
  result.inside = inside / count;
  return result;
}

}  // namespace fastball::bench
