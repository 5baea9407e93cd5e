#include "bench/round_trip_ways.h"

#include <arpa/inet.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <deque>
#include <mutex>
#include <stdexcept>
#include <thread>
#include <vector>

#include "messaging/channels.h"
#include "messaging/lcm_endpoint.h"

namespace fastball::bench {
namespace {

constexpr int kReceiveBuffer = 4194304;  // as the endpoint asks for
constexpr std::size_t kShortHeader = 8;  // of LCM's packet: magic and number

class LcmWay : public Way {
 public:
  LcmWay(const std::string& url, bool is_controller)
      : endpoint_(url),
        states_(endpoint_, messaging::kArmState),
        commands_(endpoint_, messaging::kArmCommand) {
    if (is_controller) {
      endpoint_.subscribe<arm_state_t>(messaging::kArmState, [this](const arm_state_t& m) {
        tick_ = m.tick;
        arm_command_t command{};
        command.tick = m.tick;
        commands_.publish(command);
      });
    } else {
      endpoint_.subscribe<arm_command_t>(messaging::kArmCommand,
                                         [this](const arm_command_t& m) { tick_ = m.tick; });
    }
  }
  int fileDescriptor() const override { return endpoint_.fileDescriptor(); }
  void say(int64_t tick) override {
    arm_state_t state{};
    state.tick = tick;
    states_.publish(state);
  }
  int64_t hear() override {
    endpoint_.drain();
    return tick_;
  }

 private:
  messaging::LcmEndpoint endpoint_;
  messaging::Publisher<arm_state_t> states_;
  messaging::Publisher<arm_command_t> commands_;
  int64_t tick_ = -1;
};

/// One socket that sends to the group and hears it, its own packets included, as LCM's do. A packet is a letter
/// (who sent it), the tick, and as many bytes as LCM's packet has.
class BareWay : public Way {
 public:
  BareWay(const messaging::MulticastUrl& where, bool is_controller)
      : controller_(is_controller), socket_(socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0)) {
    to_.sin_family = AF_INET;
    to_.sin_port = htons(where.port);
    inet_pton(AF_INET, where.group.c_str(), &to_.sin_addr);
    const int yes = 1;
    const unsigned char ttl = 0;
    ip_mreq membership{};
    membership.imr_multiaddr = to_.sin_addr;
    const bool good = set(SOL_SOCKET, SO_REUSEADDR, yes) && set(SOL_SOCKET, SO_REUSEPORT, yes) &&
                      set(SOL_SOCKET, SO_RCVBUF, kReceiveBuffer) &&
                      set(IPPROTO_IP, IP_MULTICAST_TTL, ttl) &&
                      bind(socket_, reinterpret_cast<const sockaddr*>(&to_), sizeof(to_)) == 0 &&
                      set(IPPROTO_IP, IP_ADD_MEMBERSHIP, membership);
    if (!good)
      throw std::runtime_error(fmt::format("no multicast socket: {}", std::strerror(errno)));
  }
  ~BareWay() override { close(socket_); }
  BareWay(const BareWay&) = delete;
  BareWay& operator=(const BareWay&) = delete;

  int fileDescriptor() const override { return socket_; }
  void say(int64_t tick) override {
    if (controller_)
      send('C', tick, packetBytes<arm_command_t>(messaging::kArmCommand));
    else
      send('S', tick, packetBytes<arm_state_t>(messaging::kArmState));
  }
  int64_t hear() override {
    Packet packet;
    while (receive(packet))
      take(packet);
    return tick_;
  }

 protected:
  using Packet = std::array<char, 2048>;
  bool receive(Packet& packet) const {
    return recv(socket_, packet.data(), packet.size(), MSG_DONTWAIT) > 0;
  }
  void take(const Packet& packet) {
    if (packet[0] != (controller_ ? 'S' : 'C'))
      return;
    std::memcpy(&tick_, packet.data() + 1, sizeof(tick_));
    if (controller_)
      say(tick_);
  }
  int64_t tick() const { return tick_; }

 private:
  template <class T>
  static std::size_t packetBytes(const messaging::Channel<T>& channel) {
    return kShortHeader + std::strlen(channel.name) + 1 +
           static_cast<std::size_t>(T{}.getEncodedSize());
  }
  template <class Value>
  bool set(int level, int option, const Value& value) const {
    return setsockopt(socket_, level, option, &value, sizeof(value)) == 0;
  }
  void send(char from, int64_t tick, std::size_t size) const {
    std::vector<char> packet(size, from);
    std::memcpy(packet.data() + 1, &tick, sizeof(tick));
    sendto(socket_, packet.data(), packet.size(), 0, reinterpret_cast<const sockaddr*>(&to_),
           sizeof(to_));
  }

  bool controller_;
  int socket_;
  sockaddr_in to_{};
  int64_t tick_ = -1;
};

/// The same behind a thread that reads the socket and wakes the other by a pipe: how LCM 1.3.1 receives.
class PipedWay : public BareWay {
 public:
  PipedWay(const messaging::MulticastUrl& where, bool is_controller)
      : BareWay(where, is_controller) {
    if (pipe2(pipe_.data(), O_CLOEXEC) != 0)
      throw std::runtime_error(fmt::format("no pipe: {}", std::strerror(errno)));
    reader_ = std::thread([this] { read(); });
  }
  ~PipedWay() override {
    end_ = true;
    reader_.join();
    for (const int end : pipe_)
      close(end);
  }

  int fileDescriptor() const override { return pipe_[0]; }
  int64_t hear() override {
    char token = 0;
    while (waitFor(pipe_[0], 0) && ::read(pipe_[0], &token, 1) == 1) {
      Packet packet;
      {
        const std::lock_guard lock(mutex_);
        packet = packets_.front();
        packets_.pop_front();
      }
      take(packet);
    }
    return tick();
  }

 private:
  void read() {
    Packet packet;
    while (!end_) {
      if (!waitFor(BareWay::fileDescriptor(), 50) || !receive(packet))
        continue;
      {
        const std::lock_guard lock(mutex_);
        packets_.push_back(packet);
      }
      if (write(pipe_[1], "+", 1) != 1)
        return;
    }
  }

  std::array<int, 2> pipe_{};
  std::mutex mutex_;
  std::deque<Packet> packets_;
  std::atomic<bool> end_{false};
  std::thread reader_;
};

}  // namespace

std::unique_ptr<Way> lcmWay(const std::string& url, bool is_controller) {
  return std::make_unique<LcmWay>(url, is_controller);
}

std::unique_ptr<Way> bareWay(const messaging::MulticastUrl& where, bool is_controller) {
  return std::make_unique<BareWay>(where, is_controller);
}

std::unique_ptr<Way> pipedWay(const messaging::MulticastUrl& where, bool is_controller) {
  return std::make_unique<PipedWay>(where, is_controller);
}

bool waitFor(int file_descriptor, int ms) {
  pollfd readable{file_descriptor, POLLIN, 0};
  return poll(&readable, 1, ms) > 0;
}

}  // namespace fastball::bench
