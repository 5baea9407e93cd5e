#include "vision_tracker/free_flight.h"

#include <Eigen/LU>
#include <algorithm>

#include "vision_tracker/flight_fit.h"
#include "vision_tracker/flight_path.h"
#include "vision_tracker/sphere_outline.h"

namespace fastball::vision_tracker {
namespace {

/// Whether the observations of one time agree with a flight that was fitted without them.
bool agrees(const std::vector<Observation>& observations,
            std::size_t first,
            std::size_t end,
            const std::vector<model::Camera>& cameras,
            const FlightPrior& prior,
            const FlightEstimate& flight) {
  constexpr double kGate =
      16;  // squared distance of two dimensions: one in 3000 true ones is refused
  FlightPath path(flight.start, flight.drag, prior.gravity, flight.lift, prior.magnus_sigma > 0);
  for (std::size_t i = first; i < end; ++i) {
    const Observation& o = observations[i];
    path.moveTo(flight.sinceStart(o.utime, o.camera));
    Eigen::Matrix<double, 2, 3> projection;
    const Eigen::Vector2d centre =
        outlineCentre(cameras[static_cast<std::size_t>(o.camera)], path.state().p_WBall,
                      prior.ball_radius, &projection);
    const Eigen::Matrix<double, 2, kFlightParameters> jacobian =
        projection * path.sensitivity().topRows<3>();
    Eigen::Matrix2d cov = flight.scale * flight.scale * o.cov +
                          jacobian * flight.cov * jacobian.transpose() +
                          prior.bias_sigma * prior.bias_sigma * Eigen::Matrix2d::Identity();
    const auto camera = static_cast<std::size_t>(o.camera);
    const double clock_sigma =
        camera < flight.clock_sigma.size() ? flight.clock_sigma[camera] : prior.clock_sigma;
    const Eigen::Vector2d late = clock_sigma * (projection * path.state().v_WBall);
    cov += late * late.transpose();
    const Eigen::Vector2d error = o.centre - centre;
    if (!(error.dot(cov.inverse() * error) < kGate))
      return false;
  }
  return true;
}

/// Index of the first observation of each moment.
std::vector<std::size_t> timesOf(const std::vector<Observation>& observations) {
  std::vector<std::size_t> times;
  for (std::size_t i = 0; i < observations.size(); ++i)
    if (times.empty() || observations[i].utime - observations[times.back()].utime > kSameMoment)
      times.push_back(i);
  return times;
}

}  // namespace

std::optional<FlightEstimate> fitFreeFlight(const std::vector<Observation>& observations,
                                            const std::vector<model::Camera>& cameras,
                                            const FlightPrior& prior,
                                            const model::BallState& guess,
                                            int64_t guess_utime,
                                            std::size_t* begin) {
  // Free-running cameras see one after the other: as many times more.
  const std::size_t each = prior.clock_sigma > 0 ? cameras.size() : 1;
  const std::size_t least_times = 10 * each;
  // Fewer bad times in a row among good ones are outliers, which the fit will cut; a hand that holds the ball leads it away
  // from the flight for good.
  const std::size_t bad_times = 4 * each;
  const std::size_t margin =
      2 * each;  // times after the first that agrees: a finger may still touch
  const std::vector<std::size_t> times = timesOf(observations);
  const auto end_of = [&](std::size_t k) {
    return k + 1 < times.size() ? times[k + 1] : observations.size();
  };
  const auto agreed = [&](std::size_t k, const FlightEstimate& flight) {
    return agrees(observations, times[k], end_of(k), cameras, prior, flight);
  };
  std::size_t first =
      times.size() - std::min(times.size(), std::max(least_times, times.size() / 2));
  std::optional<FlightEstimate> flight =
      times.empty() ? std::nullopt
                    : fitFlight(observations, times[first], cameras, prior, guess, guess_utime);
  bool ended = false;
  while (flight && first > 0 && !ended) {
    // Back by a third at most, then fit again: a fit to few predicts the past badly.
    const std::size_t reach = std::max<std::size_t>(bad_times, (times.size() - first) / 3);
    std::size_t back = first, bad = 0;
    for (std::size_t k = first; k > 0 && first - back < reach && !ended; --k) {
      if (agreed(k - 1, *flight)) {
        back = k - 1;
        bad = 0;
      } else {
        ended = ++bad == bad_times;
      }
    }
    if (back == first && !ended)
      break;
    if (ended && times.size() - back > least_times + margin)
      back += margin;
    first = back;
    flight = fitFlight(observations, times[first], cameras, prior, flight->start, flight->utime);
  }
  if (flight && begin != nullptr)
    *begin = times[first];
  return flight;
}

std::optional<FreeFlight> followFreeFlight(const std::vector<Observation>& observations,
                                           const std::vector<model::Camera>& cameras,
                                           const FlightPrior& prior,
                                           const FreeFlight& last) {
  FreeFlight next = last;
  const bool fresh = 4 * observations.size() < 5 * last.searched;
  if (fresh && agrees(observations, timesOf(observations).back(), observations.size(), cameras,
                      prior, last.flight)) {
    if (const auto flight = refitFlight(observations, last.begin, cameras, prior, last.flight)) {
      next.flight = *flight;
      return next;
    }
  }
  const auto flight = fitFreeFlight(observations, cameras, prior, last.flight.start,
                                    last.flight.utime, &next.begin);
  if (!flight)
    return std::nullopt;
  next.flight = *flight;
  next.searched = observations.size();
  return next;
}

}  // namespace fastball::vision_tracker
