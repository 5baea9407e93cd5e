#pragma once

#include <cstddef>

#include "lcmtypes/fastball_types.h"

/// Every channel of the experiment with its message type and its limit in bytes.
namespace fastball::messaging {

/// A control message must fit one Ethernet frame: a lost fragment would lose the whole of a larger
/// one.
inline constexpr std::size_t kControlBytes = 1400;
/// Images and plans must fit one UDP datagram.
inline constexpr std::size_t kDatagramBytes = 60000;

/// A channel and what is said on it. Cameras beside these have channels of their own
/// (image_channel.h).
template <class T>
struct Channel {
  const char* name;
  std::size_t max_bytes;  ///< of an encoded message, a command's trailer included
  /// True where one sender numbers all messages, so that a gap in seq is a lost message.
  bool one_sender = true;
};

inline constexpr Channel<arm_state_t> kArmState{"ARM_STATE", kControlBytes};
inline constexpr Channel<arm_command_t> kArmCommand{"ARM_COMMAND", kControlBytes};
inline constexpr Channel<hand_state_t> kHandState{"HAND_STATE", kControlBytes};
inline constexpr Channel<hand_command_t> kHandCommand{"HAND_COMMAND", kControlBytes};
inline constexpr Channel<scene_t> kScene{"SCENE", kControlBytes};
inline constexpr Channel<throw_start_t> kThrowStart{"THROW_START", kControlBytes};
inline constexpr Channel<estop_t> kEstop{"ESTOP", kControlBytes, false};
inline constexpr Channel<plan_request_t> kPlanRequest{"PLAN_REQUEST", kControlBytes};
inline constexpr Channel<swing_plan_t> kSwingPlan{"SWING_PLAN", kDatagramBytes};
inline constexpr Channel<controller_status_t> kControllerStatus{"CONTROLLER_STATUS", kControlBytes};
inline constexpr Channel<grip_t> kGrip{"GRIP", kControlBytes};
inline constexpr Channel<release_t> kRelease{"RELEASE", kControlBytes};
inline constexpr Channel<image_t> kCameraLeft{"CAMERA_LEFT", kDatagramBytes + 100};
inline constexpr Channel<image_t> kCameraRight{"CAMERA_RIGHT", kDatagramBytes + 100};
inline constexpr Channel<camera_info_t> kCameraInfo{"CAMERA_INFO", kControlBytes, false};
inline constexpr Channel<sim_truth_t> kSimTruth{"SIM_TRUTH", kControlBytes};
inline constexpr Channel<ball_observation_t> kBallObservation{"BALL_OBSERVATION", kControlBytes};
inline constexpr Channel<ball_track_t> kBallTrack{"BALL_TRACK", kControlBytes};
inline constexpr Channel<landing_t> kLanding{"LANDING", kControlBytes};
inline constexpr Channel<logger_status_t> kLoggerStatus{"LOGGER_STATUS", kControlBytes};
inline constexpr Channel<clock_probe_t> kClock{"CLOCK", kControlBytes, false};
inline constexpr Channel<heartbeat_t> kHeartbeat{"HEARTBEAT", kControlBytes, false};

}  // namespace fastball::messaging
