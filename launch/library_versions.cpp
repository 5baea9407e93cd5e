#include "launch/library_versions.h"

#include <LinearMath/btScalar.h>
#include <fmt/format.h>
#include <nlopt.h>
#include <sodium.h>
#include <spdlog/version.h>

#include <CLI/Version.hpp>
#include <Eigen/Core>
#include <boost/version.hpp>
#include <nlohmann/json.hpp>
#include <opencv2/core/version.hpp>

namespace fastball::launch {

std::string libraryVersions() {
  int major = 0, minor = 0, patch = 0;
  nlopt_version(&major, &minor, &patch);
  return fmt::format(
      "LCM {}, Eigen {}.{}.{}, Bullet {}.{:02} (float64), OpenCV {}, NLopt {}.{}.{}, "
      "libsodium {}, Boost {}.{}, nlohmann-json {}.{}.{}, CLI11 {}, fmt {}.{}.{}, spdlog {}.{}.{}; "
      "compiler {}",
      FASTBALL_LCM_VERSION, EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION,
      BT_BULLET_VERSION / 100, BT_BULLET_VERSION % 100, CV_VERSION, major, minor, patch,
      sodium_version_string(), BOOST_VERSION / 100000, BOOST_VERSION / 100 % 1000,
      NLOHMANN_JSON_VERSION_MAJOR, NLOHMANN_JSON_VERSION_MINOR, NLOHMANN_JSON_VERSION_PATCH,
      CLI11_VERSION, FMT_VERSION / 10000, FMT_VERSION / 100 % 100, FMT_VERSION % 100,
      SPDLOG_VER_MAJOR, SPDLOG_VER_MINOR, SPDLOG_VER_PATCH, __VERSION__);
}

}  // namespace fastball::launch
