#pragma once

#include <cstddef>
#include <cstring>
#include <string_view>

#include "messaging/channels.h"
#include "messaging/message_type.h"

/// What stands behind the encoded message of a command whose sender has a key (messaging/command_key.h):
///
///     bytes   what                                                      whole numbers most significant byte first
///     8       kTrailerMark
///     8       session, a random number that the sender draws when it starts
///     8       counter of the sender's commands, 1, 2, 3, ... on all channels together
///     8       wall time of the sender [us since 1970]
///     4       process id of the sender
///     16, 20  name and host of the sender, filled up with zeros
///     32      tag: BLAKE2b with the key, of the channel's name, a zero, the message and all of the above
///
/// LCM's generated decoders read a message from its front and leave this alone.
namespace fastball::messaging {

inline constexpr std::string_view kTrailerMark{"fbkey\0\0\1", 8};
inline constexpr std::size_t kTrailerNameBytes = 16;
inline constexpr std::size_t kTrailerHostBytes = 20;
inline constexpr std::size_t kTagBytes = 32;
inline constexpr std::size_t kTrailerBytes = 36 + kTrailerNameBytes + kTrailerHostBytes + kTagBytes;

/// True if the bytes end like a command with a trailer; says nothing about its tag.
inline bool hasTrailer(const void* data, std::size_t size) {
  return size >= kTrailerBytes && std::memcmp(static_cast<const char*>(data) + size - kTrailerBytes,
                                              kTrailerMark.data(), kTrailerMark.size()) == 0;
}

/// [bytes] of the message itself.
inline std::size_t withoutTrailer(const void* data, std::size_t size) {
  return hasTrailer(data, size) ? size - kTrailerBytes : size;
}

/// Decodes the message itself into `message`, which is of `type`.
/// @return false if it is not one message of that type from its first byte to its last. Any bytes
///   are safe.
inline bool decodeWithoutTrailer(const MessageType& type,
                                 void* message,
                                 const void* data,
                                 std::size_t size) {
  const int whole = static_cast<int>(withoutTrailer(data, size));
  return type.decode(message, data, whole) == whole;
}

/// True for the channels whose messages make the robot move, or decide how: those that carry a tag where a key is used. ESTOP
/// is none of them: a stop must work from anyone, also from one who has lost the key.
inline bool isCommandChannel(std::string_view channel) {
  for (const char* command : {kArmCommand.name, kHandCommand.name, kSwingPlan.name,
                              kPlanRequest.name, kThrowStart.name, kScene.name, kGrip.name}) {
    if (channel == command)
      return true;
  }
  return false;
}

}  // namespace fastball::messaging
