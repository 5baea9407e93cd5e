#include "bench/round_trip.h"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstring>
#include <functional>
#include <memory>
#include <stdexcept>
#include <thread>

#include "bench/timing.h"
#include "messaging/lcm_endpoint.h"
#include "messaging/multicast_check.h"

namespace fastball::bench {
namespace {

using Steady = std::chrono::steady_clock;

constexpr auto kPeriod = std::chrono::milliseconds(1);
constexpr int kPatienceMs = 20;
constexpr int kBlock = 250;              // trips before the other way has its turn
constexpr int kReceiveBuffer = 4194304;  // as the endpoint asks for
constexpr std::size_t kShortHeader = 8;  // of LCM's packet: magic and number

/// A way to say a state and hear its command, or the other end of it.
class Way {
 public:
  virtual ~Way() = default;
  virtual int fileDescriptor() const = 0;
  /// Robot: says state `tick`.
  virtual void say(int64_t tick) = 0;
  /// Takes what has come. Controller: and answers it. @return the newest tick heard.
  virtual int64_t hear() = 0;
};

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

/// One socket that sends to the group and hears it, its own packets included, as LCM's do. A packet is a letter (who sent it), the
/// tick, and as many bytes as LCM's packet has.
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
    char packet[2048];
    ssize_t size = 0;
    while ((size = recv(socket_, packet, sizeof(packet), MSG_DONTWAIT)) > 0) {
      if (packet[0] != (controller_ ? 'S' : 'C'))
        continue;
      std::memcpy(&tick_, packet + 1, sizeof(tick_));
      if (controller_)
        say(tick_);
    }
    return tick_;
  }

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

bool waitFor(const Way& way, int ms) {
  pollfd readable{way.fileDescriptor(), POLLIN, 0};
  return poll(&readable, 1, ms) > 0;
}

/// The controller of one way: a process that answers until it is killed.
class Controller {
 public:
  explicit Controller(const std::function<std::unique_ptr<Way>()>& make) : pid_(fork()) {
    if (pid_ != 0)
      return;
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    try {
      for (const auto way = make();;) {
        waitFor(*way, -1);
        way->hear();
      }
    } catch (const std::exception&) {
    }
    _exit(1);
  }
  ~Controller() {
    if (pid_ > 0) {
      kill(pid_, SIGKILL);
      waitpid(pid_, nullptr, 0);
    }
  }
  Controller(const Controller&) = delete;
  Controller& operator=(const Controller&) = delete;

 private:
  pid_t pid_;
};

/// One trip. @return [s], nothing if no answer came.
double trip(Way& way, int64_t tick) {
  const auto start = Steady::now();
  way.say(tick);
  while (waitFor(way, kPatienceMs)) {
    if (way.hear() == tick)
      return std::chrono::duration<double>(Steady::now() - start).count();
  }
  return -1;
}

/// `count` trips, one a millisecond.
void measure(Way& way, int count, int64_t& tick, std::vector<double>& times) {
  auto next = Steady::now();
  for (int i = 0; i < count; ++i) {
    next += kPeriod;
    std::this_thread::sleep_until(next);
    if (const double time = trip(way, ++tick); time >= 0)
      times.push_back(time);
  }
}

/// Until the controller is there.
void awaitAnswer(Way& way, int64_t& tick) {
  for (int i = 0; i < 200; ++i) {
    if (trip(way, ++tick) >= 0)
      return;
  }
  throw std::runtime_error("no answer over multicast in 4 s");
}

}  // namespace

double quantile(std::vector<double> values, double share) {
  const auto place = std::min(values.size() - 1,
                              static_cast<std::size_t>(share * static_cast<double>(values.size())));
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(place),
                   values.end());
  return values[place];
}

RoundTrips roundTrips(double seconds) {
  const std::string url = privateLcmUrl();
  messaging::MulticastUrl where = *messaging::parseMulticastUrl(url);
  ++where.port;
  const auto lcm = [&](bool is_controller) { return std::make_unique<LcmWay>(url, is_controller); };
  const auto bare = [&](bool is_controller) {
    return std::make_unique<BareWay>(where, is_controller);
  };
  // Forked before this process opens its own ends.
  const Controller lcm_controller([&] { return lcm(true); });
  const Controller bare_controller([&] { return bare(true); });
  const auto lcm_robot = lcm(false);
  const auto bare_robot = bare(false);
  int64_t tick = 0;
  awaitAnswer(*lcm_robot, tick);
  awaitAnswer(*bare_robot, tick);
  RoundTrips trips;
  const double block_s = 2 * kBlock * 1e-3;
  for (int i = 0; i < std::max(1, static_cast<int>(std::lround(seconds / block_s))); ++i) {
    measure(*lcm_robot, kBlock, tick, trips.lcm);
    measure(*bare_robot, kBlock, tick, trips.bare);
  }
  if (trips.lcm.empty() || trips.bare.empty())
    throw std::runtime_error("no answer over multicast");
  return trips;
}

}  // namespace fastball::bench
