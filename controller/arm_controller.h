#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "controller/config.h"
#include "controller/control_law.h"
#include "controller/grip_correction.h"
#include "controller/plan.h"
#include "controller/stop_motion.h"

namespace fastball::controller {

/// What the arm is doing; the codes are those of ARM_COMMAND.
enum class Phase : int8_t {
  kIdle = 0,
  kApproach = 1,
  kReady = 2,
  kSwing = 3,
  kFollowThrough = 4,
  kHold = 5,
  kBrake = 6
};

/// One measured state of the arm.
struct ArmSample {
  int64_t utime = 0;  ///< [us], simulated
  int64_t scene_id = 0;
  int64_t tick = 0;                              ///< since the start of the scene
  Eigen::Vector4d q = Eigen::Vector4d::Zero();   ///< [rad]
  Eigen::Vector4d qd = Eigen::Vector4d::Zero();  ///< [rad/s]
};

/// What the drives shall do until the next state.
struct Answer {
  int64_t plan_id = 0;  ///< plan being followed, 0: none
  Phase phase = Phase::kIdle;
  Eigen::Vector4d tau = Eigen::Vector4d::Zero();  ///< [N m]
};

/// When a plan shall be run.
struct ThrowOrder {
  int64_t plan_id = 0;
  int64_t scene_id = 0;
  int64_t start_utime = 0;  ///< [us], simulated time of t = 0 of the plan
};

/// How it goes, for those who watch.
struct Status {
  Eigen::Vector4d q_error = Eigen::Vector4d::Zero();   ///< [rad], desired minus measured
  Eigen::Vector4d qd_error = Eigen::Vector4d::Zero();  ///< [rad/s]
  Eigen::Vector4d q_error_max =
      Eigen::Vector4d::Zero();  ///< [rad], largest magnitude since the swing began
  int64_t stale_states = 0;     ///< in this scene: came out of order, or after a gap
  int64_t saturations = 0;      ///< in this scene: ticks with a clipped torque
};

/// Follows one plan in each scene, and stops the arm when something is wrong. A state is answered at most once: the same
/// state again gets the same answer again and changes nothing. Between throws and before the first one the arm is held where
/// it is. Once stopped, it stays so until a new scene; an interrupted plan is not taken again.
class ArmController {
 public:
  ArmController(const model::Arm& arm,
                const model::Hand& hand,
                const model::BallParameters& ball,
                const ControllerConfig& config);

  /// Takes the plan for the next throw, instead of any held before. The same plan again changes nothing.
  /// @return false if it is refused; notice() says why.
  bool offerPlan(Plan plan);
  /// Takes no plan in place of any held before, because plan `id` cannot be followed.
  void refusePlan(int64_t id, const std::string& why);
  /// Runs the held plan in the scene named: in one to come, or from a time ahead in the present one. The same order again
  /// changes nothing.
  /// @return false if it is refused; notice() says why.
  bool startThrow(const ThrowOrder& order);
  /// The hand has felt the ball of a throw at p_HBall [m]: the arm takes up the posture that makes good what that is off its
  /// place (GripCorrection), no joint by more than `grip_correction_max`, in the first `blend_time` of the plan, and keeps to
  /// it. Changes nothing once the plan has started, for another throw, or where the swing begins sooner.
  void correctFor(int64_t plan_id, int64_t scene_id, const Eigen::Vector3d& p_HBall);
  /// Brakes to rest and drops the plan.
  void stop(const std::string& reason);
  /// Torques for a state; nothing for a state older than one already answered. Does not allocate unless it must stop.
  std::optional<Answer> answer(const ArmSample& sample);

  Phase phase() const { return phase_; }
  const Status& status() const { return status_; }
  /// Why a plan or an order was refused or the arm stopped; empty if neither.
  const std::string& notice() const { return notice_; }
  /// 0: none yet.
  int64_t scene() const { return scene_ ? *scene_ : 0; }
  /// The last plan taken or refused, 0: none.
  int64_t planId() const { return plan_id_; }
  bool refused() const { return refused_; }
  bool stopped() const { return stopped_; }
  /// A plan is held that has not been ordered yet.
  bool planned() const { return plan_ && !order_ && plan_ != run_plan_; }
  /// An order is held, and its time has not come.
  bool armed() const { return order_ || (run_plan_ && phase_ == Phase::kIdle); }
  /// The arm follows a plan.
  bool running() const { return phase_ >= Phase::kApproach && phase_ < Phase::kHold; }

 private:
  std::optional<std::string> orderFault(const ThrowOrder& order) const;
  void beginScene(const ArmSample& sample);
  void beginThrow(const ArmSample& sample);
  void checkState(const ArmSample& sample);
  void beginStop(const ArmSample& sample, const std::string& reason);
  model::ArmMotion desiredMotion(int64_t utime);
  Phase phaseAt(double t) const;
  void watchError(const model::ArmMotion& desired, const ArmSample& sample);

  model::Arm arm_;
  ControllerConfig config_;
  ControlLaw law_;
  GripCorrection grip_correction_;

  std::shared_ptr<const Plan> plan_;     ///< held for the next throw
  std::shared_ptr<const Plan> dropped_;  ///< interrupted by a stop
  std::optional<ThrowOrder> order_;      ///< of a scene that has not begun
  int64_t plan_id_ = 0;
  bool refused_ = false;
  std::string notice_;

  std::optional<int64_t> scene_;
  std::shared_ptr<const Plan> run_plan_;  ///< of this scene
  ThrowOrder run_order_;
  Eigen::Vector4d offset_ =
      Eigen::Vector4d::Zero();  ///< [rad], of the arm from the plan when it was taken up
  int64_t offset_utime_ = 0;
  Eigen::Vector4d correction_ = Eigen::Vector4d::Zero();  ///< [rad], for a ball off its place
  StopMotion stop_;
  bool stopped_ = false;       ///< this scene's motion is over
  bool stop_pending_ = false;  ///< stopped, and no state since
  Phase phase_ = Phase::kIdle;
  ArmSample last_;
  Answer answer_;  ///< to last_
  Status status_;
};

}  // namespace fastball::controller
