#include "launch/figures/torque_budget.h"

#include <algorithm>
#include <cmath>
#include <future>
#include <memory>
#include <random>

#include "launch/figures/search.h"
#include "model/swing.h"
#include "model/trajectory.h"

namespace fastball::launch {
namespace {

constexpr int kGrid = 20;         // times for each base function
constexpr double kJustBy = 1e-6;  // [s], inside the jumps of the acceleration
constexpr double kFolds = 3;      // of the exp joint, either side of its change of sign
constexpr double kSolved = 1e-5;
constexpr int kEvaluations = 150;
constexpr int kRounds = 6;
constexpr double kNear = 0.03;  // of the span of a variable, standard deviation

double square(double x) {
  return x * x;
}

/// |x|, smooth at 0.
double smoothAbs(double x) {
  return std::sqrt(x * x + 1e-4);
}

/// A throw from rest to rest with its release at t = 0.
class TimedThrow {
 public:
  virtual ~TimedThrow() = default;
  /// [s], where the limits are looked at, in order.
  virtual std::vector<double> times() const = 0;
  virtual model::ArmMotion at(double t, double q3_near) const = 0;
};

void addGrid(const model::SinBase& base, std::vector<double>& times) {
  for (int i = 0; i <= kGrid; ++i) {
    const double part = static_cast<double>(i) / kGrid;
    times.push_back((1 - part) * (base.start() + kJustBy) + part * (base.end() - kJustBy));
  }
}

class KineticChain : public TimedThrow {
 public:
  enum Variable {
    kAlpha1,
    kOmega1,
    kPhi1,
    kC1,
    kAmplitude2,
    kOmega2,
    kSwitch2,
    kC2,
    kAlpha3,
    kOmega3,
    kPhi3,
    kC3,
    kGamma,
    kVariables
  };
  explicit KineticChain(const Eigen::VectorXd& x)
      : q1_{x[kAlpha1], x[kOmega1], x[kPhi1], x[kC1]},
        q2_{x[kAmplitude2], x[kOmega2], x[kSwitch2], x[kC2]},
        q3_{x[kAlpha3], x[kOmega3], x[kPhi3], x[kC3]},
        gamma_(x[kGamma]) {}

  std::vector<double> times() const override {
    std::vector<double> times{0};
    addGrid(q1_, times);
    addGrid(q3_, times);
    for (int i = 0; i <= kGrid / 2; ++i) {
      const double after = kJustBy + kFolds / q2_.omega * 2 * i / kGrid;
      times.push_back(q2_.t_switch - after);
      times.push_back(q2_.t_switch + after);
    }
    std::sort(times.begin(), times.end());
    return times;
  }

  model::ArmMotion at(double t, double q3_near) const override {
    const model::BaseValue a = q1_.at(t), b = q2_.at(t), c = q3_.at(t);
    const model::WamMotion wam = model::wamFromSwing(
        {{a.q, b.q, c.q}, {a.qd, b.qd, c.qd}, {a.qdd, b.qdd, c.qdd}}, gamma_, 1, q3_near);
    return {wam.q, wam.qd, wam.qdd};
  }

 private:
  model::SinBase q1_;
  model::ExpBase q2_;
  model::SinBase q3_;
  double gamma_;
};

class InPhase : public TimedThrow {
 public:
  /// x: alpha and c of each joint, omega, phi.
  enum Variable { kAlpha, kC = kAlpha + 4, kOmega = kC + 4, kPhi, kVariables };
  explicit InPhase(const Eigen::VectorXd& x)
      : way_{1, x[kOmega], x[kPhi], 0}, alpha_(x.segment<4>(kAlpha)), c_(x.segment<4>(kC)) {}

  std::vector<double> times() const override {
    std::vector<double> times;
    addGrid(way_, times);
    times.push_back(0);
    std::sort(times.begin(), times.end());
    return times;
  }

  model::ArmMotion at(double t, double) const override {
    const model::BaseValue way = way_.at(t);
    return {c_ + way.q * alpha_, way.qd * alpha_, way.qdd * alpha_};
  }

 private:
  model::SinBase way_;
  Eigen::Vector4d alpha_, c_;
};

/// Eq. (15) with one share of the torque.
struct Task {
  const model::Arm& arm;
  BudgetSettings settings;
  Timing timing;
  double share;

  std::unique_ptr<TimedThrow> throwOf(const Eigen::VectorXd& x) const {
    if (timing == Timing::kKineticChain)
      return std::make_unique<KineticChain>(x);
    return std::make_unique<InPhase>(x);
  }

  void constrain(const model::ArmMotion& m, double* c) const {
    const model::ArmParameters& limits = arm.parameters();
    for (int j = 0; j < model::kArmJoints; ++j) {
      const double low = limits.q_min[j] + limits.position_margin,
                   high = limits.q_max[j] - limits.position_margin;
      *c++ = square((2 * m.q[j] - low - high) / (high - low)) - 1;
    }
    const Eigen::Vector4d speed = m.qd.cwiseQuotient(limits.qd_max);
    const Eigen::Vector4d tau = arm.inverseDynamics(m.q, m.qd, m.qdd) + arm.frictionTorque(m.qd);
    const Eigen::Vector4d torque = tau.cwiseQuotient(share * limits.tau_max);
    for (const Eigen::Vector4d& used : {speed, torque}) {
      *c++ = square(used[0]) - 1;
      *c++ = smoothAbs(used[1]) + smoothAbs(used[2]) - 1;
      *c++ = square(used[3]) - 1;
    }
    *c++ = timing == Timing::kKineticChain ? settings.elbow_margin - m.q[3] : -1;
    const Eigen::Vector3d p_WBall = arm.p_WPoint(m.q, settings.p_TBall);
    const double above = std::max(0.0, p_WBall.z() - 0.1);
    *c++ = settings.body_clearance - std::sqrt(p_WBall.head<2>().squaredNorm() + square(above));
    *c++ = settings.lowest_ball - p_WBall.z();
  }
  static constexpr int kPerSample = 13;

  double speed(const model::ArmMotion& m) const {
    return (arm.pointJacobian(m.q, settings.p_TBall) * m.qd).norm();
  }

  SearchProblem::Values evaluate(const Eigen::VectorXd& x) const {
    const std::unique_ptr<TimedThrow> swing = throwOf(x);
    const std::vector<double> times = swing->times();
    SearchProblem::Values values;
    values.inequalities.resize(kPerSample * static_cast<Eigen::Index>(times.size()) + 2);
    double* c = values.inequalities.data();
    double q3 = 0;
    for (const double t : times) {
      const model::ArmMotion m = swing->at(t, q3);
      q3 = m.q[2];
      constrain(m, c);
      c += kPerSample;
      if (t == 0)
        values.worth = 0.1 * square(speed(m));
    }
    *c++ = times.front();
    *c++ = -times.back();
    return values;
  }
};

SearchProblem problemOf(const Task& task) {
  SearchProblem problem;
  const model::ArmParameters& arm = task.arm.parameters();
  const double omega = task.settings.omega_max;
  if (task.timing == Timing::kKineticChain) {
    problem.lower.resize(KineticChain::kVariables);
    problem.upper.resize(KineticChain::kVariables);
    //               alpha1 omega1 phi1 c1  amp2 omega2 switch c2  alpha3 omega3 phi3 c3  gamma
    problem.lower << 0, 0.5, -1.5, -2.6, -1.5, 0.5, -0.5, -4, 0, 0.5, -1.5, -6.3, 0.02;
    problem.upper << 2.6, omega, 1.5, 2.6, 1.5, omega, 0.5, 4, 2.5, omega, 1.5, 6.3,
        arm.q_max[1] - arm.position_margin;
  } else {
    problem.lower.resize(InPhase::kVariables);
    problem.upper.resize(InPhase::kVariables);
    const double held = task.timing == Timing::kInPhaseHeld ? 1e-9 : 2;
    problem.lower << 0, -held, -2.7, -2, arm.q_min, 0.5, -1.5;
    problem.upper << 2.6, held, 2.7, 2, arm.q_max, omega, 1.5;
  }
  problem.evaluate = [task](const Eigen::VectorXd& x) { return task.evaluate(x); };
  return problem;
}

/// A random throw whose joints turn by moderate angles.
Eigen::VectorXd randomStart(const SearchProblem& problem, std::mt19937_64& random) {
  std::uniform_real_distribution<> unit(0.25, 0.75);
  Eigen::VectorXd x(problem.lower.size());
  for (Eigen::Index i = 0; i < x.size(); ++i)
    x[i] = problem.lower[i] + (problem.upper[i] - problem.lower[i]) * unit(random);
  return x;
}

/// A start beside x.
Eigen::VectorXd near(Eigen::VectorXd x, const SearchProblem& problem, std::mt19937_64& random) {
  std::normal_distribution<> normal(0, kNear);
  for (Eigen::Index i = 0; i < x.size(); ++i)
    x[i] += (problem.upper[i] - problem.lower[i]) * normal(random);
  return x.cwiseMax(problem.lower).cwiseMin(problem.upper);
}

void keepBetter(SearchResult found, SearchResult& best) {
  if (found.violation < kSolved && found.worth > best.worth)
    best = std::move(found);
}

/// A search from `start` and again from where it came to: SLSQP stops early where times of different
/// base functions pass one another, because the acceleration jumps there.
SearchResult polished(const SearchProblem& problem, const Eigen::VectorXd& start) {
  SearchResult best = searchFrom(problem, start, kEvaluations);
  SearchResult next = searchFrom(problem, best.x, kEvaluations);
  if (next.violation < kSolved && (best.violation >= kSolved || next.worth > best.worth))
    best = std::move(next);
  return best;
}

/// The best of `starts` searches; without x if none solves the problem.
SearchResult fromRandomStarts(const Task& task, int starts, int64_t seed) {
  const SearchProblem problem = problemOf(task);
  std::mt19937_64 random(static_cast<uint64_t>(seed));
  SearchResult best;
  for (int k = 0; k < starts; ++k)
    keepBetter(polished(problem, randomStart(problem, random)), best);
  return best;
}

}  // namespace

std::vector<BudgetPoint> fastestByBudget(const model::Arm& arm,
                                         const BudgetSettings& settings,
                                         Timing timing,
                                         const std::vector<double>& shares,
                                         int starts,
                                         int64_t seed) {
  std::vector<Task> tasks;
  for (const double share : shares)
    tasks.push_back({arm, settings, timing, share});
  // Each share by itself, side by side; nothing depends on which is done first.
  std::vector<std::future<SearchResult>> alone;
  for (std::size_t i = 0; i < shares.size(); ++i) {
    const int more = static_cast<int>(std::ceil(starts / shares[i]));
    alone.push_back(std::async(std::launch::async, fromRandomStarts, tasks[i], more,
                               seed + static_cast<int64_t>(i)));
  }
  std::vector<SearchResult> best;
  for (std::future<SearchResult>& found : alone)
    best.push_back(found.get());
  // What is good with one share is a good start with the next, and so is what lies near the best so
  // far.
  std::mt19937_64 random(static_cast<uint64_t>(seed));
  for (int round = 0; round < kRounds; ++round) {
    for (std::size_t k = 0; k < shares.size(); ++k) {
      const std::size_t i = round % 2 == 0 ? k : shares.size() - 1 - k;
      for (const std::size_t from : {i - 1, i, i + 1}) {
        if (from >= shares.size() || best[from].x.size() == 0)
          continue;
        const SearchProblem problem = problemOf(tasks[i]);
        const Eigen::VectorXd start = from == i ? near(best[i].x, problem, random) : best[from].x;
        keepBetter(polished(problem, start), best[i]);
      }
    }
  }
  std::vector<BudgetPoint> points;
  for (std::size_t i = 0; i < shares.size(); ++i) {
    BudgetPoint point{shares[i], 0, 0};
    if (best[i].x.size() > 0) {
      const std::vector<double> times = tasks[i].throwOf(best[i].x)->times();
      point.release_speed = std::sqrt(10 * best[i].worth);
      point.duration = times.back() - times.front();
    }
    points.push_back(point);
  }
  return points;
}

}  // namespace fastball::launch
