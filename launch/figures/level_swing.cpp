#include "launch/figures/level_swing.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "launch/figures/search.h"

namespace fastball::launch {
namespace {

enum Variable {
  kAlpha1,
  kOmega1,
  kPhi1,
  kAmplitude2,
  kOmega2,
  kSwitch2,
  kC2,
  kAlpha3,
  kOmega3,
  kPhi3,
  kC3,
  kShare,
  kVariables
};

constexpr int kGrid = 30;
constexpr double kFolds = 3;      // of the exp joint, either side of its change of sign
constexpr double kJustBy = 1e-6;  // [s], beside a jump of the acceleration
// [m^2/s^2] for the whole of the limits of torque: what half a percent of the speed is worth.
constexpr double kTorquePrice = 0.03;
constexpr double kSolved = 1e-6;
constexpr int kEvaluations = 300;

BaseSwing swingOf(const Eigen::VectorXd& x) {
  return {{x[kAlpha1], x[kOmega1], x[kPhi1], 0},
          {x[kAmplitude2], x[kOmega2], x[kSwitch2], x[kC2]},
          {x[kAlpha3], x[kOmega3], x[kPhi3], x[kC3]}};
}

double square(double x) {
  return x * x;
}

/// Times at which the limits are looked at: a grid over each joint's own motion, however short it
/// is, and both sides of every jump of an acceleration.
std::vector<double> sampleTimes(const BaseSwing& swing) {
  std::vector<double> times{0};
  for (const model::SinBase* joint : {&swing.q1, &swing.q3}) {
    for (int i = 0; i <= kGrid; ++i) {
      const double part = static_cast<double>(i) / kGrid;
      times.push_back((1 - part) * (joint->start() + kJustBy) + part * (joint->end() - kJustBy));
    }
    times.push_back(joint->start() - kJustBy);
    times.push_back(joint->end() + kJustBy);
  }
  for (int i = 0; i <= kGrid / 2; ++i) {
    const double after = kJustBy + kFolds / swing.q2.omega * i / (kGrid / 2);
    times.push_back(swing.q2.t_switch - after);
    times.push_back(swing.q2.t_switch + after);
  }
  for (double& t : times)
    t = std::clamp(t, swing.start(), swing.end());
  return times;
}

struct Task {
  const model::LevelSwingModel& model;
  SwingLimits limits;

  /// At one time: nine numbers that must not be positive.
  void constrain(const BaseSwing& swing,
                 double t,
                 double share,
                 Eigen::VectorXd& c,
                 Eigen::Index& n) const {
    const model::SwingAngles s = swing.at(t);
    const Eigen::Vector3d tau = model.inverseDynamics(s.q, s.qd, s.qdd);
    for (int j = 0; j < 3; ++j) {
      const double middle = (limits.q_min[j] + limits.q_max[j]) / 2;
      const double half = (limits.q_max[j] - limits.q_min[j]) / 2;
      c[n++] = square((s.q[j] - middle) / half) - 1;
      c[n++] = square(s.qd[j] / limits.qd_max[j]) - 1;
      c[n++] = square(tau[j] / limits.tau_max[j]) - share;
    }
  }

  Eigen::VectorXd constraints(const BaseSwing& swing, double share) const {
    const std::vector<double> times = sampleTimes(swing);
    Eigen::VectorXd c(static_cast<Eigen::Index>(9 * times.size() + 2));
    Eigen::Index n = 0;
    for (const double t : times)
      constrain(swing, t, share, c, n);
    // The release lies within the swing.
    c[n++] = swing.start();
    c[n++] = -swing.end();
    return c;
  }

  double speed(const BaseSwing& swing) const {
    const model::SwingAngles s = swing.at(0);
    return model.endEffectorVelocity(s.q, s.qd).norm();
  }
};

/// Eq. (15), less a price on the largest share of the limits of torque; the square of that share is
/// the last variable.
SearchProblem fastest(const Task& task) {
  SearchProblem problem;
  problem.lower.resize(kVariables);
  problem.upper.resize(kVariables);
  //               alpha1 omega1 phi1  amp2 omega2 switch  c2  alpha3 omega3 phi3 c3 share^2
  problem.lower << 0.02, 0.5, -1.5, 0.02, 0.5, -0.5, 0, -2.5, 0.5, -1.5, -3, 0;
  problem.upper << 2.6, 0, 1.5, 2.5, 0, 0.5, 3, 2.5, 0, 1.5, 3, 1;
  const Eigen::Vector3d& omega_max = task.limits.omega_max;
  problem.upper[kOmega1] = omega_max[0];
  problem.upper[kOmega2] = omega_max[1];
  problem.upper[kOmega3] = omega_max[2];
  problem.evaluate = [task](const Eigen::VectorXd& x) {
    const BaseSwing swing = swingOf(x);
    const double share = x[kShare];
    return SearchProblem::Values{0.1 * square(task.speed(swing)) - kTorquePrice * share,
                                 task.constraints(swing, share)};
  };
  return problem;
}

}  // namespace

SwingLimits levelSwingLimits(const model::ArmParameters& arm,
                             const Eigen::Vector3d& omega_max,
                             double torque_share) {
  SwingLimits limits;
  limits.omega_max = omega_max;
  constexpr int kJoints[] = {0, 1, 3};
  for (int j = 0; j < 3; ++j) {
    limits.q_min[j] = arm.q_min[kJoints[j]] + arm.position_margin;
    limits.q_max[j] = arm.q_max[kJoints[j]] - arm.position_margin;
    limits.qd_max[j] = arm.qd_max[kJoints[j]];
    limits.tau_max[j] = torque_share * arm.tau_max[kJoints[j]];
  }
  return limits;
}

model::SwingAngles BaseSwing::at(double t) const {
  const model::BaseValue a = q1.at(t), b = q2.at(t), c = q3.at(t);
  return {{a.q, b.q, c.q}, {a.qd, b.qd, c.qd}, {a.qdd, b.qdd, c.qdd}};
}

double BaseSwing::start() const {
  return std::min({q1.start(), q2.t_switch - M_PI / 2 / q2.omega, q3.start()});
}

double BaseSwing::end() const {
  return std::max({q1.end(), q2.t_switch + M_PI / 2 / q2.omega, q3.end()});
}

LevelSwing fastestLevelSwing(const model::LevelSwingModel& model,
                             const SwingLimits& limits,
                             int starts,
                             int64_t seed) {
  const Task task{model, limits};
  const SearchProblem problem = fastest(task);
  std::mt19937_64 random(static_cast<uint64_t>(seed));
  std::uniform_real_distribution<> unit(0, 1);
  LevelSwing best;
  double worth = -std::numeric_limits<double>::infinity();
  for (int i = 0; i < starts; ++i) {
    Eigen::VectorXd start = problem.lower;
    for (int k = 0; k < kVariables; ++k)
      start[k] += (problem.upper[k] - problem.lower[k]) * unit(random);
    start[kShare] = 1;
    const SearchResult result = searchFrom(problem, start, kEvaluations);
    if (result.violation > kSolved || result.worth <= worth)
      continue;
    worth = result.worth;
    best = {swingOf(result.x), task.speed(swingOf(result.x)), std::sqrt(result.x[kShare])};
  }
  return best;
}

}  // namespace fastball::launch
