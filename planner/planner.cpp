#include "planner/planner.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "planner/limit_check.h"
#include "planner/needed_speed.h"
#include "planner/request_check.h"

namespace fastball::planner {
namespace {

// Throws of the atlas tried before planning anew.
constexpr std::size_t kCandidates = 4;
// So much less steeply than asked for a throw of the atlas may meet the ring to be tried: many are solved with that bound and lie
// on it.
constexpr double kSteepnessReserve = 0.002;
// Of what a throw is interpolated from, as much must be inside the limits for it to be tried before others.
constexpr double kLikely = 0.5;
// Looking for the nearest target that works: nodes from which to begin, halvings of the way to the target.
constexpr std::size_t kPlacesTried = 8;
constexpr int kBisections = 7, kBisectionsAnew = 4;
constexpr double kPlace = 0.01;   // [m], to which a place is told
constexpr double kFacing = 1e-3;  // of unit vectors that are the same

/// The normal of a ring that faces the robot.
Eigen::Vector3d facingRobot(const Eigen::Vector3d& p_WTarget) {
  Eigen::Vector3d n(-p_WTarget.x(), -p_WTarget.y(), 0);
  return n.isZero() ? Eigen::Vector3d(-Eigen::Vector3d::UnitX()) : n.normalized();
}

Shoulder shoulderOf(ThrowKind kind) {
  return kind == ThrowKind::kHeldSwing ? Shoulder::kHeld : Shoulder::kFree;
}

SwingGoal goalOf(ThrowKind kind) {
  return kind == ThrowKind::kFlatSwing ? SwingGoal::kShortestFlight : SwingGoal::kFastest;
}

}  // namespace

Planner::Planner(const PlannerConfig& config,
                 PredictDeparture departure,
                 std::shared_ptr<const Atlas> atlas)
    : config_(config),
      arm_(config.arm, config.hand.payload),
      predictor_(config_, arm_, departure ? std::move(departure) : elasticDeparture(config)),
      windows_(config_, arm_, predictor_),
      swings_(config_, arm_, predictor_),
      config_fault_(configFault(config)),
      atlas_(std::move(atlas)) {}

std::vector<ThrowKind> Planner::kindsFor(const std::string& strategy) const {
  // Out of reach of any window: the one in which errors have the least time to grow.
  if (seeksWindow(strategy))
    return {ThrowKind::kWindow, ThrowKind::kFlatSwing, ThrowKind::kFreeSwing};
  std::vector<ThrowKind> kinds;
  for (const Shoulder shoulder : config_.shoulders)
    kinds.push_back(shoulder == Shoulder::kFree ? ThrowKind::kFreeSwing : ThrowKind::kHeldSwing);
  return kinds;
}

/// A throw of the atlas with what speaks for it.
struct Planner::Candidate {
  AtlasThrow start;
  ThrowKind kind;
  int preference;  ///< of its kind
  double worth;

  /// How likely a few steps lead from it to a throw: 2, 1 or 0.
  int promise() const { return start.inside < kLikely ? 0 : start.interpolated ? 2 : 1; }
  bool before(const Candidate& other) const {
    if (promise() != other.promise())
      return promise() > other.promise();
    if (preference != other.preference)
      return preference < other.preference;
    if (start.window != other.start.window)
      return start.window > other.start.window;
    return worth > other.worth;
  }
};

std::vector<Planner::Candidate> Planner::candidates(const ThrowRequest& request,
                                                    const std::vector<ThrowKind>& kinds) const {
  const Eigen::Vector3d& p = request.target.p_WTarget;
  const double azimuth = std::atan2(p.y(), p.x());
  const Eigen::Array4d margin = Eigen::Array4d::Constant(config_.arm.position_margin);
  const auto candidate = [&](const AtlasThrow& seen, ThrowKind kind,
                             int preference) -> std::optional<Candidate> {
    const Eigen::Array4d q = seen.q_ready.array();
    if (seen.steepness(request.target.n_WTarget) < kLeastSteepness - kSteepnessReserve ||
        (q < config_.arm.q_min.array() + margin).any() ||
        (q > config_.arm.q_max.array() - margin).any())
      return {};
    const double price =
        kind == ThrowKind::kWindow ? WindowPlanner::kApproachPrice : SwingPlanner::kApproachPrice;
    const double approach = approachTime(arm_, config_.motion, request.q_arm, seen.q_ready);
    return Candidate{seen, kind, preference, -seen.cost - price * approach};
  };
  std::vector<Candidate> found;
  int preference = 0;
  for (const ThrowKind kind : kinds) {
    for (const AtlasThrow& ahead : atlas_->near(p.head<2>().norm(), p.z(), kind)) {
      const auto own = candidate(turned(ahead, azimuth), kind, preference);
      const auto other = candidate(turned(mirrored(ahead), azimuth), kind, preference);
      // What hinders one of the two hinders the other.
      if (own && (!other || !other->before(*own))) {
        found.push_back(*own);
      } else if (other) {
        found.push_back(*other);
      }
    }
    ++preference;
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const Candidate& a, const Candidate& b) { return a.before(b); });
  return found;
}

std::optional<Plan> Planner::planNear(const ThrowRequest& request,
                                      const Candidate& candidate) const {
  if (candidate.kind == ThrowKind::kWindow)
    return windows_.planNear(request, candidate.start);
  return swings_.planNear(request, candidate.start, shoulderOf(candidate.kind),
                          goalOf(candidate.kind));
}

std::optional<Plan> Planner::firstOf(std::vector<Candidate> candidates,
                                     const ThrowRequest& request) const {
  candidates.resize(std::min(candidates.size(), kCandidates));
  for (const Candidate& candidate : candidates) {
    if (auto plan = planNear(request, candidate))
      return plan;
  }
  return {};
}

std::optional<Plan> Planner::fromAtlas(const ThrowRequest& request) const {
  return firstOf(candidates(request, kindsFor(request.strategy)), request);
}

std::optional<Plan> Planner::anew(const ThrowRequest& request, ThrowKind kind) const {
  if (kind == ThrowKind::kWindow)
    return windows_.plan(request, false);
  PlanResult result = swings_.plan(request, {shoulderOf(kind)}, goalOf(kind));
  if (Plan* plan = std::get_if<Plan>(&result))
    return std::move(*plan);
  return {};
}

std::optional<Plan> Planner::ofBestKind(const ThrowRequest& request) const {
  if (!seeksWindow(request.strategy))
    return fromAtlas(request);
  for (const ThrowKind kind : kindsFor(request.strategy)) {
    const std::vector<Candidate> found = candidates(request, {kind});
    if (auto plan = firstOf(found, request))
      return plan;
    // The first is the most promising one.
    if (found.empty() || found.front().promise() == 0)
      continue;
    if (auto plan = anew(request, kind))
      return plan;
  }
  return {};
}

PlanResult Planner::plan(const ThrowRequest& request) const {
  if (config_fault_)
    return Refusal{*config_fault_};
  if (auto fault = requestFault(request, config_))
    return Refusal{*fault};
  if (atlas_) {
    if (auto plan = ofBestKind(request))
      return *std::move(plan);
  }
  PlanResult result = planAnew(request);
  if (const Refusal* refusal = std::get_if<Refusal>(&result))
    return explain(request, refusal->sentence);
  return result;
}

PlanResult Planner::planAnew(const ThrowRequest& request) const {
  if (!seeksWindow(request.strategy))
    return swings_.plan(request, config_.shoulders);
  for (const ThrowKind kind : {ThrowKind::kWindow, ThrowKind::kFlatSwing}) {
    if (std::optional<Plan> plan = anew(request, kind))
      return *std::move(plan);
  }
  if (std::optional<Plan> plan = windows_.plan(request, true))
    return *std::move(plan);
  return swings_.plan(request, {Shoulder::kFree});
}

std::optional<Plan> Planner::nearestPlan(const ThrowRequest& request,
                                         Eigen::Vector3d& place) const {
  const Eigen::Vector3d& p = request.target.p_WTarget;
  const Eigen::Vector3d forward = facingRobot(p) * -1;
  const auto tried = [&](const Eigen::Vector2d& at) -> std::optional<Plan> {
    ThrowRequest there = request;
    // As it will be read: a place that works must work as it is written.
    for (const int axis : {0, 1})
      there.target.p_WTarget[axis] = kPlace * std::round(at[0] * forward[axis] / kPlace);
    there.target.p_WTarget.z() = kPlace * std::round(at[1] / kPlace);
    if (requestFault(there, config_))
      return {};
    std::optional<Plan> plan;
    if (atlas_) {
      plan = fromAtlas(there);
    } else {
      PlanResult result = planAnew(there);
      if (Plan* found = std::get_if<Plan>(&result))
        plan = std::move(*found);
    }
    if (plan)
      place = there.target.p_WTarget;
    return plan;
  };
  const Eigen::Vector2d wanted(p.head<2>().norm(), p.z());
  Eigen::Vector2d works;
  std::optional<Plan> plan;
  for (const Eigen::Vector2d& start : easierPlaces(wanted)) {
    works = start;
    if ((plan = tried(start)))
      break;
  }
  if (!plan)
    return {};
  Eigen::Vector2d fails = wanted;
  for (int i = 0; i < (atlas_ ? kBisections : kBisectionsAnew); ++i) {
    const Eigen::Vector2d middle = (works + fails) / 2;
    if (auto better = tried(middle)) {
      plan = std::move(better);
      works = middle;
    } else {
      fails = middle;
    }
  }
  return plan;
}

std::vector<Eigen::Vector2d> Planner::easierPlaces(const Eigen::Vector2d& wanted) const {
  if (!atlas_) {
    const Eigen::Vector2d& height = config_.atlas.height;
    return {{config_.atlas.distance[0], height.mean()}, {config_.atlas.distance[0], height[0] / 2}};
  }
  const AtlasGrid& grid = atlas_->grid();
  std::vector<Eigen::Vector2d> places;
  for (int node = 0; node < grid.nodes(); ++node) {
    if (atlas_->holdsThrow(node))
      places.push_back(grid.place(node));
  }
  std::stable_sort(places.begin(), places.end(), [&](const auto& a, const auto& b) {
    return (a - wanted).squaredNorm() < (b - wanted).squaredNorm();
  });
  places.resize(std::min(places.size(), kPlacesTried));
  return places;
}

Refusal Planner::explain(const ThrowRequest& request, const std::string& obstacle) const {
  const Eigen::Vector3d &p = request.target.p_WTarget, &n = request.target.n_WTarget;
  const std::string place = fmt::format("({:.3g}, {:.3g}, {:.3g}) m", p.x(), p.y(), p.z());
  ThrowRequest facing = request;
  facing.target.n_WTarget = facingRobot(p);
  const bool faces_robot = (facing.target.n_WTarget - n).norm() < kFacing;
  const auto planned = [&] {
    return (atlas_ && fromAtlas(facing)) || std::holds_alternative<Plan>(planAnew(facing));
  };
  if (!faces_robot && planned()) {
    return Refusal{fmt::format(
        "no throw found comes through the front of the ring at {}, which faces ({:.3g}, {:.3g}, "
        "{:.3g}), at {:.0f} degrees to its plane or more; a ring there that faces the robot can be "
        "hit",
        place, n.x(), n.y(), n.z(), std::asin(kLeastSteepness) * 180 / M_PI)};
  }
  std::string sentence = outOfReach(request, place, obstacle);
  Eigen::Vector3d nearest;
  if (const auto plan = nearestPlan(facing, nearest)) {
    sentence +=
        fmt::format("; the nearest that works is at ({:.3g}, {:.3g}, {:.3g}) m, where {}",
                    nearest.x(), nearest.y(), nearest.z(), tightestLimit(arm_, plan->trajectory));
  }
  return Refusal{sentence};
}

std::string Planner::outOfReach(const ThrowRequest& request,
                                const std::string& place,
                                const std::string& obstacle) const {
  const auto needed = neededSpeed(request.target, armReach(config_.arm, config_.hand.p_HBall),
                                  config_.ball.dragPerMetre(), config_.arm.gravity);
  if (!needed) {
    return fmt::format(
        "the target at {} is out of reach: with its drag, no ball thrown at up to "
        "100 m/s gets there",
        place);
  }
  const Shoulder shoulder =
      seeksWindow(request.strategy) ? Shoulder::kFree : config_.shoulders.back();
  const SwingSolution fastest = swings_.fastest(request, shoulder);
  if (fastest.release_speed == 0)
    return "no throw at all is found inside the limits of the arm " + config_.arm.profile;
  if (*needed > fastest.release_speed) {
    const Eigen::Vector4d share =
        SwingCurve(fastest.x, fastest.elbow_sign).at(0).qd.cwiseQuotient(config_.arm.qd_max);
    int joint = 0;
    share.cwiseAbs().maxCoeff(&joint);
    return fmt::format(
        "the target at {} is out of reach: {:.1f} m/s or more would be needed, the fastest throw "
        "found leaves at {:.1f} m/s (joint {} is then at {:.0f} % of its {:.4g} rad/s, {})",
        place, *needed, fastest.release_speed, joint + 1, 100 * std::abs(share[joint]),
        config_.arm.qd_max[joint], config_.arm.profile);
  }
  return fmt::format("no throw to {} found inside all limits of {}: {}", place, config_.arm.profile,
                     obstacle);
}

}  // namespace fastball::planner
