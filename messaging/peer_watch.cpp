#include "messaging/peer_watch.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace fastball::messaging {
namespace {

constexpr int kLooksWithinBeat = 5;

double seconds(int64_t us) {
  return static_cast<double>(us) / 1e6;
}

bool isLastWord(const std::string& state) {
  return state == "ended" || state == "failed";
}

}  // namespace

PeerWatch::PeerWatch(Endpoint& endpoint, const Clock& clock, std::string own_name, double limit)
    : clock_(clock),
      own_name_(std::move(own_name)),
      limit_us_(std::llround(limit * 1e6)),
      beat_us_(limit_us_ / kBeatsWithinLimit),
      look_us_(beat_us_ / kLooksWithinBeat),
      looked_us_(clock.monotonicUs()) {
  endpoint.subscribe<heartbeat_t>(kHeartbeat, [this](const heartbeat_t& m) { hear(m); });
}

void PeerWatch::hear(const heartbeat_t& message) {
  if (message.name == own_name_)
    return;
  if (isLastWord(message.state)) {
    is_forgotten_ = peers_.erase({message.host, message.name}) > 0 || is_forgotten_;
    return;
  }
  // Started again on another machine: nobody waits for the silent one any more.
  for (auto peer = peers_.begin(); peer != peers_.end();) {
    const auto& [host, name] = peer->first;
    const bool moved = name == message.name && host != message.host && peer->second.is_silent;
    is_forgotten_ = is_forgotten_ || moved;
    peer = moved ? peers_.erase(peer) : std::next(peer);
  }
  Peer& peer = peers_[{message.host, message.name}];
  peer.is_back = peer.is_silent;
  peer.state = message.state;
  peer.silence_us = 0;
  peer.counted_us = clock_.monotonicUs();
  if (!peer.is_silent)
    peer.heard_us = peer.counted_us;
}

void PeerWatch::count(int64_t now_us) {
  for (auto& [key, peer] : peers_) {
    peer.silence_us += std::min(now_us - peer.counted_us, beat_us_);
    peer.counted_us = now_us;
  }
}

bool PeerWatch::isOverdue(const Peer& peer) const {
  return peer.state != "planning" && peer.silence_us > limit_us_ / 2;
}

std::vector<PeerNews> PeerWatch::update() {
  const int64_t now_us = clock_.monotonicUs();
  looked_us_ = now_us;
  count(now_us);
  std::vector<PeerNews> news;
  bool is_reached = false;
  for (auto& [key, peer] : peers_) {
    // One look early, so that the limit is kept.
    is_reached = is_reached ||
                 (!peer.is_silent && isOverdue(peer) && peer.silence_us >= limit_us_ - look_us_);
    if (!std::exchange(peer.is_back, false))
      continue;
    peer.is_silent = false;
    news.push_back({{key.second},
                    false,
                    fmt::format("{} on {} is heard again, after {:.2f} s", key.second, key.first,
                                seconds(now_us - std::exchange(peer.heard_us, now_us)))});
  }
  PeerNews fallen;
  for (auto& [key, peer] : peers_) {
    // What falls silent together is said together.
    if (!is_reached || peer.is_silent || !isOverdue(peer))
      continue;
    peer.is_silent = true;
    fallen.names.push_back(key.second);
  }
  if (std::exchange(is_forgotten_, false) || !news.empty() || is_reached)
    silence_ = describe();
  if (is_reached) {
    fallen.sentence = silence_;
    news.push_back(std::move(fallen));
  }
  return news;
}

std::string PeerWatch::describe() const {
  struct Host {
    std::string silent;
    bool is_whole = true;
  };
  std::map<std::string, Host> hosts;
  int64_t longest_us = 0;
  for (const auto& [key, peer] : peers_) {
    Host& host = hosts[key.first];
    if (!peer.is_silent) {
      host.is_whole = false;
      continue;
    }
    host.silent += (host.silent.empty() ? "" : ", ") + key.second;
    longest_us = std::max(longest_us, peer.silence_us);
  }
  std::string list;
  for (const auto& [name, host] : hosts) {
    if (host.silent.empty())
      continue;
    list += list.empty() ? "" : " and ";
    list += host.is_whole ? fmt::format("{} ({})", name, host.silent)
                          : fmt::format("{} on {}", host.silent, name);
  }
  if (list.empty())
    return "";
  return fmt::format("nothing has been heard of {} for {:.2f} s (silence_limit {} s)", list,
                     seconds(longest_us), seconds(limit_us_));
}

}  // namespace fastball::messaging
