#pragma once

#include <string>

namespace fastball::testing {

/// The default experiment file of the source tree.
inline std::string experimentPath() {
  return std::string(FASTBALL_SOURCE_DIR) + "/config/experiment.yaml";
}

}  // namespace fastball::testing
