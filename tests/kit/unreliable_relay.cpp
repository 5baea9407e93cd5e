#include "tests/kit/unreliable_relay.h"

#include <poll.h>

#include <array>
#include <chrono>
#include <deque>
#include <functional>
#include <optional>
#include <random>
#include <string_view>
#include <unordered_map>
#include <utility>

#include "messaging/lcm_endpoint.h"

namespace fastball::test_kit {
namespace {

using Steady = std::chrono::steady_clock;

struct Message {
  std::string channel;
  std::string bytes;
};

/// One network of the two. It hears what it says itself and must not take that for news.
class Side {
 public:
  explicit Side(const std::string& url) : endpoint_(url) {
    endpoint_.subscribeRaw(".*", [this](const std::string& channel, const void* data,
                                        std::size_t size, int64_t /*utime*/) {
      Message message{channel, std::string(static_cast<const char*>(data), size)};
      const auto own = own_.find(fingerprint(message));
      if (own == own_.end()) {
        heard_.push_back(std::move(message));
      } else if (--own->second == 0) {
        own_.erase(own);
      }
    });
  }
  int fileDescriptor() const { return endpoint_.fileDescriptor(); }
  void say(const Message& message) {
    ++own_[fingerprint(message)];
    endpoint_.publishBytes(message.channel, message.bytes.data(), message.bytes.size());
  }
  std::deque<Message> hear() {
    endpoint_.drain();
    return std::exchange(heard_, {});
  }

 private:
  static std::size_t fingerprint(const Message& message) {
    return std::hash<std::string>{}(message.channel + '\0' + message.bytes);
  }
  messaging::LcmEndpoint endpoint_;
  std::deque<Message> heard_;
  std::unordered_map<std::size_t, int> own_;  ///< said and not yet heard
};

/// What is on its way to a side, in order.
class Cable {
 public:
  explicit Cable(double delay)
      : delay_(std::chrono::duration_cast<Steady::duration>(std::chrono::duration<double>(delay))) {
  }
  void put(const Message& message) { under_way_.emplace_back(Steady::now() + delay_, message); }
  void deliver(Side& side) {
    for (; !under_way_.empty() && under_way_.front().first <= Steady::now(); under_way_.pop_front())
      side.say(under_way_.front().second);
  }
  bool isEmpty() const { return under_way_.empty(); }

 private:
  Steady::duration delay_;
  std::deque<std::pair<Steady::time_point, Message>> under_way_;
};

}  // namespace

UnreliableRelay::UnreliableRelay(const std::string& url_a,
                                 const std::string& url_b,
                                 const Mischief& mischief)
    : thread_([=] { work(url_a, url_b, mischief); }) {}

UnreliableRelay::~UnreliableRelay() {
  end_ = true;
  thread_.join();
}

void UnreliableRelay::work(const std::string& url_a,
                           const std::string& url_b,
                           const Mischief& mischief) {
  std::array<Side, 2> sides = {Side(url_a), Side(url_b)};
  std::array<Cable, 2> cables = {Cable(mischief.delay), Cable(mischief.delay)};
  std::array<std::optional<Message>, 2> held_back;  // to the side of the same index
  std::mt19937_64 random(mischief.seed);
  const auto happens = [&random](double share) {
    return std::uniform_real_distribution<double>()(random) < share;
  };
  while (!end_) {
    std::array<pollfd, 2> waits = {pollfd{sides[0].fileDescriptor(), POLLIN, 0},
                                   pollfd{sides[1].fileDescriptor(), POLLIN, 0}};
    poll(waits.data(), waits.size(), cables[0].isEmpty() && cables[1].isEmpty() ? 20 : 1);
    for (const std::size_t from : {0, 1}) {
      const std::size_t to = 1 - from;
      for (const Message& message : sides[from].hear()) {
        if (cut_ || happens(mischief.lost)) {
          ++lost_;
          continue;
        }
        ++passed_;
        if (happens(mischief.reordered) && !held_back[to]) {
          held_back[to] = message;
          continue;
        }
        cables[to].put(message);
        if (happens(mischief.duplicated))
          cables[to].put(message);
        if (held_back[to])
          cables[to].put(*std::exchange(held_back[to], std::nullopt));
      }
      cables[to].deliver(sides[to]);
    }
  }
}

}  // namespace fastball::test_kit
