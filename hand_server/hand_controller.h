#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "hand_server/ball_watch.h"
#include "hand_server/config.h"
#include "hand_server/grip_preparation.h"
#include "hand_server/hand_plan.h"
#include "hand_server/hand_sample.h"
#include "hand_server/release_timing.h"
#include "hand_server/slip_watch.h"
#include "model/arm.h"
#include "model/hand.h"
#include "model/joint_path.h"
#include "model/release_motion.h"

namespace fastball::hand_server {

/// What the hand is doing; the codes are those of HAND_COMMAND.
enum class Phase : int8_t { kOpen = 0, kGrasp = 1, kHold = 2, kRelease = 3, kClear = 4 };

/// What the hand's servo shall do until the next state.
struct HandAnswer : model::JointTargets {
  int64_t plan_id = 0;  ///< 0: none
  Phase phase = Phase::kOpen;
};

/// When a plan shall be run.
struct ThrowOrder {
  int64_t plan_id = 0;
  int64_t scene_id = 0;
  int64_t start_utime = 0;  ///< [us], simulated time of t = 0 of the plan
};

/// That the hand was told to let go, or that the ball has left it.
struct ReleaseEvent {
  enum class Kind : int8_t { kCommanded = 0, kDeparted = 1 };
  int64_t utime = 0;  ///< [us]; kDeparted: estimated from the decaying forces
  int64_t plan_id = 0;
  Kind kind = Kind::kCommanded;
  ReleaseBy reason = ReleaseBy::kPlanTime;
  int64_t planned_utime = 0;    ///< [us], of the command or the departure, by the plan
  int64_t predicted_utime = 0;  ///< [us], of the departure, by what the hand has felt and learned
  FingerForces force{};         ///< [N]
  std::optional<GripEstimate> grip;     ///< how the ball lay in the hand before the swing
  std::optional<DeadTimes> dead_times;  ///< of the fingers, felt before the swing
};

/// The three fingers through a throw (section 3.1): open; grasp at once in the scene of an ordered throw; hold; release, in the
/// mode that the plan's release window calls for; clear, when all fingers open. A state is answered at most once: the same state
/// again gets the same answer again and changes nothing.
class HandController {
 public:
  HandController(const model::Arm& arm,
                 const model::Hand& hand,
                 const model::BallParameters& ball,
                 const HandServerConfig& config);

  /// Takes the plan for the next throw, instead of any held before. The same plan again changes nothing.
  /// @return false if it is refused; notice() says why.
  bool offerPlan(const HandPlan& plan);
  /// Takes no plan in place of any held before, because plan `id` cannot be followed.
  void refusePlan(int64_t id, const std::string& why);
  /// Runs the held plan in the scene named. The same order again changes nothing.
  /// @return false if it is refused; notice() says why.
  bool startThrow(const ThrowOrder& order);
  /// Keeps what the hand holds, until a new scene, and drops the plan. A release under way goes on.
  void keep(const std::string& reason);
  /// Where the arm is, q [rad] at utime [us]: the ball is kept if the arm does not follow the plan.
  void watchArm(int64_t scene_id, int64_t utime, const Eigen::Vector4d& q);
  /// Nothing for a state older than one already answered. Does not allocate unless something is wrong.
  std::optional<HandAnswer> answer(const HandSample& sample);
  /// What happened at the last new state, one at a time.
  std::optional<ReleaseEvent> takeEvent();
  /// How the ball lies, of a plan that adapts: in the last 20 ms before it starts, and always the same.
  std::optional<GripEstimate> gripBeforeStart() const;

  Phase phase() const { return phase_; }
  /// 0: none yet.
  int64_t scene() const { return scene_ ? *scene_ : 0; }
  /// Why a plan or an order was refused, the ball is kept, what is wrong with the grip, or that the ball was touched again; empty
  /// if nothing.
  const std::string& notice() const { return notice_; }
  /// The last plan taken or refused, 0: none.
  int64_t planId() const { return plan_id_; }
  bool refused() const { return refused_; }
  /// A plan is held that has not been ordered yet.
  bool planned() const { return next_ && !order_ && next_ != run_; }
  /// An order is held, and its time has not come.
  bool armed() const { return order_ || (run_ && !kept_ && last_.utime < run_order_.start_utime); }
  /// The arm moves, and the hand holds the ball.
  bool running() const { return run_ && !kept_ && !armed() && phase_ <= Phase::kHold; }
  bool released() const { return phase_ >= Phase::kRelease; }
  bool kept() const { return kept_; }

 private:
  std::optional<std::string> orderFault(const ThrowOrder& order) const;
  void beginScene(const HandSample& sample);
  void beginThrow(const HandSample& sample);
  void advancePhase(const HandSample& sample);
  void releaseWhenDue(const HandSample& sample);
  void beginRelease(const HandSample& sample);
  void prepareGrip(const HandSample& sample);
  void watchSlip(const HandSample& sample);
  void watchBall(const HandSample& sample);
  void command(const HandSample& sample);
  void sayDeparture(const BallWatch::Departure& departure);
  double pressure(model::Finger finger, const model::HandVector& q) const;

  model::Arm arm_;
  model::Hand hand_;
  model::BallParameters ball_;
  HandServerConfig config_;
  model::HandVector q_open_;  ///< fingers apart, wrist at zero

  std::shared_ptr<const PlannedGrasp> next_;  ///< held for the next throw
  std::optional<HandPlan> dropped_;           ///< interrupted by keep()
  std::optional<ThrowOrder> order_;           ///< of a scene that has not begun
  int64_t plan_id_ = 0;
  bool refused_ = false;
  std::string notice_;

  std::optional<int64_t> scene_;
  std::shared_ptr<const PlannedGrasp> run_;  ///< of this scene
  ThrowOrder run_order_;
  Eigen::Isometry3d X_TH_ = Eigen::Isometry3d::Identity();
  Phase phase_ = Phase::kOpen;
  bool kept_ = false;
  bool prepared_ = false;  ///< the swing has begun
  model::JointPath path_;
  std::optional<GripPreparation> preparation_;  ///< of run_
  std::optional<GripEstimate> grip_;            ///< before the swing
  model::ReleaseMotion release_;
  BallWatch ball_watch_;
  SlipWatch slip_watch_;
  ReleaseTiming timing_;  ///< of run_
  HandSample last_;
  HandAnswer answer_;  ///< to last_
  std::optional<ReleaseEvent> commanded_, departed_;
};

}  // namespace fastball::hand_server
