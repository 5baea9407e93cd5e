#pragma once

#include <functional>
#include <memory>
#include <string>

#include "messaging/heartbeat.h"
#include "messaging/lcm_endpoint.h"
#include "messaging/node.h"
#include "tests/fuzz/conversation.h"

namespace fastball::fuzz {

/// A node behind the real LcmEndpoint, on LCM's transport through memory. It lives on from input to input, as a process does,
/// and is made anew now and then. Ends the program where a process would end, and where the node says what breaks a rule.
class NodeTarget {
 public:
  using Make = std::function<std::unique_ptr<messaging::Node>(messaging::LcmEndpoint&,
                                                              const messaging::Clock&)>;
  /// @param name of the target in channelsOf(): the node must hear just these.
  /// @param lifetime of a node [inputs].
  NodeTarget(std::string name, int lifetime, Make make);
  ~NodeTarget();

  void hear(const uint8_t* data, std::size_t size);

 private:
  void renew();
  void step();

  struct Life;
  const std::string name_;
  const int lifetime_;
  const Make make_;
  int age_ = 0;
  std::unique_ptr<Life> life_;
};

/// Prints the sentence and ends the program as a crash does.
[[noreturn]] void die(const std::string& sentence);

/// The experiment file of this source tree.
std::string experimentPath();

}  // namespace fastball::fuzz
