#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace fastball::messaging {

/// Where a udpm URL leads.
struct MulticastUrl {
  std::string group = "239.255.76.67";
  uint16_t port = 7667;
  int ttl = 0;  ///< 0: this machine only, 1: this network
};

/// @return nothing if the URL has another scheme.
/// @throw std::invalid_argument if it is a udpm URL with a fault.
std::optional<MulticastUrl> parseMulticastUrl(const std::string& url);

/// LCM's own check takes 10 s to fail, and what it prints does not say what to do. So before LCM is
/// asked: does a datagram sent to the URL's group come back? Other schemes than udpm are not
/// checked.
/// @throw std::invalid_argument if the URL does not parse.
/// @throw std::runtime_error with the command that mends it if the datagram does not come back.
/// Takes at most 0.6 s.
void checkMulticast(const std::string& url);

}  // namespace fastball::messaging
