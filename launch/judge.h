#pragma once

#include <Eigen/Core>
#include <map>
#include <optional>
#include <string>

#include "messaging/endpoint.h"

namespace fastball::launch {

/// What really happened in one scene, as the simulator knows it.
struct Truth {
  std::optional<int64_t> release_utime;  ///< [us], the last finger left the ball
  std::optional<double> release_speed;   ///< [m/s], of the ball's centre at that time
  std::optional<Eigen::Vector2d>
      landing;            ///< [m], target plane (right, up); none: never crossed it
  std::string touched;    ///< what touched the ball after its release, or empty
  bool finished = false;  ///< the scene is over and every event of it was heard
};

/// Judges the throws by SIM_TRUTH. The only listener of that channel besides the logger: it hands
/// nothing back to the experiment, it only writes into the results.
class Judge {
 public:
  explicit Judge(messaging::Endpoint& endpoint);
  Judge(const Judge&) = delete;
  Judge& operator=(const Judge&) = delete;

  /// The truth of a scene so far; empty for a scene never heard of.
  Truth of(int64_t scene_id) const;

 private:
  /// By scene and event_index: each is said several times, and any may be lost.
  std::map<int64_t, std::map<int32_t, sim_truth_t>> events_;
};

}  // namespace fastball::launch
