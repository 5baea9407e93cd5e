#include "launch/doctor/network_checks.h"

#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>

#include "messaging/channels.h"
#include "messaging/clock.h"
#include "messaging/clock_survey.h"
#include "messaging/lcm_endpoint.h"
#include "messaging/multicast_check.h"

namespace fastball::launch {
namespace {

using Steady = std::chrono::steady_clock;

constexpr int64_t kWantedBuffer = 4194304;  // [bytes], as every URL of ours asks for
constexpr int kRounds = 200;
constexpr double kPatience = 1;         // [s], for a message to ourselves
constexpr double kSlowRound = 2e-3;     // [s], of the worst: two ticks
constexpr double kHeartbeatTime = 1.2;  // [s], HEARTBEAT comes once a second
constexpr auto kAskInterval = std::chrono::milliseconds(100);
constexpr double kClockOff = 5e-3;     // [s]: a ball of 6 m/s moves 3 cm
constexpr std::size_t kImage = 60000;  // [bytes], the largest message
constexpr std::size_t kPacket = 1400;  // [bytes], that go through any network in one piece
constexpr const char* kChannel = "DOCTOR";

messaging::MulticastUrl parse(const std::string& text) {
  const auto url = messaging::parseMulticastUrl(text);
  if (!url)
    throw std::invalid_argument(fmt::format("the URL '{}' is not udpm://GROUP:PORT?ttl=N", text));
  return *url;
}

/// The same group on a port that no experiment is on.
std::string privateUrl(const std::string& lcm_url) {
  return fmt::format("udpm://{}:{}?ttl=0", parse(lcm_url).group, 40000 + getpid() % 20000);
}

struct ClosePipe {
  void operator()(std::FILE* pipe) const { pclose(pipe); }
};

/// Name of the device through which packets to the group leave; empty: there is no route.
std::string deviceTo(const messaging::MulticastUrl& url) {
  const std::string command = fmt::format("ip -j route get {} 2>/dev/null", url.group);
  const std::unique_ptr<std::FILE, ClosePipe> pipe(popen(command.c_str(), "r"));
  if (!pipe)
    return "";
  const nlohmann::json routes = nlohmann::json::parse(pipe.get(), nullptr, false);
  const bool found = routes.is_array() && !routes.empty() && routes[0].contains("dev");
  return found ? routes[0]["dev"].get<std::string>() : "";
}

/// Hears what it says itself.
class Echo {
 public:
  explicit Echo(const std::string& url) : endpoint_(url) {
    endpoint_.subscribeRaw(kChannel, [this](const std::string&, const void*, std::size_t size,
                                            int64_t) { heard_ += static_cast<int64_t>(size); });
  }
  bool send(std::size_t size) {
    const std::vector<char> bytes(size);
    return endpoint_.publishBytes(kChannel, bytes.data(), bytes.size());
  }
  /// Waits until so many bytes have come, at most `timeout` [s] after the last that did.
  bool await(int64_t bytes, double timeout) {
    auto last = Steady::now();
    for (int64_t before = heard_; heard_ < bytes; before = heard_) {
      pollfd wait{endpoint_.fileDescriptor(), POLLIN, 0};
      poll(&wait, 1, 20);
      endpoint_.drain();
      if (heard_ > before)
        last = Steady::now();
      else if (Steady::now() - last > std::chrono::duration<double>(timeout))
        return false;
    }
    return true;
  }
  int64_t heard() const { return heard_; }

 private:
  messaging::LcmEndpoint endpoint_;
  int64_t heard_ = 0;
};

Finding roundTrip(const std::string& url, std::size_t size) {
  Echo echo(url);
  std::vector<double> times;
  for (int i = 0; i < kRounds; ++i) {
    const int64_t wanted = echo.heard() + static_cast<int64_t>(size);
    const auto start = Steady::now();
    if (!echo.send(size) || !echo.await(wanted, kPatience))
      break;
    times.push_back(std::chrono::duration<double>(Steady::now() - start).count());
  }
  Finding finding;
  finding.what = fmt::format("round trip of {} bytes", size);
  if (times.size() < kRounds) {
    finding.verdict = Verdict::kBad;
    finding.value = fmt::format("message {} of {} did not come back", times.size() + 1, kRounds);
    finding.mend = size > kPacket ? "sudo sysctl -w net.ipv4.ipfrag_high_thresh=26214400"
                                  : "sudo nft list ruleset   # a firewall may drop UDP";
    return finding;
  }
  std::sort(times.begin(), times.end());
  finding.value = fmt::format("{:.0f} us in the middle, {:.0f} us at most",
                              times[kRounds / 2] * 1e6, times.back() * 1e6);
  if (times.back() > kSlowRound)
    finding.verdict = Verdict::kRemark;
  return finding;
}

Finding clockFinding(const std::string& host, const messaging::HostClock& measured) {
  Finding clock{"clock of " + host, Verdict::kGood,
                fmt::format("{:+.2f} ms from ours, to {:.2f} ms, by {} questions and answers",
                            measured.offset * 1e3, measured.error * 1e3, measured.answers),
                ""};
  if (std::abs(measured.offset) - measured.error > kClockOff) {
    clock.verdict = Verdict::kBad;
    clock.value += fmt::format(", {} ms are allowed", kClockOff * 1e3);
    clock.mend = "sudo apt install chrony   # on both, with one server";
  }
  return clock;
}

}  // namespace

Findings checkRoute(const std::string& lcm_url) {
  const messaging::MulticastUrl url = parse(lcm_url);
  const std::string device = deviceTo(url);
  Finding route{"route", Verdict::kGood, "", ""};
  if (device.empty()) {
    route.verdict = Verdict::kBad;
    route.value = fmt::format("there is none to {}", url.group);
    route.mend = fmt::format(
        "sudo ip route add {}/32 dev lo   # or another device than lo, for several machines",
        url.group);
    return {route};
  }
  route.value = fmt::format("{} through {}", url.group, device);
  Finding reach{"reach", Verdict::kGood, "", ""};
  reach.value = url.ttl == 0 ? "ttl=0: messages stay on this machine"
                             : fmt::format("ttl={}: messages leave this machine", url.ttl);
  if (url.ttl > 0 && device == "lo") {
    reach.verdict = Verdict::kBad;
    reach.value += ", but the route is through lo, which leads nowhere";
    reach.mend = fmt::format(
        "sudo ip route replace {}/32 dev eth0   # the device of the experiment's network",
        url.group);
  }
  return {route, reach};
}

Findings checkRoundTrip(const std::string& lcm_url) {
  const std::string url = privateUrl(lcm_url);
  return {roundTrip(url, 100), roundTrip(url, 1400), roundTrip(url, kImage)};
}

Findings checkReceiveBuffer(const std::string& lcm_url) {
  int64_t limit = 0;
  std::ifstream("/proc/sys/net/core/rmem_max") >> limit;
  const std::string mend = fmt::format(
      "sudo sysctl -w net.core.rmem_max={0}   # to stay: echo net.core.rmem_max={0} | sudo tee "
      "/etc/sysctl.d/60-lcm.conf",
      kWantedBuffer);
  Finding allowed{"receive buffer", Verdict::kGood, fmt::format("net.core.rmem_max is {}", limit),
                  ""};
  if (limit < kWantedBuffer) {
    allowed.verdict = Verdict::kBad;
    allowed.value += fmt::format(", {} are wanted", kWantedBuffer);
    allowed.mend = mend;
  }
  // LCM's own thread empties the buffer into memory, so a burst shows what both together bear.
  Echo echo(privateUrl(lcm_url));
  constexpr int kBurst = 200;
  int sent = 0;
  for (int i = 0; i < kBurst; ++i)
    sent += echo.send(kImage) ? 1 : 0;
  const bool all = echo.await(int64_t{kImage} * sent, 0.2);
  const int64_t lost = sent - echo.heard() / static_cast<int64_t>(kImage);
  Finding burst{"burst", Verdict::kGood,
                fmt::format("{} images of 60 kB said at once, {}", sent,
                            all ? "none lost" : fmt::format("{} lost", lost)),
                ""};
  if (!all) {
    burst.verdict = limit < kWantedBuffer ? Verdict::kBad : Verdict::kRemark;
    burst.mend = limit < kWantedBuffer ? mend : "";
  }
  return {allowed, burst};
}

Findings checkOthers(const std::string& lcm_url) {
  messaging::LcmEndpoint endpoint(lcm_url);
  const messaging::SystemClock clock;
  messaging::ClockSurvey survey(endpoint, clock);
  std::set<std::string> processes, hosts;
  endpoint.subscribe<heartbeat_t>(messaging::kHeartbeat, [&](const heartbeat_t& m) {
    processes.insert(fmt::format("{} ({}, process {})", m.name, m.host, m.pid));
    hosts.insert(m.host);
  });
  const auto start = Steady::now();
  for (auto next = start; Steady::now() - start < std::chrono::duration<double>(kHeartbeatTime);) {
    if (Steady::now() >= next) {
      survey.ask();
      next += kAskInterval;
    }
    pollfd wait{endpoint.fileDescriptor(), POLLIN, 0};
    poll(&wait, 1, 20);
    endpoint.drain();
  }
  Findings findings;
  for (const std::string& name : processes)
    findings.push_back({"heard", Verdict::kGood, name, ""});
  if (processes.empty())
    findings.push_back({"heard", Verdict::kGood, "nobody else on " + endpoint.url(), ""});
  for (const std::string& host : hosts) {
    const auto answer = survey.clocks().find(host);
    if (answer == survey.clocks().end())
      findings.push_back({"clock of " + host, Verdict::kRemark, "it does not answer on CLOCK", ""});
    else
      findings.push_back(clockFinding(host, answer->second));
  }
  return findings;
}

}  // namespace fastball::launch
