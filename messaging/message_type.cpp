#include "messaging/message_type.h"

#include <fmt/format.h>

namespace fastball::messaging {

std::optional<std::string> refusal(const char* channel,
                                   std::size_t max_bytes,
                                   const void* message,
                                   const MessageType& type) {
  // The rule first: encodedSize() of a message whose lengths disagree reads out of bounds.
  if (auto broken = type.fault(message))
    return broken;
  const auto bytes = static_cast<std::size_t>(type.encodedSize(message));
  if (bytes <= max_bytes)
    return std::nullopt;
  return fmt::format("{}: encoded size is {} bytes, above the channel's limit of {}", channel,
                     bytes, max_bytes);
}

}  // namespace fastball::messaging
