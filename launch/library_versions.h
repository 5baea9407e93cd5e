#pragma once

#include <string>

namespace fastball::launch {

/// The libraries that this program was built with, one sentence: "LCM 1.3.1, Eigen 3.4.0, ...".
std::string libraryVersions();

}  // namespace fastball::launch
