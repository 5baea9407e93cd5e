#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "messaging/endpoint.h"
#include "messaging/node.h"
#include "messaging/process.h"
#include "sim_bullet/command_watch.h"
#include "sim_bullet/scene.h"
#include "sim_bullet/scene_cameras.h"
#include "sim_bullet/scene_messages.h"

namespace fastball::sim_bullet {

/// Everything a simulator needs to know before the first scene.
struct SimulatorSetup {
  config::Experiment experiment;
  SimulationSettings settings;
  Uncertainty uncertainty;
  /// As calibrated; none: no images, and LANDING from the light curtain.
  std::optional<CameraRigOptions> cameras;
  bool realtime = false;
};

/// Reads the experiment file and the uncertainty file of the options. @throw config::ConfigError
SimulatorSetup loadSetup(const messaging::ProcessOptions& options);

/// The simulated robot and cameras as a process of the experiment: SCENE, ARM_COMMAND and HAND_COMMAND in; ARM_STATE, HAND_STATE,
/// images, CAMERA_INFO and SIM_TRUTH out.
///
/// Lockstep: says the state of a tick and advances when it has both commands that name this scene and tick; says the state
/// again when one is 20 ms late, because UDP loses packets. Commands for anything else are left alone and counted, and
/// those of a second sender are said in the HEARTBEAT.
/// Real time: advances with the wall clock; the newest commands hold, and an arm command older than the watchdog brakes.
///
/// Its HEARTBEAT state is idle (no scene yet), running, finished (plan_id: the scene that has ended) or failed.
class SimNode : public messaging::Node {
 public:
  SimNode(messaging::Endpoint& endpoint,
          const messaging::Clock& clock,
          const SimulatorSetup& setup);

  std::string name() const override { return "sim_bullet"; }
  void step() override;
  int64_t wakeUs() const override;
  messaging::NodeState state() const override;

  /// Commands that named another scene or tick than the one waited for.
  int64_t strayCommands() const { return stray_commands_; }
  /// Those of them that a second sender must have sent.
  int64_t refusedCommands() const { return arm_watch_.refused() + hand_watch_.refused(); }
  /// The scene that runs, or null.
  const Scene* scene() const { return scene_.get(); }

 private:
  void take(const scene_t& message);
  template <class Command>
  void take(const Command& message, CommandWatch& watch, std::optional<Command>* newest);
  void begin(const scene_t& message);
  void sayLanding(const SceneEvent* landed);
  void stepLockstep();
  void stepRealtime();
  void tickRealtime();
  void say(int8_t event);
  void sayEvent(sim_truth_t message);
  /// The events of the last scene that is over.
  void repeatEvents();
  void sayStates();
  void afterTick();
  /// The command that holds through the tick; says once a scene if it asks for more than the hand can do.
  HandCommand heldCommand();
  void end(const std::string& state, const std::string& note);
  TickStamp stamp() const;
  bool running() const { return scene_ != nullptr; }

  const messaging::Endpoint& endpoint_;
  const messaging::Clock& clock_;
  SimulatorSetup setup_;

  messaging::Publisher<arm_state_t> arm_states_;
  messaging::Publisher<hand_state_t> hand_states_;
  messaging::Publisher<sim_truth_t> truths_;
  std::optional<SceneCameras> cameras_;
  std::optional<messaging::Publisher<landing_t>> landings_;  ///< where there are no images

  std::optional<scene_t> next_scene_;
  std::optional<arm_command_t> arm_command_;
  std::optional<hand_command_t> hand_command_;
  CommandWatch arm_watch_{messaging::kArmCommand.name};
  CommandWatch hand_watch_{messaging::kHandCommand.name};
  scene_t message_{};  ///< of the scene
  std::unique_ptr<Scene> scene_;
  int64_t last_tick_ = 0;
  int64_t said_us_ = 0;   ///< monotonic, lockstep: states last said
  int64_t start_us_ = 0;  ///< monotonic, real time: tick 0
  int64_t stray_commands_ = 0;
  std::vector<sim_truth_t> events_;           ///< of the scene
  std::vector<sim_truth_t> last_events_;      ///< of the one before, or of this one when it is over
  int repeats_ = 0;                           ///< of those still to come
  int64_t next_repeat_us_ = 0;                ///< monotonic
  bool braking_ = false;                      ///< real time: the watchdog has the arm
  std::optional<landing_t> curtain_landing_;  ///< of the scene, once said
  messaging::NodeState state_;
};

/// @throw config::ConfigError
std::unique_ptr<messaging::Node> makeNode(messaging::Endpoint& endpoint,
                                          const messaging::Clock& clock,
                                          const messaging::ProcessOptions& options);

}  // namespace fastball::sim_bullet
