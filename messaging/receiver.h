#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "messaging/endpoint.h"

namespace fastball::messaging {

/// True for 1, 2, 4, 8, ...: a fault that comes with every message must not fill the log.
inline bool worthALine(int64_t count) {
  return (count & (count - 1)) == 0;
}

/// What every transport does with a checked message of one channel: number check, handlers, counts.
class Receiver {
 public:
  using Handler = std::function<void(const void*)>;

  /// `counts` must outlive the receiver.
  Receiver(std::string channel, bool one_sender, const MessageType& type, ReceiveCounts& counts)
      : channel_(std::move(channel)), one_sender_(one_sender), type_(&type), counts_(&counts) {}

  void addHandler(Handler handler) { handlers_.push_back(std::move(handler)); }
  const MessageType& type() const { return *type_; }

  /// Hands over a message that decoded and broke no rule.
  void deliver(const void* message);
  /// Counts a message that is not handed over, and says why at the 1st, 2nd, 4th, 8th, ... of them.
  void refuse(const std::string& why);
  /// The same where somebody else says why.
  void refuseSilently() { ++counts_->invalid; }

 private:
  void countGap(int64_t seq);

  std::string channel_;
  bool one_sender_;
  const MessageType* type_;
  ReceiveCounts* counts_;
  std::vector<Handler> handlers_;
  bool any_ = false;
  int64_t last_seq_ = 0;
};

/// Counts messages that could not be sent and says why at the 1st, 2nd, 4th, 8th, ... of them.
class UnsentCount {
 public:
  void add(const std::string& why);
  int64_t value() const { return value_; }

 private:
  int64_t value_ = 0;
};

}  // namespace fastball::messaging
