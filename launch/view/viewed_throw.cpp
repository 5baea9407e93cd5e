#include "launch/view/viewed_throw.h"

#include <nlohmann/json.hpp>

namespace fastball::view {
namespace {

using nlohmann::json;

json planJson(const ViewedThrow& viewed) {
  if (!viewed.plan)
    return nullptr;
  const swing_plan_t& plan = *viewed.plan;
  json flight = json::array();
  for (const Eigen::Vector3d& p : viewed.planned_flight)
    flight.push_back(toJson(p));
  return {{"t", viewed.t_plan},
          {"ok", plan.status == swing_plan_t::OK},
          {"message", plan.message},
          {"ms", plan.plan_ms},
          {"speed", Eigen::Map<const Eigen::Vector3d>(plan.v_WBall_release).norm()},
          {"landing", {plan.landing[0], plan.landing[1]}},
          {"flightTime", plan.flight_time},
          {"flight", flight}};
}

json landingJson(const ViewedThrow& viewed) {
  if (!viewed.landing)
    return nullptr;
  const landing_t& landing = *viewed.landing;
  return {{"heard", viewed.t_landing},
          {"t", viewed.offset && landing.measured != 0
                    ? 1e-6 * static_cast<double>(landing.utime) + *viewed.offset
                    : viewed.t_landing},
          {"measured", landing.measured != 0},
          {"at", {landing.landing[0], landing.landing[1]}},
          {"cov", {landing.cov_landing[0], landing.cov_landing[1], landing.cov_landing[2]}},
          {"speed", Eigen::Map<const Eigen::Vector3d>(landing.v_WBall).norm()},
          {"observations", landing.n_observations},
          {"residual", landing.residual_px},
          {"message", landing.message}};
}

}  // namespace

json toJson(const Eigen::Vector3d& v) {
  return {v.x(), v.y(), v.z()};
}

json toJson(const model::Target& target) {
  return {{"p", toJson(target.p_WTarget)},
          {"n", toJson(target.n_WTarget)},
          {"right", toJson(target.rightAxis())},
          {"up", toJson(target.upAxis())},
          {"radius", target.radius}};
}

json toJson(const ViewedThrow& viewed) {
  const auto at = [&viewed](const auto& message, auto member, double seconds) -> json {
    if (!message || !viewed.offset)
      return nullptr;
    return 1e-6 * static_cast<double>((*message).*member) + *viewed.offset + seconds;
  };
  const double release = viewed.plan ? viewed.plan->t_release : 0;
  return {{"number", viewed.number},
          {"id", viewed.id},
          {"t", viewed.t},
          {"strategy", viewed.strategy},
          {"target", viewed.target ? toJson(*viewed.target) : json(nullptr)},
          {"plan", planJson(viewed)},
          {"scene", viewed.offset ? json(viewed.t_scene) : json(nullptr)},
          {"start", at(viewed.start, &throw_start_t::start_utime, 0)},
          {"plannedRelease",
           viewed.plan ? at(viewed.start, &throw_start_t::start_utime, release) : json(nullptr)},
          {"commanded", at(viewed.commanded, &release_t::utime, 0)},
          {"departed", at(viewed.departed, &release_t::utime, 0)},
          {"landing", landingJson(viewed)},
          {"note", viewed.note},
          {"noted", viewed.t_note}};
}

}  // namespace fastball::view
