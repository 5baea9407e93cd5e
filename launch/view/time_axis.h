#pragma once

#include <cstdint>

namespace fastball::view {

/// The one time [s] of everything that a viewer sees. It begins at 0 and never goes back. Inside a scene it is simulated time, so
/// that a throw is shown as it was, however fast it was computed; between two scenes, whose simulated times have nothing to do
/// with each other, stand kBetweenScenes. Until the first state of a robot it is the time of receipt.
class TimeAxis {
 public:
  static constexpr double kBetweenScenes = 0.2;  ///< [s]
  /// [us] A state so much older than the newest is one of another run, not one that was overtaken.
  static constexpr int64_t kOvertakenUs = 500'000;

  /// Any message was received at `utime` [us].
  void receive(int64_t utime);
  /// A robot's state of simulated time `utime` [us].
  void state(int64_t scene_id, int64_t utime);
  /// Of the newest message.
  double now() const { return now_; }
  /// Of simulated time `utime` [us] in the scene that runs.
  double at(int64_t utime) const { return 1e-6 * static_cast<double>(utime) + offset_; }
  /// What is added to simulated time in the scene that runs [s].
  double offset() const { return offset_; }
  /// Counts scenes, 0: none yet.
  int64_t scenes() const { return scenes_; }

 private:
  double now_ = 0;
  double offset_ = 0;
  int64_t first_receipt_ = -1;
  int64_t scenes_ = 0;
  int64_t scene_id_ = 0;
  int64_t newest_ = 0;
};

}  // namespace fastball::view
