#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "model/finger_retreat.h"
#include "model/grasp.h"
#include "model/hand.h"
#include "model/joint_path.h"
#include "model/joint_targets.h"
#include "model/thumb_opening.h"

namespace fastball::model {

/// What the fingers do to let the ball go.
enum class ReleaseMode {
  kAbrupt,  ///< section 3.1: the thumb opens with all its torque, the others stay until the ball has left
  kThumbFade,   ///< the thumb's force fades out, then all open
  kSyncRetreat  ///< all retreat together in proportion to how deep they press, then all open
};
/// Their names in the configuration, in this order.
inline const std::vector<std::string> kReleaseModes = {"abrupt", "thumb_fade", "sync_retreat"};

/// How the hand holds and lets go; config/experiment.yaml (hand_server) has the reason of each number.
struct ReleaseSettings {
  ReleaseMode in_window = ReleaseMode::kSyncRetreat;  ///< for a plan with a release window
  ReleaseMode without_window = ReleaseMode::kAbrupt;  ///< for one that must hit a moment
  HandVector kp = HandVector::Zero();                 ///< [N m/rad], of the hand's servo
  HandVector kd = HandVector::Zero();                 ///< [N m s/rad]
  ThumbOpening::Settings thumb;
  double relax_time = 0.035;   ///< [s], in which force or fingers go back
  double retreat_ratio = 1.6;  ///< way of a retreating finger over how deep it presses
  double open_delay = 0.002;   ///< [s], from the end of that until all fingers open
  double open_distance = 0;    ///< [m], of the open fingers' distal axes from the z axis of H
  double clear_time = 0.04;    ///< [s], the two fingers behind the ball take to open
  double touch_force = 0.05;   ///< [N], less counts as no touch

  /// A window shorter than half the time of the relaxation is none.
  bool isWindow(double window_length) const { return window_length >= relax_time / 2; }
  ReleaseMode modeFor(double window_length) const {
    return isWindow(window_length) ? in_window : without_window;
  }
  /// [s] after the command, about when a ball of the stiffness that the grasp was computed for leaves the hand.
  double delayOf(ReleaseMode mode) const;
};

/// [N], normal: finger A, thumb, finger B.
using FingerForces = std::array<double, kFingers>;

/// How much later than the command [us] each finger is told what to do, so that all obey at once though their dead times differ.
using FingerTimes = std::array<int64_t, kFingers>;

/// The fingers' targets from the command to let go to the open hand. The retreat goes by FingerRetreat along the
/// way ratio S, S the quintic from 0 to 1 in the relaxation time; the thumb's force alone fades as (1 - S)^2. The
/// thumb, towards which the ball flies, opens as soon as one finger feels the ball no more: then no finger presses
/// on it to speak of. The others open after the relaxation. No function allocates.
class ReleaseMotion {
 public:
  ReleaseMotion() = default;
  /// @param grasp what the hand holds; its joint torques are the feed-forward.
  /// @throw std::invalid_argument if the fingers cannot open to settings.open_distance.
  ReleaseMotion(const Hand& hand,
                const GraspGeometry& grasp,
                const ReleaseSettings& settings,
                ReleaseMode mode,
                const FingerTimes& later_us = {});

  /// Targets of all finger joints for the tick that begins t_us [us] after the command; the wrist's are left alone.
  /// @param q [rad], qd [rad/s] measured; @param force [N], normal, of each finger through the last tick. Call once a tick.
  void step(int64_t t_us,
            const HandVector& q,
            const HandVector& qd,
            const FingerForces& force,
            JointTargets& targets);
  /// All fingers open from t_us [us] after the command on; later calls change nothing. The smooth modes call it themselves.
  void open(int64_t t_us);
  bool opening() const { return open_us_.has_value(); }
  ReleaseMode mode() const { return mode_; }

 private:
  /// [us], of a finger's own motion at t_us [us] after the command.
  int64_t ownTime(Finger finger, int64_t t_us) const { return t_us - later_us_[finger]; }
  bool thumbMustOpen(int64_t t_us, const FingerForces& force) const;
  void relax(Finger finger, int64_t own_us, JointTargets& targets) const;
  void follow(Finger finger, int64_t own_us, JointTargets& targets) const;
  void openThumb(int64_t t_us, const HandVector& q, const HandVector& qd, JointTargets& targets);
  bool smooth() const { return mode_ != ReleaseMode::kAbrupt; }

  ReleaseMode mode_ = ReleaseMode::kAbrupt;
  ReleaseSettings settings_;
  FingerTimes later_us_{};
  FingerRetreat retreat_;
  HandVector q_open_ = HandVector::Zero();
  ThumbOpening thumb_;
  bool thumb_opens_ = false;
  std::optional<int64_t> open_us_;  ///< in each finger's own time
  JointPath path_;                  ///< of the open fingers
};

/// Quintic from 0 at s = 0 to 1 at s = 1, at rest with no acceleration at both ends.
double smoothStep(double s);
/// d/ds of it.
double smoothStepRate(double s);

}  // namespace fastball::model
