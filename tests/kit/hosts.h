#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace fastball::test_kit {

/// Several machines in one test, without root: each host is a network, host name and mount
/// namespace of its own, with the address 10.67.0.1, .2, ... on a switch (a bridge) and a multicast
/// route through it. They share disk, processes and the clock; nothing of this machine's own
/// network is touched. All that runs on a host ends with this object. What cannot be done to a host
/// throws std::runtime_error.
class Hosts {
 public:
  /// Why such hosts cannot be had here, a sentence for GTEST_SKIP; empty: they can.
  static std::string whyNot();

  /// @throw std::runtime_error if they cannot be had.
  explicit Hosts(const std::vector<std::string>& names);
  ~Hosts();
  Hosts(const Hosts&) = delete;
  Hosts& operator=(const Hosts&) = delete;

  /// Where the hosts meet, for LCM.
  static std::string lcmUrl() { return "udpm://239.255.76.67:7667?ttl=1"; }
  std::string address(const std::string& host) const;

  /// Words to put in front of a command so that it runs on the host.
  std::vector<std::string> enter(const std::string& host) const;
  /// Starts a program on the host; its output goes to the test's. @return its process id.
  int start(const std::string& host, const std::vector<std::string>& command);
  /// Runs a program on the host to its end. @return its exit status; -1 if a signal ended it.
  int run(const std::string& host, const std::vector<std::string>& command) const;
  /// Calls `action` on the host's network, on a thread of its own, and waits for it: an LcmEndpoint
  /// made in it stays there. What `action` throws comes through.
  void on(const std::string& host, const std::function<void()>& action) const;
  /// Path of a program that stands in for ssh (`ADDRESS LINE`), where ADDRESS is a host's name. Its connection is no network's:
  /// it outlives a cut link.
  std::string sshStandIn() const;

  /// Pulls the host's cable out of the switch, and puts it in again.
  void cutLink(const std::string& host) const;
  void restoreLink(const std::string& host) const;
  /// Loses this share, 0 to 1, of the packets that the host would receive, by chance; 0: none any
  /// more. Needs nftables.
  void losePackets(const std::string& host, double share) const;
  /// Stops all that runs on the host, as a machine that hangs; lets it go on; ends it, as a machine without power.
  void freeze(const std::string& host) const;
  void thaw(const std::string& host) const;
  void kill(const std::string& host) const;
  /// Puts an empty disk of so many bytes on the folder `path`, on that host only.
  void mountDisk(const std::string& host, const std::string& path, int64_t bytes) const;

 private:
  struct Machine;
  const Machine& machine(const std::string& host) const;
  /// Returns when packets pass.
  void awaitLink(const std::string& host) const;
  void signalAll(const Machine& machine, int number) const;

  std::unique_ptr<Machine> switch_;
  std::map<std::string, std::unique_ptr<Machine>> machines_;
  std::string folder_;
};

}  // namespace fastball::test_kit
