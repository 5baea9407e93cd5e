#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "messaging/validation.h"
#include "messaging/wire_lengths.h"

namespace fastball::messaging {

/// What a transport must know of a generated LCM type to carry it without knowing it.
struct MessageType {
  int (*encodedSize)(const void* message);
  int (*encode)(const void* message, void* buffer, int size);
  /// @return `size`, or a negative number if the bytes are not exactly one message of this type.
  /// Any bytes are safe.
  int (*decode)(void* message, const void* buffer, int size);
  std::shared_ptr<void> (*make)();
  std::shared_ptr<const void> (*copy)(const void* message);
  /// Why the message must not be acted on (not finite, out of range), or nothing.
  std::optional<std::string> (*fault)(const void* message);
  int64_t (*seq)(const void* message);
};

/// The one MessageType of the generated type T.
template <class T>
const MessageType& messageType() {
  static const MessageType type{
      [](const void* m) { return static_cast<const T*>(m)->getEncodedSize(); },
      [](const void* m, void* buffer, int size) {
        return static_cast<const T*>(m)->encode(buffer, 0, size);
      },
      [](void* m, const void* buffer, int size) {
        if (!lengthsFit<T>(buffer, size))
          return -1;
        // The generated code leaves the elements of an empty vector as they were.
        *static_cast<T*>(m) = T{};
        return static_cast<T*>(m)->decode(buffer, 0, size) == size ? size : -1;
      },
      []() -> std::shared_ptr<void> { return std::make_shared<T>(T{}); },
      [](const void* m) -> std::shared_ptr<const void> {
        return std::make_shared<T>(*static_cast<const T*>(m));
      },
      [](const void* m) { return fault(*static_cast<const T*>(m)); },
      [](const void* m) { return static_cast<const T*>(m)->seq; },
  };
  return type;
}

/// Why a sender must not send this message on this channel (it breaks its rule or the size limit),
/// or nothing.
std::optional<std::string> refusal(const char* channel,
                                   std::size_t max_bytes,
                                   const void* message,
                                   const MessageType& type);

}  // namespace fastball::messaging
