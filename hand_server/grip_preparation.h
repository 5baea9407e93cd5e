#pragma once

#include <optional>

#include "hand_server/config.h"
#include "hand_server/grip_estimate.h"
#include "hand_server/grip_settling.h"
#include "hand_server/hand_plan.h"
#include "hand_server/hand_sample.h"
#include "hand_server/opening_trial.h"

namespace fastball::hand_server {

/// What the hand does and feels from the grasp to the swing: its fingers settle about the ball; for a plan that adapts
/// they try to open, if there is time; and it feels how the ball lies. Does not allocate after the first step.
class GripPreparation {
 public:
  /// @param since [us], when the fingers began to close.
  GripPreparation(const PlannedGrasp& planned,
                  const model::Hand& hand,
                  const model::BallParameters& ball,
                  const HandServerConfig& config,
                  int64_t since);

  /// Takes a state of the hand, dt [s] after the one before; @param to_swing [s], until the swing begins.
  void step(const HandSample& sample, double dt, double to_swing);
  /// The swing begins, or there will be none: the fingers hold.
  void end() { trying_ = false; }
  /// From the targets of the planned grasp to those of the state at utime [us].
  void apply(int64_t utime, model::JointTargets& targets) const;

  /// As GripSettling has it.
  model::GraspGeometry settled() const { return settling_.settled(); }
  /// Nothing if the fingers cannot tell, or are still trying. @param g_H gravity [m/s^2] in the hand frame.
  std::optional<GripEstimate> estimate(const Eigen::Vector3d& g_H) const;
  /// How late the fingers obey; nothing if they were not tried or one did not move as it was told.
  const std::optional<DeadTimes>& deadTimes() const { return dead_times_; }

 private:
  void tryOpening(const HandSample& sample, double to_swing);
  /// [s], from when the fingers had closed.
  double closed(int64_t utime) const;
  double trialTime(int64_t utime) const { return closed(utime) - trial_begin_; }

  model::Hand hand_;
  model::BallParameters ball_;
  double grasp_time_ = 0, settle_time_ = 0;
  TrialSettings trial_settings_;
  model::HandVector kp_;
  int64_t since_ = 0;
  bool tries_ = false;   ///< will try to open
  bool trying_ = false;  ///< does
  double trial_begin_ = 0;
  GripSettling settling_;
  OpeningTrial trial_;
  GripFeeling feeling_;
  std::optional<DeadTimes> dead_times_;
};

}  // namespace fastball::hand_server
