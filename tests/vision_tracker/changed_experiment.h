#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdio>
#include <fstream>
#include <sstream>
#include <string>

#include "tests/vision_tracker/experiment_path.h"

namespace fastball::testing {

/// The default experiment with `from` in its section `tracker` replaced by `to`, as a file beside the default one's parts.
class ChangedExperiment {
 public:
  ChangedExperiment(const std::string& from, const std::string& to) {
    std::ifstream file(experimentPath());
    std::stringstream text;
    text << file.rdbuf();
    std::string changed = text.str();
    const std::size_t place = changed.find(from, changed.find("\ntracker:"));
    if (place == std::string::npos) {
      ADD_FAILURE() << "the default experiment has no '" << from << "'";
      return;
    }
    changed.replace(place, from.size(), to);
    // What the file names lies beside it.
    const std::string folder = std::string(FASTBALL_SOURCE_DIR) + "/config/";
    for (const char* part : {"arm: ", "\nhand: ", "\nball: "}) {
      const std::size_t at = changed.find(part);
      if (at == std::string::npos)
        continue;
      changed.insert(at + std::string(part).size(), folder);
    }
    std::ofstream(path_) << changed;
  }
  ~ChangedExperiment() { std::remove(path_.c_str()); }
  ChangedExperiment(const ChangedExperiment&) = delete;
  ChangedExperiment& operator=(const ChangedExperiment&) = delete;

  const std::string& path() const { return path_; }

 private:
  std::string path_ = ::testing::TempDir() + "changed_experiment_" + std::to_string(getpid()) +
                      "_" + ::testing::UnitTest::GetInstance()->current_test_info()->name() +
                      ".yaml";
};

}  // namespace fastball::testing
