#include "vision_tracker/flight_fit.h"

#include <fmt/format.h>

#include <stdexcept>

#include "vision_tracker/flight_problem.h"

namespace fastball::vision_tracker {
namespace {

constexpr int kIterations = 15;
constexpr int kRobustIterations = 2;  // with Huber's weights, before anything is cut
constexpr std::size_t kLeastObservations = 8;

void requireFew(const std::vector<model::Camera>& cameras) {
  if (cameras.size() > model::kMostCameras)
    throw std::invalid_argument(
        fmt::format("a flight cannot be fitted to the images of {} cameras, only of one to {}",
                    cameras.size(), model::kMostCameras));
}

/// Steps until they are small. @param robust so many with Huber's weights before anything is cut
std::optional<FlightEstimate> solved(FlightProblem& problem, int robust) {
  for (int i = 0; i < kIterations; ++i) {
    if (!problem.evaluate())
      return std::nullopt;
    FlightProblem::Unknowns change;
    const bool cutting = i >= robust;
    const FlightProblem::Information information = problem.step(cutting, &change);
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

}  // namespace

std::optional<FlightEstimate> fitFlight(const std::vector<Observation>& observations,
                                        std::size_t first,
                                        const std::vector<model::Camera>& cameras,
                                        const FlightPrior& prior,
                                        const model::BallState& guess,
                                        int64_t guess_utime) {
  requireFew(cameras);
  if (observations.size() < first + kLeastObservations)
    return std::nullopt;
  FlightProblem problem(observations, first, cameras, prior);
  problem.start(
      model::fly(guess, seconds(guess_utime, problem.utime()), prior.drag, prior.gravity));
  return solved(problem, kRobustIterations);
}

std::optional<FlightEstimate> refitFlight(const std::vector<Observation>& observations,
                                          std::size_t first,
                                          const std::vector<model::Camera>& cameras,
                                          const FlightPrior& prior,
                                          const FlightEstimate& last) {
  requireFew(cameras);
  if (observations.size() < first + kLeastObservations)
    return std::nullopt;
  FlightProblem problem(observations, first, cameras, prior);
  problem.start(last);
  return solved(problem, 0);
}

}  // namespace fastball::vision_tracker
