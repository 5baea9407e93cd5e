#pragma once

#include <string>
#include <vector>

#include "tests/config/temporary_folder.h"
#include "tests/system/fastball_run.h"

namespace fastball::system_test {

/// A folder for a campaign of the tests, and what is found there.
class CampaignFolder {
 public:
  /// Words of a command that works there on short set-ups of one strategy, with `more` at the end.
  std::vector<std::string> command(int throws, const std::vector<std::string>& more = {}) const;
  std::string path() const { return folder_.path() / "campaign"; }
  /// summary.json without what the wall clock says; null: there is none.
  nlohmann::json summary() const;
  /// Set-ups recorded, and all lines with a set-up: more if one was recorded again.
  int setUps() const;
  int lines() const;
  /// Waits until `count` set-ups are recorded or the run has ended.
  void awaitSetUps(const FastballRun& run, int count) const;
  /// Process ids of the parts at work on it.
  std::vector<int> parts() const;

 private:
  config::TemporaryFolder folder_;
};

}  // namespace fastball::system_test
