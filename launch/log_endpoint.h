#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "messaging/endpoint.h"

namespace fastball::launch {

/// The door to a recorded run: whoever subscribes hears from it what a log holds, whatever its age. Nothing can be said.
class LogEndpoint : public messaging::Endpoint {
 public:
  /// Hands every message of the log that decodes and breaks no rule to those who have subscribed to its channel,
  /// in the order of the file; damage is stepped over.
  /// @throw std::invalid_argument if the file cannot be read or holds no message at all.
  void play(const std::string& path);

  int drain() override { return 0; }
  const std::map<std::string, messaging::ReceiveCounts>& counts() const override { return counts_; }
  int64_t unsent() const override { return 0; }

 protected:
  bool publishErased(const char* channel,
                     std::size_t max_bytes,
                     const void* message,
                     const messaging::MessageType& type) override;
  void subscribeErased(const char* channel,
                       bool one_sender,
                       const messaging::MessageType& type,
                       std::function<void(const void*)> handler) override;

 private:
  struct Subscription {
    const messaging::MessageType* type;
    std::shared_ptr<void> message;
    std::function<void(const void*)> handler;
  };
  std::map<std::string, std::vector<Subscription>> subscriptions_;
  std::map<std::string, messaging::ReceiveCounts> counts_;
};

}  // namespace fastball::launch
