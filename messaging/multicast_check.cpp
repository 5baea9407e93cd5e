#include "messaging/multicast_check.h"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <regex>
#include <stdexcept>

namespace fastball::messaging {
namespace {

class UdpSocket {
 public:
  UdpSocket() : fd_(socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0)) {}
  ~UdpSocket() {
    if (fd_ >= 0)
      close(fd_);
  }
  UdpSocket(const UdpSocket&) = delete;
  UdpSocket& operator=(const UdpSocket&) = delete;
  int fd() const { return fd_; }

 private:
  int fd_;
};

sockaddr_in address(const in_addr& host, uint16_t port) {
  sockaddr_in result{};
  result.sin_family = AF_INET;
  result.sin_addr = host;
  result.sin_port = htons(port);
  return result;
}

/// Joins the group on a port that nobody else uses, so that running experiments do not hear the
/// probe.
bool join(const UdpSocket& socket, const in_addr& group, uint16_t& port) {
  sockaddr_in any = address(in_addr{htonl(INADDR_ANY)}, 0);
  socklen_t size = sizeof(any);
  if (bind(socket.fd(), reinterpret_cast<sockaddr*>(&any), size) != 0)
    return false;
  if (getsockname(socket.fd(), reinterpret_cast<sockaddr*>(&any), &size) != 0)
    return false;
  port = ntohs(any.sin_port);
  ip_mreq membership{};
  membership.imr_multiaddr = group;
  return setsockopt(socket.fd(), IPPROTO_IP, IP_ADD_MEMBERSHIP, &membership, sizeof(membership)) ==
         0;
}

bool send(const UdpSocket& socket, const in_addr& group, uint16_t port, int ttl) {
  const auto hops = static_cast<unsigned char>(ttl);
  const sockaddr_in to = address(group, port);
  return setsockopt(socket.fd(), IPPROTO_IP, IP_MULTICAST_TTL, &hops, sizeof(hops)) == 0 &&
         connect(socket.fd(), reinterpret_cast<const sockaddr*>(&to), sizeof(to)) == 0 &&
         ::send(socket.fd(), "fastball", 8, 0) == 8;
}

bool comesBack(const UdpSocket& socket) {
  pollfd wait{socket.fd(), POLLIN, 0};
  int ready = 0;
  do {
    ready = poll(&wait, 1, 500);
  } while (ready < 0 && errno == EINTR);
  return ready > 0;
}

/// The command that gives the group a route.
std::string routeCommand(const MulticastUrl& where) {
  if (where.ttl > 0)
    return fmt::format("ip route add {}/32 dev YOUR_NETWORK_DEVICE", where.group);
  return fmt::format("ip link set lo up; ip route add {}/32 dev lo", where.group);
}

}  // namespace

std::optional<MulticastUrl> parseMulticastUrl(const std::string& url) {
  if (url.rfind("udpm://", 0) != 0)
    return std::nullopt;
  static const std::regex form(R"(udpm://([^:?/]*)(?::(\d{1,5}))?/?(\?.*)?)");
  std::smatch parts;
  const auto fail = [&](const std::string& why) {
    return std::invalid_argument(
        fmt::format("the LCM URL \"{}\" {}; expected udpm://GROUP:PORT?ttl=N", url, why));
  };
  if (!std::regex_match(url, parts, form))
    throw fail("does not parse");
  MulticastUrl result;
  if (parts[1].length() > 0)
    result.group = parts[1];
  if (parts[2].matched) {
    const int port = std::stoi(parts[2]);
    if (port < 1 || port > 65535)
      throw fail("has a port outside 1 .. 65535");
    result.port = static_cast<uint16_t>(port);
  }
  in_addr group{};
  if (inet_pton(AF_INET, result.group.c_str(), &group) != 1 || !IN_MULTICAST(ntohl(group.s_addr))) {
    throw fail("has no multicast group (224.0.0.0 to 239.255.255.255)");
  }
  const std::string query = parts[3];
  std::smatch ttl;
  if (std::regex_search(query, ttl, std::regex(R"([?&]ttl=(\d{1,3})(&|$))"))) {
    result.ttl = std::stoi(ttl[1]);
  }
  if (result.ttl > 255)
    throw fail("has a ttl above 255");
  return result;
}

void checkMulticast(const std::string& url) {
  const auto where = parseMulticastUrl(url);
  if (!where)
    return;
  in_addr group{};
  inet_pton(AF_INET, where->group.c_str(), &group);
  const UdpSocket receiver;
  const UdpSocket sender;
  uint16_t port = 0;
  if (!join(receiver, group, port) || !send(sender, group, port, where->ttl)) {
    throw std::runtime_error(fmt::format(
        "LCM has no route to its multicast group at {} ({}); as root, give it one with `{}`", url,
        std::strerror(errno), routeCommand(*where)));
  }
  if (!comesBack(receiver)) {
    throw std::runtime_error(fmt::format(
        "a datagram sent to LCM's multicast group at {} did not come back in 0.5 s; let "
        "the firewall pass UDP to {}, or give the group another route with `{}` as root",
        url, where->group, routeCommand(*where)));
  }
}

}  // namespace fastball::messaging
