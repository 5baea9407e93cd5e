#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "lcmtypes/fastball_types.h"

/// One rule for each message: every number finite, every enumeration and length in range. A message
/// that breaks its rule is counted and dropped by the receiver, and never leaves a sender.
namespace fastball::messaging {

/// Longest name in a message (strategy, channel, state, ...) [bytes].
inline constexpr std::size_t kNameBytes = 64;
/// Longest sentence in a message (detail, reason, path, ...) [bytes]: with it, every control
/// message fits one frame.
inline constexpr std::size_t kSentenceBytes = 800;
/// Cuts a sentence at `limit` bytes, between UTF-8 characters; what is cut ends in "...".
std::string shortened(std::string sentence, std::size_t limit = kSentenceBytes);

/// @return why the message must not be acted on ("ARM_STATE: q[2] is nan"), or nothing.
std::optional<std::string> fault(const arm_state_t& message);
std::optional<std::string> fault(const arm_command_t& message);
std::optional<std::string> fault(const hand_state_t& message);
std::optional<std::string> fault(const hand_command_t& message);
std::optional<std::string> fault(const scene_t& message);
std::optional<std::string> fault(const throw_start_t& message);
std::optional<std::string> fault(const estop_t& message);
std::optional<std::string> fault(const plan_request_t& message);
std::optional<std::string> fault(const swing_plan_t& message);
std::optional<std::string> fault(const controller_status_t& message);
std::optional<std::string> fault(const grip_t& message);
std::optional<std::string> fault(const release_t& message);
std::optional<std::string> fault(const image_t& message);
std::optional<std::string> fault(const camera_info_t& message);
std::optional<std::string> fault(const sim_truth_t& message);
std::optional<std::string> fault(const ball_observation_t& message);
std::optional<std::string> fault(const ball_track_t& message);
std::optional<std::string> fault(const landing_t& message);
std::optional<std::string> fault(const logger_status_t& message);
std::optional<std::string> fault(const heartbeat_t& message);
std::optional<std::string> fault(const clock_probe_t& message);

}  // namespace fastball::messaging
