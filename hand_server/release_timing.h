#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <memory>
#include <optional>

#include "hand_server/config.h"
#include "hand_server/hand_plan.h"
#include "hand_server/opening_trial.h"
#include "hand_server/release_condition.h"
#include "hand_server/release_delay.h"
#include "model/arm.h"
#include "model/release_motion.h"

namespace fastball::hand_server {

/// When the hand is told to let go, and when the ball should leave it by that: at the time that the plan names, earlier by the
/// dead times that the fingers have shown, and, for a plan that adapts, shifted by what the throws before have taught; or when
/// Eq. (24) says so. Before the first beginThrow() only the constructor may be called. No function allocates.
class ReleaseTiming {
 public:
  enum class Decision {
    kWait,
    kRelease,
    kMissed  ///< the hand did not stop pushing (Eq. 24) near the planned release
  };

  /// @param p_HBall [m], ball centre in the hand.
  ReleaseTiming(const model::Arm& arm,
                const Eigen::Vector3d& p_HBall,
                const HandServerConfig& config);

  /// Forgets the throw before, but not what it has taught.
  /// @param start_utime [us], of t = 0 of the plan; @param X_TH pose of the hand in the tool frame.
  void beginThrow(std::shared_ptr<const PlannedGrasp> run,
                  int64_t start_utime,
                  const Eigen::Isometry3d& X_TH);
  /// The fingers' dead times as far as they are known; the last ones before the swing count.
  void feel(const std::optional<DeadTimes>& dead_times) { dead_times_ = dead_times; }
  /// Call once a tick until the release, utime [us] of the state.
  Decision decide(int64_t utime);
  /// The hand is told to let go at utime [us].
  void command(int64_t utime);
  /// The ball of the command left at utime [us].
  void learn(int64_t departure_utime);

  /// [s], of the plan, at utime [us].
  double planTime(int64_t utime) const;
  model::ReleaseMode mode() const { return config_.release.modeFor(run_->plan.window); }
  const std::optional<DeadTimes>& deadTimes() const { return dead_times_; }
  /// All fingers shall obey when the last one does.
  model::FingerTimes fingerTimes() const;
  /// [us], by the plan.
  int64_t plannedCommand() const;
  int64_t plannedDeparture() const;
  /// [us]; 0 before the first command.
  int64_t commanded() const { return commanded_utime_; }
  /// [us], of the ball's departure, by the command, the dead times and what the hand has learned.
  int64_t predictedDeparture() const { return predicted_utime_; }

 private:
  Decision decideByForce(double t);
  double deadTime() const;
  double plannedDelay() const;

  model::Arm arm_;
  Eigen::Vector3d p_HBall_;
  HandServerConfig config_;

  std::shared_ptr<const PlannedGrasp> run_;
  int64_t start_utime_ = 0;
  Eigen::Isometry3d X_TH_ = Eigen::Isometry3d::Identity();
  PushEnd push_end_;
  std::optional<DeadTimes> dead_times_;
  int64_t commanded_utime_ = 0, predicted_utime_ = 0;
  ReleaseDelay delay_;  ///< over all throws
};

}  // namespace fastball::hand_server
