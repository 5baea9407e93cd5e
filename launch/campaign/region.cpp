#include "launch/campaign/region.h"

#include <fmt/format.h>

#include <cmath>
#include <random>
#include <stdexcept>

#include "planner/planner.h"

namespace fastball::launch {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kNearest = 2, kFarthest = 4;  // [m]
constexpr double kAside = kPi / 3;             // [rad]
constexpr double kHeight = 0.8;                // [m]
/// So many draws for each place wanted: more means that the arm reaches hardly anything.
constexpr int kDraws = 20;

model::Target targetAt(const Place& place, double radius) {
  const double c = std::cos(place.azimuth), s = std::sin(place.azimuth);
  return {{place.distance * c, place.distance * s, place.height}, {-c, -s, 0}, radius};
}

}  // namespace

std::vector<Place> reachablePlaces(const std::string& config, int count, int64_t seed) {
  const config::Experiment experiment = config::loadExperiment(config);
  const planner::Planner planner(planner::loadConfig(config));
  std::mt19937_64 random(static_cast<uint64_t>(seed));
  const auto draw = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  std::vector<Place> places;
  for (int drawn = 0; static_cast<int>(places.size()) < count; ++drawn) {
    if (drawn == kDraws * count)
      throw std::invalid_argument(fmt::format(
          "{}: of {} targets from {} to {} m away the planner reaches {}; {} are wanted", config,
          drawn, kNearest, kFarthest, places.size(), count));
    Place place;
    place.distance = draw(kNearest, kFarthest);
    place.azimuth = draw(-kAside, kAside);
    place.height = draw(-kHeight, kHeight);
    const planner::PlanResult result = planner.plan(
        {"robust", experiment.q_rest, targetAt(place, experiment.target.radius), seed});
    if (std::holds_alternative<planner::Plan>(result))
      places.push_back(place);
  }
  return places;
}

}  // namespace fastball::launch
