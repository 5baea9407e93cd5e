#pragma once

#include <string>
#include <vector>

#include "tests/kit/hosts.h"

namespace fastball::test_kit {

/// The system's own sshd on hosts of a test, with keys and configuration of their own: nothing of the user's or of this machine's
/// is read or changed, and no root is needed. Each runs as a user "tester", who is whoever runs the test.
class SshServers {
 public:
  /// Why they cannot be had here, a sentence for GTEST_SKIP; empty: they can.
  static std::string whyNot();

  /// Returns when they answer; they end with `hosts`, which must not be gone before this object.
  /// @throw std::runtime_error if they do not.
  SshServers(Hosts& hosts, const std::vector<std::string>& names);
  ~SshServers();
  SshServers(const SshServers&) = delete;
  SshServers& operator=(const SshServers&) = delete;

  /// The ssh command up to the address, which is a host's name: for `ssh` of a system file.
  std::vector<std::string> client() const;

 private:
  std::string folder_;
};

}  // namespace fastball::test_kit
