#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "messaging/multicast_check.h"

namespace fastball::bench {

/// A way to say a state and hear its command, or the other end of it.
class Way {
 public:
  virtual ~Way() = default;
  virtual int fileDescriptor() const = 0;
  /// Robot: says state `tick`.
  virtual void say(int64_t tick) = 0;
  /// Takes what has come. Controller: and answers it. @return the newest tick heard.
  virtual int64_t hear() = 0;
};

/// Over an LcmEndpoint.
std::unique_ptr<Way> lcmWay(const std::string& url, bool is_controller);
/// One socket that sends to the group and hears it, its own packets included, as LCM's do. Packets are as long as LCM's.
/// @throw std::runtime_error if there is no such socket; the next too.
std::unique_ptr<Way> bareWay(const messaging::MulticastUrl& where, bool is_controller);
/// The same behind a thread that reads the socket and wakes the other by a pipe: how LCM 1.3.1 receives.
std::unique_ptr<Way> pipedWay(const messaging::MulticastUrl& where, bool is_controller);

/// @return false if nothing can be read within `ms`; -1: waits for ever.
bool waitFor(int file_descriptor, int ms);

}  // namespace fastball::bench
