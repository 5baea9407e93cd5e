#pragma once

#include <array>
#include <optional>

#include "model/ball_parameters.h"
#include "model/finger_retreat.h"

namespace fastball::hand_server {

/// How the hand tries to open; config/experiment.yaml (hand_server.trial) has the reason of each number.
struct TrialSettings {
  double begin = 0;     ///< [s], after the fingers have closed
  double share = 0;     ///< of the ball's deformation, by which every finger gives way
  double duration = 0;  ///< [s], to give way and to close again
  double longest = 0;   ///< [s], the longest dead time that is looked for

  double length() const { return duration + longest; }
};

/// [s], from the command to a finger until it obeys: finger A, thumb, finger B.
using DeadTimes = std::array<double, model::kFingers>;

/// How late [s] fingers seem to obey whose commands arrive at once. A command holds for a tick, so
/// that on average it is half a tick old. And a finger is where its servo's stiffness kp and the
/// ball's, k r^2 at the joint's lever r, have it: of the torque told, the share
/// k r^2 / (kp + k r^2) that follows the ball's force comes with the drive's lag.
/// @param kp [N m/rad], of all joints. @param actuator_lag [s].
DeadTimes promptFingers(const model::GraspGeometry& grasp,
                        const model::BallParameters& ball,
                        const model::HandVector& kp,
                        double actuator_lag);

/// Feels how long after its command each finger obeys. While hand and arm rest, every finger gives way to the ball a little and
/// closes again,
///     w(t) = share 16 s^2 (1 - s)^2,   s = t / duration,
/// w as in FingerRetreat, and its dead time is that by which w, of any size and from any posture, comes nearest to what its proximal
/// joint did (least squares). No function allocates.
class OpeningTrial {
 public:
  OpeningTrial() = default;
  /// @param prompt [s], how late a finger seems whose commands arrive at once.
  OpeningTrial(const model::FingerRetreat& retreat,
               const TrialSettings& settings,
               const DeadTimes& prompt)
      : retreat_(retreat), settings_(settings), prompt_(prompt) {}

  /// What the fingers shall do t [s] after the trial's begin.
  void tell(double t, model::JointTargets& targets) const;
  /// Takes a posture measured t [s] after the begin.
  void feel(double t, const model::HandVector& q);
  /// [s], the delays found less `prompt`, at least 0. Nothing if a finger did not move as it was
  /// told.
  std::optional<DeadTimes> deadTimes() const;

  /// So many postures are taken; later ones count for nothing.
  static constexpr int kMostSamples = 128;

 private:
  double way(double t) const;
  double rate(double t) const;
  double likeness(model::Finger finger, double dead_time) const;

  model::FingerRetreat retreat_;
  TrialSettings settings_;
  DeadTimes prompt_{};
  int samples_ = 0;
  std::array<double, kMostSamples> t_{};                               ///< [s]
  std::array<std::array<double, kMostSamples>, model::kFingers> q_{};  ///< [rad], proximal joints
};

}  // namespace fastball::hand_server
