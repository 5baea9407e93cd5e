#pragma once

#include <optional>
#include <string>
#include <vector>

#include "launch/aim_filter.h"
#include "launch/results.h"
#include "launch/roster.h"
#include "launch/throw_script.h"
#include "messaging/node.h"

namespace fastball::launch {

/// Conducts the throws of a run, one after the other, by messages alone:
///
///     planning   says PLAN_REQUEST   until the plan is here and controller, hand_server and vision_tracker hold it
///     arming     says THROW_START    until controller and hand_server are armed
///     starting   says SCENE          until the scene runs
///     throwing   listens             until the scene is finished and the tracker has said LANDING
///
/// then the next throw, at the end `done`; or `failed`, with a sentence. An order is said again until it is answered. It
/// hears nothing of the truth. Wall time decides only when to repeat an order and when to give up.
class ExperimentNode : public messaging::Node {
 public:
  enum class Phase { kPlanning, kArming, kStarting, kThrowing, kDone, kFailed };

  /// `roster` hears the HEARTBEATs of the same endpoint.
  ExperimentNode(messaging::Endpoint& endpoint,
                 const messaging::Clock& clock,
                 const Roster& roster,
                 RunSettings settings);

  std::string name() const override { return "experiment"; }
  void step() override;
  int64_t wakeUs() const override;
  messaging::NodeState state() const override;
  bool finished() const override { return phase_ == Phase::kDone || phase_ == Phase::kFailed; }

  Phase phase() const { return phase_; }
  /// Why the run failed, or empty.
  const std::string& error() const { return error_; }
  /// What a process that stays from run to run has made before; call before the first step().
  void continueAfter(int64_t throws_before) { settings_.throws_before = throws_before; }
  /// Throws that are over.
  const std::vector<Throw>& throws() const { return throws_; }
  /// Wall time [s] that each of them took.
  const std::vector<double>& throwWallTimes() const { return throw_wall_s_; }
  /// What is going on, for a status line: "throw 2 of 3, swing, 1.42 s".
  std::string progress() const;

  /// Says ESTOP and fails.
  void stop(const std::string& reason);

 private:
  void hear(const swing_plan_t& plan);
  void hear(const landing_t& landing);
  void hear(const controller_status_t& status);
  /// One transition, if it is due. @return false if there is nothing to do but wait.
  bool advance();
  bool planAnswered();
  void take(const swing_plan_t& plan);
  bool sceneStarted() const;
  bool sceneFinished() const;
  void say();
  void enter(Phase phase);
  void finishThrow();
  /// The answer has not come in time.
  void giveUpWaiting();
  void fail(const std::string& sentence);
  bool anyFailed();
  /// Who does not hold the plan, who is not armed: "controller (idle), hand_server (never heard)".
  std::string withoutPlan() const;
  std::string withoutOrder() const;
  std::string missing(const std::vector<std::string>& names, const std::string& state) const;
  std::string waitingFor() const;
  void heardProgress();
  /// Strategy adaptive: the throw's landing tells where the next one would land.
  void learn();

  messaging::Endpoint& endpoint_;
  const messaging::Clock& clock_;
  const Roster& roster_;
  RunSettings settings_;
  messaging::Publisher<plan_request_t> plan_requests_;
  messaging::Publisher<throw_start_t> throw_starts_;
  messaging::Publisher<scene_t> scenes_;
  messaging::Publisher<estop_t> estops_;

  Phase phase_ = Phase::kPlanning;
  int number_ = 1;  ///< of the throw
  /// The same in messages.
  int64_t id() const { return messageNumber(settings_, number_); }
  std::optional<swing_plan_t> plan_;
  scene_t scene_{};  ///< for plan_
  std::optional<landing_t> landing_;
  controller_status_t status_{};
  AimFilter aim_;
  std::string brake_message_;
  std::string error_;
  std::vector<Throw> throws_;
  std::vector<double> throw_wall_s_;
  int64_t throw_began_us_ = 0;
  int64_t next_say_us_ = INT64_MIN;
  int64_t give_up_us_ = INT64_MAX;
};

}  // namespace fastball::launch
