#pragma once

#include <string>

#include "launch/spy/spy_output.h"
#include "messaging/type_library.h"

namespace fastball::launch {

struct SpyOptions {
  std::string lcm_url;
  std::string channel = ".*";  ///< regular expression of the whole name
  double interval_s = 1;       ///< from one show() to the next
  double duration_s = 0;       ///< 0: until it is ended
};

/// Listens until SIGINT, SIGTERM, the end of `duration_s`, or `output` wants to end.
/// @throw what messaging::LcmEndpoint throws; std::invalid_argument if the regular expression does not parse.
void spy(const SpyOptions& options, const messaging::TypeLibrary& types, SpyOutput& output);

}  // namespace fastball::launch
