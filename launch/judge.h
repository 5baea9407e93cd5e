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
  bool finished = false;  ///< the scene is over, nothing more will come
};

/// Judges the throws by SIM_TRUTH. The only listener of that channel besides the logger: it hands
/// nothing back to the experiment, it only writes into the results.
class Judge {
 public:
  explicit Judge(messaging::Endpoint& endpoint);
  Judge(const Judge&) = delete;
  Judge& operator=(const Judge&) = delete;

  /// The truth of a scene so far; empty for a scene never heard of.
  const Truth& of(int64_t scene_id) { return truths_[scene_id]; }

 private:
  void hear(const sim_truth_t& message);
  std::map<int64_t, Truth> truths_;
};

}  // namespace fastball::launch
