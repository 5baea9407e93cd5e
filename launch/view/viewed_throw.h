#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "lcmtypes/fastball_types.h"
#include "model/target.h"

namespace fastball::view {

/// One throw as far as it has been heard. Nothing of it comes from SIM_TRUTH.
struct ViewedThrow {
  int64_t number = 0;  ///< 1, 2, ... of those that this viewer has heard of
  int64_t id = 0;      ///< in messages, also the plan's and the scene's; begins anew with each run
  double t = 0;        ///< [s] on the time axis, when it was first heard of
  std::optional<model::Target> target;
  std::string strategy;
  std::optional<swing_plan_t> plan;             ///< without its samples
  double t_plan = 0;                            ///< [s]
  std::vector<Eigen::Vector3d> planned_flight;  ///< [m], p_WBall at even times
  std::optional<throw_start_t> start;
  std::optional<double> offset;  ///< [s], from simulated time to the time axis, once its scene runs
  double t_scene = 0;            ///< [s], when it began
  std::optional<release_t> commanded, departed;
  std::optional<landing_t> landing;
  double t_landing = 0;  ///< [s], when the landing was heard
  std::string note;      ///< what went wrong, or empty
  double t_note = 0;     ///< [s], when that was heard
  int64_t track_points = 0;
  int64_t serial = 0;  ///< greater than that of every change before
};

/// For the page. Lengths [m], times [s] on the time axis; null: not heard, or not known yet.
nlohmann::json toJson(const ViewedThrow& viewed);

/// Of a message that names a target.
template <class Message>
model::Target targetOf(const Message& message) {
  model::Target target;
  target.p_WTarget = Eigen::Map<const Eigen::Vector3d>(message.p_WTarget);
  target.n_WTarget = Eigen::Map<const Eigen::Vector3d>(message.n_WTarget);
  target.radius = message.target_radius;
  return target;
}
nlohmann::json toJson(const model::Target& target);

/// x, y, z.
nlohmann::json toJson(const Eigen::Vector3d& v);

}  // namespace fastball::view
