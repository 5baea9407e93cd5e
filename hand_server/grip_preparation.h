#pragma once

#include <memory>
#include <optional>

#include "hand_server/config.h"
#include "hand_server/grip_estimate.h"
#include "hand_server/grip_settling.h"
#include "hand_server/hand_plan.h"
#include "hand_server/hand_sample.h"
#include "hand_server/opening_trial.h"
#include "model/arm.h"

namespace fastball::hand_server {

/// What the hand does and feels from the grasp to the swing: its fingers settle about the ball; for a plan that adapts
/// they try to open, if there is time; and it feels how the ball lies. Does not allocate after the first step.
class GripPreparation {
 public:
  /// @param since [us], when the fingers began to close.
  GripPreparation(std::shared_ptr<const PlannedGrasp> planned,
                  const model::Arm& arm,
                  const model::Hand& hand,
                  const model::BallParameters& ball,
                  const HandServerConfig& config,
                  int64_t since);

  /// Takes a state of the hand, dt [s] after the one before. @param t [s] of the plan, before its swing.
  void step(const HandSample& sample, double dt, double t);
  /// The swing begins, or there will be none: the fingers hold.
  void end() { trying_ = false; }
  /// From the targets of the planned grasp to those of the state at utime [us].
  void apply(int64_t utime, model::JointTargets& targets) const;

  /// As GripSettling has it.
  model::GraspGeometry settled() const { return settling_.settled(); }
  /// As hand and arm rest where the plan has the arm at t [s]. Nothing if the fingers cannot tell, or are still trying.
  std::optional<GripEstimate> estimate(double t) const;
  /// Of a plan that adapts, from 20 ms before it starts on: the first estimate that there was in them.
  const std::optional<GripEstimate>& atRest() const { return at_rest_; }
  /// How late the fingers obey; nothing if they were not tried or one did not move as it was told.
  const std::optional<DeadTimes>& deadTimes() const { return dead_times_; }

 private:
  void tryOpening(const HandSample& sample, double t);
  /// [s], from when the fingers had closed.
  double closed(int64_t utime) const;
  double trialTime(int64_t utime) const { return closed(utime) - trial_begin_; }

  std::shared_ptr<const PlannedGrasp> planned_;
  model::Arm arm_;
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
  std::optional<GripEstimate> at_rest_;
};

}  // namespace fastball::hand_server
