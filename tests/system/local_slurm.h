#pragma once

#include <memory>
#include <string>
#include <vector>

#include "tests/config/temporary_folder.h"

namespace fastball::system_test {

/// Slurm on this host, by daemons of its own (munged, slurmctld, slurmd) from files that it writes to a folder of its own. Two
/// processors, however many the host has. Nothing of it is left when the object is gone.
class LocalSlurm {
 public:
  /// One sentence if it cannot be had here: a program is missing, or this is not root. Else empty.
  static std::string whyNot();
  /// Starts it and sets SLURM_CONF, so that this process and its children use it. Fails the test if the host does not become ready.
  LocalSlurm();
  ~LocalSlurm();
  LocalSlurm(const LocalSlurm&) = delete;
  LocalSlurm& operator=(const LocalSlurm&) = delete;

  /// What one of Slurm's programs says on stdout.
  std::string ask(const std::string& program, const std::vector<std::string>& words) const;

 private:
  struct Daemons;
  void writeFiles() const;
  bool ready() const;
  std::string at(const std::string& name) const { return folder_.path() / name; }
  config::TemporaryFolder folder_;
  std::unique_ptr<Daemons> daemons_;
};

}  // namespace fastball::system_test
