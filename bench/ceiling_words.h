#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "bench/ceiling.h"

namespace fastball::bench {

/// "(3, 0, -0.5) m: 6.120 m/s, 100.0 % of the 6.120 m/s that speed limits allow; at the release speed of joint
/// 1 at 100 %, ...; 1 of 1 starts came to it"
std::string ceilingLine(const Ceiling& ceiling,
                        const model::Target& target,
                        const CeilingOptions& options);

/// The same as an object; lengths in m, times in s, velocities in m/s. What was not found is null.
nlohmann::json ceilingJson(const Ceiling& ceiling,
                           const model::Target& target,
                           const CeilingOptions& options);

}  // namespace fastball::bench
