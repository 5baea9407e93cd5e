#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>

#include "messaging/channels.h"
#include "messaging/message_type.h"

namespace fastball::messaging {

/// What became of the messages of one channel at one receiver.
struct ReceiveCounts {
  int64_t accepted = 0;
  int64_t invalid = 0;  ///< did not decode, broke its rule, or its handler threw
  int64_t lost = 0;     ///< gaps in seq, where the channel has one sender
  int64_t repeated =
      0;  ///< seq not greater than the one before (a sender that restarted, or UDP order)
};

/// One node's door to the others: publish, subscribe, drain. LcmEndpoint goes over the network,
/// LocalNetwork's endpoints go through memory; a node cannot tell which. One thread owns an
/// endpoint. Handlers run inside drain() only.
class Endpoint {
 public:
  virtual ~Endpoint() = default;

  /// Sends a message. It is checked first: a message that breaks its rule (validation.h) or its
  /// channel's size limit is a programming error of the sender and is counted in unsent() and not
  /// sent.
  /// @return false if it was not sent.
  template <class T>
  bool publish(const Channel<T>& channel, const T& message) {
    return publishErased(channel.name, channel.max_bytes, &message, messageType<T>());
  }

  /// Calls `handler` for every message of the channel that decodes to its full length and breaks no
  /// rule, in the order of arrival. The queue is unlimited. What a handler throws is said in the
  /// log, and its message counts as invalid.
  template <class T>
  void subscribe(const Channel<T>& channel, std::function<void(const T&)> handler) {
    subscribeErased(
        channel.name, channel.one_sender, messageType<T>(),
        [handler = std::move(handler)](const void* m) { handler(*static_cast<const T*>(m)); });
  }

  /// Hands over everything that has arrived, until nothing is left.
  /// @return how many messages were handled, invalid ones included.
  virtual int drain() = 0;

  /// Inside a handler: who said the message, such as "controller (process 12 on robot)", where a key vouches for it
  /// (messaging/command_guard.h); else empty.
  virtual std::string sender() const { return ""; }

  /// Counts of each channel subscribed to.
  virtual const std::map<std::string, ReceiveCounts>& counts() const = 0;
  /// Messages that publish() could not send.
  virtual int64_t unsent() const = 0;

 protected:
  virtual bool publishErased(const char* channel,
                             std::size_t max_bytes,
                             const void* message,
                             const MessageType& type) = 0;
  virtual void subscribeErased(const char* channel,
                               bool one_sender,
                               const MessageType& type,
                               std::function<void(const void*)> handler) = 0;
};

/// Gives messages of one channel their seq: 0, 1, 2, ...
template <class T>
class Publisher {
 public:
  Publisher(Endpoint& endpoint, const Channel<T>& channel)
      : endpoint_(endpoint), channel_(channel) {}
  /// Sets message.seq and sends it. @return false if it was not sent.
  bool publish(T& message) {
    message.seq = next_seq_++;
    return endpoint_.publish(channel_, message);
  }

 private:
  Endpoint& endpoint_;
  Channel<T> channel_;
  int64_t next_seq_ = 0;
};

/// Keeps the newest message of a channel: for states and commands, where only the latest counts.
template <class T>
class Latest {
 public:
  Latest(Endpoint& endpoint, const Channel<T>& channel) {
    endpoint.subscribe<T>(channel, [this](const T& message) {
      value_ = message;
      is_new_ = true;
    });
  }
  Latest(const Latest&) = delete;
  Latest& operator=(const Latest&) = delete;
  /// The newest message, or null before the first.
  const T* get() const { return value_ ? &*value_ : nullptr; }
  /// The newest message if it has come since the last call, else null.
  const T* takeNew() {
    if (!is_new_)
      return nullptr;
    is_new_ = false;
    return &*value_;
  }

 private:
  std::optional<T> value_;
  bool is_new_ = false;
};

}  // namespace fastball::messaging
