#include "planner/atlas_file.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <vector>

namespace fastball::planner {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr int kFormat = 4;
constexpr const char* kKindNames[] = {"window", "held swing", "free swing", "flat swing"};

template <typename Derived>
json toJson(const Eigen::MatrixBase<Derived>& matrix) {
  json values = json::array();
  for (const double value : matrix.reshaped())
    values.push_back(value);
  return values;
}

json toJson(const model::RigidBody& body) {
  return {{"mass", body.mass}, {"com", toJson(body.p_BCom)}, {"inertia", toJson(body.I_BCom)}};
}

json toJson(const model::ArmParameters& arm) {
  json dh = json::array(), links = json::array();
  for (const model::DhRow& row : arm.dh)
    dh.push_back({row.a, row.alpha, row.d});
  for (const model::RigidBody& link : arm.links)
    links.push_back(toJson(link));
  return {{"profile", arm.profile},
          {"dh", dh},
          {"links", links},
          {"tool_plate_distance", arm.tool_plate_distance},
          {"drive_inertia", toJson(arm.drive_inertia)},
          {"q_min", toJson(arm.q_min)},
          {"q_max", toJson(arm.q_max)},
          {"position_margin", arm.position_margin},
          {"qd_max", toJson(arm.qd_max)},
          {"tau_max", toJson(arm.tau_max)},
          {"differential", arm.differential},
          {"viscous_friction", toJson(arm.viscous_friction)},
          {"coulomb_friction", toJson(arm.coulomb_friction)},
          {"gravity", arm.gravity}};
}

json toJson(const model::HandParameters& hand) {
  return {{"ball", toJson(hand.p_HBall)},
          {"palm", {hand.palm_distance, hand.palm_radius}},
          {"palm_body", toJson(hand.palm)},
          {"finger_mass", hand.finger_mass},
          {"azimuth", hand.azimuth},
          {"base", {hand.base_radius, hand.base_distance}},
          {"phalanges", {hand.proximal_length, hand.distal_length, hand.finger_radius}},
          {"drives",
           {hand.joint_inertia, hand.wrist_inertia, hand.joint_speed_max, hand.finger_torque_max,
            hand.wrist_torque_max, hand.wrist_limit, hand.actuator_lag}},
          {"payload", toJson(hand.payload)}};
}

json toJson(const model::BallParameters& ball) {
  return {ball.radius,         ball.mass,          ball.drag_coefficient, ball.air_density,
          ball.youngs_modulus, ball.damping_ratio, ball.friction,         ball.bristle_stiffness,
          ball.bristle_damping};
}

json toJson(const SwingSettings& swing) {
  return {{"omega_max", toJson(swing.omega_max)},
          {"clearances",
           {swing.elbow_margin, swing.body_clearance, swing.lowest_ball, swing.flexion_limit}},
          {"follow_through", swing.follow.delay},
          {"brake_time", toJson(swing.follow.brake_time)}};
}

json toJson(const model::ReleaseSettings& release) {
  return {
      {"modes", {static_cast<int>(release.in_window), static_cast<int>(release.without_window)}},
      {"kp", toJson(release.kp)},
      {"kd", toJson(release.kd)},
      {"thumb", {release.thumb.open_angle, release.thumb.speed, release.thumb.deceleration}},
      {"relax",
       {release.relax_time, release.retreat_ratio, release.open_delay, release.touch_force}},
      {"open", {release.open_distance, release.clear_time}}};
}

/// FNV-1a.
uint64_t hashOf(const std::string& text) {
  uint64_t hash = 0xcbf29ce484222325;
  for (const char c : text)
    hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3;
  return hash;
}

/// All numbers of a throw, one after another, written or read by `each`.
template <typename Throw, typename Each>
void forNumbers(Throw& t, const Each& each) {
  const auto vector = [&](auto& v) {
    for (Eigen::Index i = 0; i < v.size(); ++i)
      each(v[i]);
  };
  each(t.window);
  each(t.lead);
  vector(t.aim);
  each(t.departure.delay);
  vector(t.departure.p_H);
  vector(t.departure.v_H);
  vector(t.v_arrival);
  vector(t.v_aimed);
  vector(t.q_ready);
  each(t.inside);
  each(t.cost);
  vector(t.x);
}

json toJson(const AtlasThrow& t) {
  json numbers = json::array({t.elbow_sign});
  forNumbers(t, [&](double value) { numbers.push_back(value); });
  return numbers;
}

AtlasThrow throwFrom(const json& numbers, ThrowKind kind) {
  AtlasThrow t;
  t.x.resize(kind == ThrowKind::kWindow ? kWindowVariables : static_cast<int>(kSwingVariables));
  t.elbow_sign = numbers.at(0);
  std::size_t next = 1;
  forNumbers(t, [&](double& value) {
    value = numbers.at(next++);
    if (!std::isfinite(value))
      throw std::runtime_error("a number is not finite");
  });
  if (next != numbers.size())
    throw std::runtime_error("a throw has too many numbers");
  return t;
}

AtlasLayer layerFrom(const json& object, int nodes) {
  AtlasLayer layer;
  const std::string kind = object.at("kind");
  const auto name = std::find(std::begin(kKindNames), std::end(kKindNames), kind);
  if (name == std::end(kKindNames))
    throw std::runtime_error("there is no such kind of throw");
  layer.kind = static_cast<ThrowKind>(name - std::begin(kKindNames));
  for (const json& node : object.at("throws")) {
    layer.nodes.emplace_back();
    if (!node.is_null())
      layer.nodes.back() = throwFrom(node, layer.kind);
  }
  if (layer.nodes.size() != static_cast<std::size_t>(nodes))
    throw std::runtime_error("a layer has another number of nodes than the grid");
  return layer;
}

/// All that an atlas depends on.
json atlasKey(const PlannerConfig& config) {
  const ThrowErrors& errors = config.robust.errors;
  return {
      {"format", kFormat},
      {"arm", toJson(config.arm)},
      {"hand", toJson(config.hand)},
      {"ball", toJson(config.ball)},
      {"swing", toJson(config.swing)},
      {"grip_force", config.grip_force},
      {"release", toJson(config.release)},
      {"support", {toJson(config.support_kp), toJson(config.support_kd)}},
      {"motion",
       {config.motion.sample_time, config.motion.max_samples, config.motion.ready_time,
        config.motion.approach_speed}},
      {"limit_share", config.limit_share},
      {"max_evaluations", config.max_evaluations},
      {"landing_tolerance", config.landing_tolerance},
      {"robust",
       {{"window_lengths", config.robust.window_lengths},
        {"limit_share", config.robust.limit_share},
        {"wanted_speed", config.robust.wanted_speed},
        {"errors", {errors.joint_speed, errors.grasp, errors.drag}}}},
      {"grid", {toJson(config.atlas.distance), toJson(config.atlas.height), config.atlas.step}}};
}

}  // namespace

fs::path atlasFolder() {
  // Read before any thread is started.
  const char* cache = std::getenv("XDG_CACHE_HOME");  // NOLINT(concurrency-mt-unsafe)
  if (cache != nullptr && *cache != '\0')
    return fs::path(cache) / "fastball";
  const char* home = std::getenv("HOME");  // NOLINT(concurrency-mt-unsafe)
  if (home != nullptr && *home != '\0')
    return fs::path(home) / ".cache" / "fastball";
  return {};
}

fs::path atlasPath(const PlannerConfig& config, const fs::path& folder) {
  std::string name = config.arm.profile;
  for (char& c : name) {
    if (std::isalnum(static_cast<unsigned char>(c)) == 0)
      c = '-';
  }
  return folder / fmt::format("atlas-{}-{:016x}.json", name, hashOf(atlasKey(config).dump()));
}

FoundAtlas loadAtlas(const PlannerConfig& config, const fs::path& path) {
  std::ifstream file(path);
  if (!file)
    return {};
  try {
    const json object = json::parse(file);
    if (object.at("key") != atlasKey(config))
      return {{}, fmt::format("{} is an atlas for another configuration", path.string())};
    const AtlasGrid grid{config.atlas.distance, config.atlas.height, config.atlas.step};
    std::vector<AtlasLayer> layers;
    for (const json& layer : object.at("layers"))
      layers.push_back(layerFrom(layer, grid.nodes()));
    return {Atlas(grid, std::move(layers)), {}};
  } catch (const std::exception& e) {
    return {{}, fmt::format("{} is damaged or no atlas: {}", path.string(), e.what())};
  }
}

void saveAtlas(const PlannerConfig& config, const Atlas& atlas, const fs::path& path) {
  json layers = json::array();
  for (const AtlasLayer& layer : atlas.layers()) {
    json throws = json::array();
    for (const std::optional<AtlasThrow>& node : layer.nodes)
      throws.push_back(node ? toJson(*node) : json());
    layers.push_back({{"kind", kKindNames[static_cast<int>(layer.kind)]}, {"throws", throws}});
  }
  const json object = {{"key", atlasKey(config)}, {"layers", layers}};
  std::error_code error;
  fs::create_directories(path.parent_path(), error);
  // Renaming replaces a file at once.
  const fs::path unfinished = path.string() + fmt::format(".{}", getpid());
  bool written = false;
  {
    std::ofstream file(unfinished);
    file << object.dump() << '\n';
    file.close();
    written = file.good();
  }
  if (written)
    fs::rename(unfinished, path, error);
  if (!written || error) {
    fs::remove(unfinished, error);
    throw std::runtime_error(fmt::format("no file can be written at {}", path.string()));
  }
}

}  // namespace fastball::planner
