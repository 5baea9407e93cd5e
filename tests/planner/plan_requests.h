#pragma once

#include <algorithm>
#include <vector>

#include "lcmtypes/fastball_types.h"
#include "tests/planner/default_throw.h"

namespace fastball::planner {

/// PLAN_REQUEST for the default throw.
inline plan_request_t requestMessage(const DefaultThrow& example, int64_t id) {
  const ThrowRequest wanted = example.request();
  plan_request_t request{};
  request.request_id = id;
  request.seed = wanted.seed;
  request.strategy = wanted.strategy;
  std::copy_n(wanted.q_arm.data(), 4, request.q_arm);
  std::copy_n(wanted.target.p_WTarget.data(), 3, request.p_WTarget);
  std::copy_n(wanted.target.n_WTarget.data(), 3, request.n_WTarget);
  request.target_radius = wanted.target.radius;
  return request;
}

/// The message as bytes, without what counts its repetitions.
inline std::vector<uint8_t> bytesOf(swing_plan_t plan) {
  plan.seq = 0;
  std::vector<uint8_t> bytes(plan.getEncodedSize());
  plan.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
  return bytes;
}

}  // namespace fastball::planner
