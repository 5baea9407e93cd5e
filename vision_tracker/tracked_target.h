#pragma once

#include <optional>
#include <string>
#include <vector>

#include "model/target.h"
#include "vision_tracker/eye.h"
#include "vision_tracker/flight_landing.h"
#include "vision_tracker/ring_pose.h"

namespace fastball::vision_tracker {

/// The target of a throw, as far as it is known: as it was given, or as the cameras measured it.
class TrackedTarget {
 public:
  /// @param ring how well the pose given is known, where the target is to be measured
  /// @param blur [px] of the images, standard deviation
  TrackedTarget(const FlightPrior& prior, const RingPrior& ring, double blur);

  /// Forgets what was measured of another target.
  void give(const model::Target& target);
  const model::Target& given() const { return given_; }
  /// [m], of a point from the plane of the target as it is known, in front of it positive.
  double distance(const Eigen::Vector3d& p_W) const { return known_.distance(p_W); }

  /// Looks for the target's ring in the still scene that each eye has learned.
  void measure(const std::vector<Eye>& eyes);
  /// Whether it was looked for.
  bool wasSought() const { return ring_.has_value(); }
  /// Why it was looked for and taken as given all the same; else empty.
  const std::string& note() const { return note_; }

  /// Where a flight crosses the target as it is known. @return nothing as landingOf()
  std::optional<LandingEstimate> landing(const FlightEstimate& flight) const;

 private:
  FlightPrior prior_;
  RingPrior ring_prior_;
  double blur_;
  model::Target given_, known_;
  std::optional<RingEstimate> ring_;  ///< once it was looked for
  std::string note_;
};

}  // namespace fastball::vision_tracker
