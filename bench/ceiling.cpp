#include "bench/ceiling.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>
#include <stdexcept>

#include "bench/best_release.h"
#include "bench/free_form_optimiser.h"

namespace fastball::bench {
namespace {

constexpr int kReleaseStarts = 100;
// Random poses for a throw that need not be fast; more if the first are in vain.
constexpr std::array<int, 2> kEasyReleaseStarts = {20, 100};
constexpr double kHolds = 1e-6;
constexpr double kNearBest = 0.005;
// Share of the torque limits below which the first motions are slower.
constexpr double kStrongArm = 0.5;
constexpr double kAtBound = 3e-4;
constexpr double kSampleTime = 1e-3;  // [s], at most
// Kept from the limits; more if the grid of 0.1 ms finds one broken.
constexpr std::array<double, 4> kReserves = {1e-4, 3e-4, 1e-3, 3e-3};
constexpr double kSteepest = 0.999;
constexpr double kHopeless = 1e-3;  // violation that no greater reserve removes
constexpr double kEasyReserve = 1e-3;
constexpr std::array<double, 3> kDurations = {0.8, 0.6, 1.1};  // [s], of the starts

void require(bool holds, const char* what, double value, const char* limit) {
  if (!holds)
    throw std::invalid_argument(fmt::format("{} must be {}, not {}", what, limit, value));
}

void check(const CeilingOptions& options, const model::Target& target) {
  require(options.torque_share > 0 && options.torque_share <= 1, "the share of the torque limits",
          options.torque_share, "above 0 and at most 1");
  require(options.speed_share > 0 && options.speed_share <= 1, "the share of the speed limits",
          options.speed_share, "above 0 and at most 1");
  require(options.control_points >= 6 && options.control_points <= 40,
          "the number of control points", options.control_points, "from 6 to 40");
  require(options.starts >= 1 && options.starts <= 1000, "the number of starts", options.starts,
          "from 1 to 1000");
  const double distance = target.p_WTarget.norm(), length = target.n_WTarget.norm();
  require(distance < 100, "the target's distance in m", distance, "below 100");
  require(std::abs(length - 1) < 1e-6, "the length of the target's normal", length, "1");
  const double vertical = std::abs(target.n_WTarget.z());
  require(vertical < kSteepest, "the vertical part of the target's normal", vertical,
          "below 0.999: the plane's axes are undefined there");
}

model::SampledTrajectory sampled(const FreeFormProblem& problem, const Eigen::VectorXd& x) {
  const double duration = x[problem.durationIndex()];
  const auto steps = static_cast<int>(std::ceil(duration / kSampleTime));
  std::vector<model::ArmMotion> samples;
  for (int k = 0; k <= steps; ++k)
    samples.push_back(problem.motion(x, static_cast<double>(k) / steps));
  return {duration / steps, std::move(samples)};
}

/// A search among the throws of one kind.
class Search {
 public:
  explicit Search(const FreeThrow& task, int control_points)
      : optimiser_(FreeFormProblem(task, control_points)) {}

  const FreeFormProblem& problem() const { return optimiser_.problem(); }
  const FreeFormOptimiser& optimiser() const { return optimiser_; }

  /// The fastest throw near x that keeps the limits on the grid of 0.1 ms.
  std::optional<Eigen::VectorXd> fastest(Eigen::VectorXd x, Aim aim) const {
    for (const double reserve : kReserves) {
      const FreeFormSolution solution = optimiser_.optimise(x, aim, reserve);
      if (!(solution.violation < kHopeless))
        return {};
      x = solution.x;
      if (checked(x).check.violation <= kHolds)
        return x;
    }
    return {};
  }

  Ceiling checked(const Eigen::VectorXd& x) const {
    Ceiling ceiling;
    ceiling.trajectory = sampled(problem(), x);
    ceiling.t_release = x[problem().releaseIndex()] * x[problem().durationIndex()];
    ceiling.check = checkThrow(problem().task(), ceiling.trajectory, ceiling.t_release);
    ceiling.found = ceiling.check.violation <= kHolds;
    ceiling.release_speed = ceiling.check.release.v_WBall.norm();
    return ceiling;
  }

 private:
  FreeFormOptimiser optimiser_;
};

/// The fastest throw of one kind, start by start.
class Climb {
 public:
  Climb(const FreeThrow& task, const CeilingOptions& options)
      : options_(options),
        search_(task, options.control_points),
        fastest_(bestReleases(task, Merit::kFastest, kReleaseStarts, options.seed)) {
    best_.bound = fastest_.empty() ? 0 : fastest_.front().speed;
  }

  void from(const Eigen::VectorXd& start) {
    ++starts_;
    speeds_.push_back(improve(start, Aim::kFast));
  }

  /// From the fastest and the easiest releases by turns; then from the fastest throw with joint 2 held, and
  /// from the best so far with more care.
  void run() {
    fromReleases();
    if (!options_.hold_shoulder && !atBound())
      fromHeldShoulder();
    if (best_x_ && !atBound())
      improve(*best_x_, Aim::kFastestOfAll);
  }

  Ceiling result() const {
    Ceiling result = best_;
    result.starts = starts_;
    const double best = speeds_.empty() ? 0 : *std::max_element(speeds_.begin(), speeds_.end());
    result.starts_near_best =
        static_cast<int>(std::count_if(speeds_.begin(), speeds_.end(), [&](double speed) {
          return speed > 0 && speed >= (1 - kNearBest) * best;
        }));
    return result;
  }
  const std::optional<Eigen::VectorXd>& bestX() const { return best_x_; }

 private:
  void fromReleases() {
    std::vector<BestRelease> easiest;
    for (int i = 0; i < options_.starts && (options_.all_starts || !atBound()); ++i) {
      const bool fast = i % 2 == 0;
      if (!fast && easiest.empty())
        easiest =
            bestReleases(search_.problem().task(), Merit::kEasiest, kReleaseStarts, options_.seed);
      const std::vector<BestRelease>& releases = fast ? fastest_ : easiest;
      if (releases.empty())
        return;
      const std::size_t turn = i / 2, round = turn / releases.size();
      const double slower = std::sqrt(std::max(1.0, kStrongArm / options_.torque_share));
      from(swingThrough(search_.problem(), releases[turn % releases.size()],
                        slower * kDurations[round % kDurations.size()]));
    }
  }

  void fromHeldShoulder() {
    FreeThrow task = search_.problem().task();
    task.hold_shoulder = true;
    CeilingOptions options = options_;
    options.hold_shoulder = true;
    Climb held(task, options);
    held.run();
    if (held.best_x_)
      from(withFreeShoulder(held.search_.problem(), *held.best_x_, search_.problem()));
  }

  /// @return the speed reached, 0 if no throw was.
  double improve(const Eigen::VectorXd& start, Aim aim) {
    const auto x = search_.fastest(start, aim);
    if (!x)
      return 0;
    Ceiling ceiling = search_.checked(*x);
    const double speed = ceiling.release_speed;
    if (speed > best_.release_speed) {
      ceiling.bound = best_.bound;
      best_ = std::move(ceiling);
      best_x_ = x;
    }
    return speed;
  }
  bool atBound() const { return best_.release_speed > (1 - kAtBound) * best_.bound; }

  CeilingOptions options_;
  Search search_;
  std::vector<BestRelease> fastest_;
  Ceiling best_;
  std::optional<Eigen::VectorXd> best_x_;
  std::vector<double> speeds_;
  int starts_ = 0;
};

}  // namespace

FreeThrow freeThrow(const planner::PlannerConfig& config,
                    const model::Arm& arm,
                    const model::Target& target,
                    const CeilingOptions& options) {
  check(options, target);
  FreeThrow task;
  task.arm = &arm;
  task.p_TBall = config.hand.p_HBall;
  task.drag_per_metre = config.ball.dragPerMetre();
  task.body_clearance = config.swing.body_clearance;
  task.lowest_ball = config.swing.lowest_ball;
  if (options.must_land)
    task.target = target;
  task.hold_shoulder = options.hold_shoulder;
  task.across_forearm = options.across_forearm;
  task.speed_share = options.speed_share;
  task.torque_share = options.torque_share;
  return task;
}

Ceiling ceiling(const planner::PlannerConfig& config,
                const model::Target& target,
                const CeilingOptions& options) {
  const model::Arm arm(config.arm, config.hand.payload);
  Climb climb(freeThrow(config, arm, target, options), options);
  climb.run();
  return climb.result();
}

Ceiling anyThrow(const planner::PlannerConfig& config,
                 const model::Target& target,
                 const CeilingOptions& options) {
  const model::Arm arm(config.arm, config.hand.payload);
  const Search search(freeThrow(config, arm, target, options), options.control_points);
  Ceiling result;
  for (const int poses : kEasyReleaseStarts) {
    for (const BestRelease& release :
         bestReleases(search.problem().task(), Merit::kEasiest, poses, options.seed + poses)) {
      if (result.starts == options.starts)
        return result;
      const int starts = result.starts + 1;
      const FreeFormSolution solution =
          search.optimiser().optimise(swingThrough(search.problem(), release, kDurations.front()),
                                      Aim::kPossible, kEasyReserve);
      if (solution.holds())
        result = search.checked(solution.x);
      result.starts = starts;
      if (result.found) {
        result.starts_near_best = 1;
        return result;
      }
    }
  }
  return result;
}

bool reachable(const planner::PlannerConfig& config,
               const model::Target& target,
               const CeilingOptions& options) {
  return anyThrow(config, target, options).found;
}

std::vector<Ceiling> ceilingOverTorqueBudget(const planner::PlannerConfig& config,
                                             const model::Target& target,
                                             const CeilingOptions& options,
                                             const std::vector<double>& torque_shares) {
  const model::Arm arm(config.arm, config.hand.payload);
  std::vector<std::size_t> order(torque_shares.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return torque_shares[a] > torque_shares[b];
  });
  std::vector<Climb> climbs;
  for (const std::size_t i : order) {
    CeilingOptions with = options;
    with.torque_share = torque_shares[i];
    climbs.emplace_back(freeThrow(config, arm, target, with), with);
    // The fastest throw with more torque may be near.
    const std::size_t k = climbs.size() - 1;
    if (k > 0 && climbs[k - 1].bestX())
      climbs[k].from(*climbs[k - 1].bestX());
    climbs[k].run();
  }
  std::vector<Ceiling> ceilings(torque_shares.size());
  for (std::size_t k = order.size(); k-- > 0;) {
    // The fastest throw with less torque is a throw with more.
    if (k + 1 < order.size() && climbs[k + 1].bestX())
      climbs[k].from(*climbs[k + 1].bestX());
    ceilings[order[k]] = climbs[k].result();
  }
  return ceilings;
}

}  // namespace fastball::bench
