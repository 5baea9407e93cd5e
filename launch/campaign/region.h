#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace fastball::launch {

/// A place for the net, seen from the arm's axis; the ring faces the robot.
struct Place {
  double distance = 0;  ///< [m], horizontal
  double azimuth = 0;   ///< [rad], to the left
  double height = 0;    ///< [m], world z
};

/// `count` places drawn evenly from 2 to 4 m, -60 to 60 degrees and -0.8 to 0.8 m, each of which the planner
/// reaches with strategy `robust`. The same seed gives the same places.
/// @param config experiment file.
/// @throw std::invalid_argument if the planner reaches hardly any.
std::vector<Place> reachablePlaces(const std::string& config, int count, int64_t seed);

}  // namespace fastball::launch
