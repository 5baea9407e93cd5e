#include "messaging/heartbeat.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "messaging/version.h"

namespace fastball::messaging {
namespace {

/// In front of the key's name in HEARTBEAT's version.
const std::string kKey = ", key ";

bool sameWords(const NodeState& a, const NodeState& b) {
  return a.state == b.state && a.detail == b.detail && a.plan_id == b.plan_id;
}

}  // namespace

std::string hostName() {
  std::array<char, kNameBytes + 1> name{};
  if (gethostname(name.data(), name.size() - 1) != 0 || name[0] == '\0')
    return "unknown";
  return name.data();
}

Heartbeat::Heartbeat(Endpoint& endpoint,
                     const Clock& clock,
                     const Node& node,
                     double period,
                     const std::string& key_id)
    : endpoint_(endpoint),
      clock_(clock),
      node_(node),
      publisher_(endpoint, kHeartbeat),
      period_us_(std::llround(period * 1e6)) {
  message_.name = node.name();
  message_.host = hostName();
  message_.pid = getpid();
  message_.version = version();
  if (!key_id.empty())
    message_.version += kKey + key_id;
}

NodeState Heartbeat::words() const {
  NodeState state = node_.state();
  for (const std::string* more : {&note_, &remark_}) {
    if (!more->empty())
      state.detail += (state.detail.empty() ? "" : "; ") + *more;
  }
  return state;
}

void Heartbeat::update(double loop_us) {
  loop_sum_us_ += loop_us;
  loop_max_us_ = std::max(loop_max_us_, loop_us);
  ++loops_;
  const int64_t now_us = clock_.monotonicUs();
  const bool due = now_us >= next_us_;
  NodeState state = words();
  if (!due && sameWords(state, said_))
    return;
  said_ = std::move(state);
  say();
  if (!due)
    return;
  next_us_ = now_us + period_us_;
  loop_sum_us_ = loop_max_us_ = 0;
  loops_ = 0;
}

void Heartbeat::sayLast(const std::string& failure) {
  said_ = words();
  if (!failure.empty())
    said_.detail = failure;
  said_.state = failure.empty() && said_.state != "failed" ? "ended" : "failed";
  say();
}

void Heartbeat::say() {
  message_.utime = clock_.wallUs();
  message_.state = shortened(said_.state, kNameBytes);
  message_.detail = shortened(said_.detail);
  message_.plan_id = said_.plan_id;
  message_.received = message_.lost = message_.invalid = 0;
  for (const auto& [channel, counts] : endpoint_.counts()) {
    if (channel != kHeartbeat.name)
      message_.received += counts.accepted;
    message_.lost += counts.lost;
    message_.invalid += counts.invalid;
  }
  message_.loop_mean_us = loops_ > 0 ? loop_sum_us_ / static_cast<double>(loops_) : 0;
  message_.loop_max_us = loop_max_us_;
  publisher_.publish(message_);
}

std::string keyIdOf(const heartbeat_t& heartbeat) {
  const auto key = heartbeat.version.rfind(kKey);
  return key == std::string::npos ? "" : heartbeat.version.substr(key + kKey.size());
}

}  // namespace fastball::messaging
