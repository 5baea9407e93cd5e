#include "bench/best_release.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlopt.hpp>
#include <random>

namespace fastball::bench {
namespace {

using model::kArmJoints;

constexpr int kVariables = ReleaseRows::kBy;
using Variables = Eigen::Matrix<double, kVariables, 1>;

constexpr int kInequalities = 11;  // 8 of speed, 2 clearances, through the ring
constexpr int kMaxEvaluations = 200;
constexpr double kHolds = 1e-6;
constexpr double kAlike = 0.02;                            // [rad], [rad/s]
constexpr double kFirstFlight = 0.3, kFlightSpread = 0.6;  // [s], of the starts
constexpr double kShortestFlight = 0.02, kLongestFlight = 3.0;

using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// What NLopt asks about.
struct Problem {
  const FreeThrow& task;
  Merit merit;

  ReleaseRows release(const double* x) const {
    const Eigen::Map<const Variables> at(x);
    return releaseRows(task, at.head<4>(), at.segment<4>(4), at[kVariables - 1]);
  }

  double value(const double* x, double* gradient) const {
    Eigen::Map<Variables> slope(gradient, gradient == nullptr ? 0 : kVariables);
    if (merit == Merit::kFastest) {
      const ReleaseRows rows = release(x);
      if (gradient != nullptr)
        slope = -rows.speed_slope.transpose();
      return -rows.speed;
    }
    const Eigen::Vector4d limit = task.speed_share * task.arm->parameters().qd_max;
    const Eigen::Vector4d share = Eigen::Map<const Variables>(x).segment<4>(4).cwiseQuotient(limit);
    if (gradient != nullptr)
      slope << Eigen::Vector4d::Zero(), 2 * share.cwiseQuotient(limit), 0;
    return share.squaredNorm();
  }

  void equal(double* c, unsigned count, const double* x, double* gradient) const {
    const ReleaseRows rows = release(x);
    const int first = equalRows(task).first;
    std::copy_n(rows.equal.data() + first, count, c);
    if (gradient != nullptr)
      Eigen::Map<Rows>(gradient, count, kVariables) = rows.equal_slope.middleRows(first, count);
  }

  void limits(double* c, const double* x, double* gradient) const {
    const Eigen::Map<const Variables> at(x);
    model::ArmMotion motion;
    motion.q = at.head<4>();
    motion.qd = at.segment<4>(4);
    const LimitSlopes slopes = limitSlopes(task, motion);
    const ReleaseRows rows = release(x);
    Eigen::Map<Eigen::Matrix<double, kInequalities, 1>> values(c);
    values << slopes.rows.value.segment<8>(LimitRows::kSpeed), slopes.rows.value.tail<2>(),
        rows.grazing;
    if (gradient == nullptr)
      return;
    Eigen::Map<Rows> by_x(gradient, kInequalities, kVariables);
    by_x.setZero();
    by_x.block<8, 4>(0, 4) = slopes.by_qd.middleRows<8>(LimitRows::kSpeed);
    by_x.block<2, 4>(8, 0) = slopes.by_q.bottomRows<2>();
    by_x.row(10) = rows.grazing_slope;
  }

  double violation(const Variables& x) const {
    if (!x.allFinite())
      return std::numeric_limits<double>::infinity();
    Eigen::Matrix<double, kInequalities, 1> c;
    limits(c.data(), x.data(), nullptr);
    const EqualRows rows = equalRows(task);
    const Eigen::VectorXd e = release(x.data()).equal.segment(rows.first, rows.count);
    return std::max({0.0, c.maxCoeff(), e.size() > 0 ? e.cwiseAbs().maxCoeff() : 0.0});
  }
};

double value(unsigned, const double* x, double* gradient, void* data) {
  return static_cast<const Problem*>(data)->value(x, gradient);
}
void equal(unsigned count, double* c, unsigned, const double* x, double* gradient, void* data) {
  static_cast<const Problem*>(data)->equal(c, count, x, gradient);
}
void limits(unsigned, double* c, unsigned, const double* x, double* gradient, void* data) {
  static_cast<const Problem*>(data)->limits(c, x, gradient);
}

/// Where the variables may be.
struct Box {
  Variables low, high;
};
Box boxOf(const FreeThrow& task) {
  const model::ArmParameters& arm = task.arm->parameters();
  Eigen::Vector4d speed = task.speed_share * arm.qd_max;
  if (task.hold_shoulder)
    speed[1] = 0;
  Box box;
  box.low << arm.q_min.array() + arm.position_margin, -speed, kShortestFlight;
  box.high << arm.q_max.array() - arm.position_margin, speed, kLongestFlight;
  return box;
}

/// SLSQP from x, in place.
void climb(Problem& problem, const Box& box, Variables& x) {
  nlopt::opt optimiser(nlopt::LD_SLSQP, kVariables);
  optimiser.set_lower_bounds({box.low.data(), box.low.data() + kVariables});
  optimiser.set_upper_bounds({box.high.data(), box.high.data() + kVariables});
  optimiser.set_min_objective(value, &problem);
  optimiser.add_inequality_mconstraint(limits, &problem, std::vector<double>(kInequalities, 1e-9));
  if (const int count = equalRows(problem.task).count; count > 0)
    optimiser.add_equality_mconstraint(equal, &problem, std::vector<double>(count, 1e-9));
  optimiser.set_maxeval(kMaxEvaluations);
  optimiser.set_ftol_rel(1e-8);
  std::vector<double> point(x.data(), x.data() + kVariables);
  double best = 0;
  try {
    optimiser.optimize(point, best);
  } catch (const std::runtime_error&) {
    // `point` is the best so far; the caller looks at what it violates.
  }
  x = Eigen::Map<const Variables>(point.data());
}

}  // namespace

std::vector<BestRelease> bestReleases(const FreeThrow& task,
                                      Merit merit,
                                      int starts,
                                      int64_t seed) {
  Problem problem{task, merit};
  const Box box = boxOf(task);
  std::mt19937_64 engine(static_cast<uint64_t>(seed));
  std::uniform_real_distribution<double> uniform;
  std::vector<std::pair<double, BestRelease>> found;
  for (int i = 0; i < starts; ++i) {
    Variables x;
    for (int k = 0; k < kVariables; ++k)
      x[k] = box.low[k] + (box.high[k] - box.low[k]) * uniform(engine);
    x[kVariables - 1] = kFirstFlight + kFlightSpread * uniform(engine);
    climb(problem, box, x);
    if (problem.violation(x) > kHolds)
      continue;
    const BestRelease release{x.head<4>(), x.segment<4>(4), x[kVariables - 1],
                              problem.release(x.data()).speed};
    const bool known = std::any_of(found.begin(), found.end(), [&](const auto& other) {
      return (other.second.q - release.q).cwiseAbs().maxCoeff() < kAlike &&
             (other.second.qd - release.qd).cwiseAbs().maxCoeff() < kAlike;
    });
    if (!known)
      found.emplace_back(problem.value(x.data(), nullptr), release);
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<BestRelease> best;
  for (const auto& [merit_value, release] : found)
    best.push_back(release);
  return best;
}

}  // namespace fastball::bench
