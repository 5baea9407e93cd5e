#include "messaging/local_network.h"

#include <algorithm>
#include <deque>
#include <map>
#include <utility>
#include <vector>

#include "messaging/receiver.h"

namespace fastball::messaging {
namespace {

class LocalEndpoint;

/// Who gets what is published: all endpoints of one network.
using Endpoints = std::vector<std::unique_ptr<LocalEndpoint>>;

class LocalEndpoint : public Endpoint {
 public:
  explicit LocalEndpoint(const Endpoints& all) : all_(all) {}

  int drain() override {
    int handled = 0;
    // A handler may publish to this endpoint: the inbox grows while it is emptied.
    for (; !inbox_.empty(); ++handled) {
      const Letter letter = std::move(inbox_.front());
      inbox_.pop_front();
      letter.receiver->deliver(letter.message.get());
    }
    return handled;
  }

  const std::map<std::string, ReceiveCounts>& counts() const override { return counts_; }
  int64_t unsent() const override { return unsent_.value(); }

  /// Hears no more.
  void close() {
    closed_ = true;
    inbox_.clear();
  }
  bool hasMail() const { return !inbox_.empty(); }

 protected:
  bool publishErased(const char* channel,
                     std::size_t max_bytes,
                     const void* message,
                     const MessageType& type) override;

  void subscribeErased(const char* channel,
                       bool one_sender,
                       const MessageType& type,
                       std::function<void(const void*)> handler) override {
    const auto [entry, is_new] =
        receivers_.try_emplace(channel, channel, one_sender, type, counts_[channel]);
    entry->second.addHandler(std::move(handler));
  }

 private:
  struct Letter {
    Receiver* receiver;
    std::shared_ptr<const void> message;
  };

  Receiver* receiverOf(const char* channel) {
    const auto entry = receivers_.find(channel);
    return closed_ || entry == receivers_.end() ? nullptr : &entry->second;
  }

  const Endpoints& all_;
  std::map<std::string, ReceiveCounts> counts_;
  std::map<std::string, Receiver, std::less<>> receivers_;
  std::deque<Letter> inbox_;
  UnsentCount unsent_;
  bool closed_ = false;
};

bool LocalEndpoint::publishErased(const char* channel,
                                  std::size_t max_bytes,
                                  const void* message,
                                  const MessageType& type) {
  if (const auto why = refusal(channel, max_bytes, message, type)) {
    unsent_.add(*why);
    return false;
  }
  std::shared_ptr<const void> copy;
  for (const auto& endpoint : all_) {
    Receiver* receiver = endpoint->receiverOf(channel);
    if (receiver == nullptr)
      continue;
    if (!copy)
      copy = type.copy(message);
    endpoint->inbox_.push_back({receiver, copy});
  }
  return true;
}

}  // namespace

struct LocalNetwork::Impl {
  struct Member {
    Member(Node& its_node, LocalEndpoint& its_endpoint, const Clock& clock)
        : node(its_node), endpoint(its_endpoint), heartbeat(its_endpoint, clock, its_node) {}
    Node& node;
    LocalEndpoint& endpoint;
    Heartbeat heartbeat;
    bool ended = false;
  };

  explicit Impl(const Clock& its_clock) : clock(its_clock) {}

  /// @return whether the node handled a message or wants to be stepped again at once.
  bool runOnce(Member& member) {
    if (member.ended)
      return false;
    const int64_t start_us = clock.monotonicUs();
    const int handled = member.endpoint.drain();
    member.node.step();
    member.heartbeat.update(static_cast<double>(clock.monotonicUs() - start_us));
    if (!member.node.finished()) {
      return handled > 0 || member.node.wakeUs() <= clock.monotonicUs();
    }
    member.node.shutDown();
    member.heartbeat.sayLast();
    member.endpoint.close();
    member.ended = true;
    return true;
  }

  bool isMember(const Endpoint& endpoint) const {
    return std::any_of(members.begin(), members.end(),
                       [&](const auto& member) { return &member->endpoint == &endpoint; });
  }

  /// @return whether anything moved, or waits to.
  bool round() {
    bool moved = false;
    for (const auto& member : members)
      moved = runOnce(*member) || moved;
    for (const auto& endpoint : endpoints) {
      if (!isMember(*endpoint))
        moved = endpoint->drain() > 0 || moved;
    }
    return moved || std::any_of(endpoints.begin(), endpoints.end(),
                                [](const auto& endpoint) { return endpoint->hasMail(); });
  }

  const Clock& clock;
  Endpoints endpoints;
  std::vector<std::unique_ptr<Member>> members;
};

LocalNetwork::LocalNetwork(const Clock& clock) : impl_(std::make_unique<Impl>(clock)) {}

LocalNetwork::~LocalNetwork() = default;

Endpoint& LocalNetwork::addEndpoint() {
  impl_->endpoints.push_back(std::make_unique<LocalEndpoint>(impl_->endpoints));
  return *impl_->endpoints.back();
}

void LocalNetwork::addNode(Node& node, Endpoint& endpoint) {
  // Every endpoint that a caller can have of this network is one of its own.
  auto& local = static_cast<LocalEndpoint&>(endpoint);
  impl_->members.push_back(std::make_unique<Impl::Member>(node, local, impl_->clock));
}

bool LocalNetwork::run(const std::function<bool()>& done) {
  while (!done()) {
    if (!impl_->round())
      return done();
  }
  return true;
}

int64_t LocalNetwork::nextWakeUs() const {
  int64_t next_us = INT64_MAX;
  for (const auto& member : impl_->members) {
    if (!member->ended)
      next_us = std::min(next_us, member->node.wakeUs());
  }
  return next_us;
}

}  // namespace fastball::messaging
