#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "model/release_motion.h"

namespace fastball::hand_server {

using model::FingerForces;

/// What the hand knows of its force sensors and of the touch of a ball.
struct TouchSettings {
  double touch_force = 0;  ///< [N], a reading of less counts as no touch
  double quiet_time = 0;   ///< [s] without touch: the ball has left
  double noise = 0;        ///< [N], standard deviation of a reading
  double delay = 0;        ///< [s], from a force to its reading
};

/// Feels by the finger forces when the ball leaves the hand, and whether it touches it again. A force is the mean over the tick
/// before its state, less the sensors' delay. No function allocates.
class BallWatch {
 public:
  BallWatch() = default;
  explicit BallWatch(const TouchSettings& settings)
      : settings_(settings), quiet_us_(static_cast<int64_t>(settings.quiet_time * 1e6)) {}

  struct Departure {
    int64_t utime = 0;       ///< [us], estimated: the last finger's force went to nothing
    int64_t last_touch = 0;  ///< [us], of the last state with a touch
    FingerForces force{};    ///< [N], of that state
  };
  /// Call once a tick. Once, when a ball that was held has not been touched for the quiet time, says since when.
  std::optional<Departure> step(int64_t utime, const FingerForces& force);
  bool departed() const { return departure_.has_value(); }
  /// Once, when a finger feels the ball after it has departed: which. Call after step().
  std::optional<model::Finger> touchedAgain(const FingerForces& force);
  /// Only of a ball that has departed.
  const Departure& departure() const { return *departure_; }

 private:
  static constexpr std::size_t kKept = 32;  ///< states, more than the longest quiet time has
  struct State {
    int64_t utime = 0;
    FingerForces force{};
  };
  /// The state `age` ticks before the newest.
  const State& past(std::size_t age) const {
    return states_[(newest_ + kKept - age % kKept) % kKept];
  }
  void feel();
  Departure estimate() const;

  TouchSettings settings_;
  int64_t quiet_us_ = 0;
  std::array<State, kKept> states_{};
  std::size_t newest_ = 0;
  std::array<std::optional<std::size_t>, model::kFingers> quiet_ticks_;  ///< since its last touch
  std::optional<Departure> departure_;
  bool touched_again_ = false;
};

}  // namespace fastball::hand_server
