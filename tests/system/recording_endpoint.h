#pragma once

#include <set>

#include "messaging/endpoint.h"

namespace fastball::system_test {

/// An endpoint that goes nowhere and remembers what a node asked to hear.
class RecordingEndpoint : public messaging::Endpoint {
 public:
  int drain() override { return 0; }
  const std::map<std::string, messaging::ReceiveCounts>& counts() const override { return counts_; }
  int64_t unsent() const override { return 0; }
  const std::set<std::string>& subscriptions() const { return subscriptions_; }

 protected:
  bool publishErased(const char* /*channel*/,
                     std::size_t /*max_bytes*/,
                     const void* /*message*/,
                     const messaging::MessageType& /*type*/) override {
    return true;
  }
  void subscribeErased(const char* channel,
                       bool /*one_sender*/,
                       const messaging::MessageType& /*type*/,
                       std::function<void(const void*)> /*handler*/) override {
    subscriptions_.insert(channel);
  }

 private:
  std::map<std::string, messaging::ReceiveCounts> counts_;
  std::set<std::string> subscriptions_;
};

}  // namespace fastball::system_test
