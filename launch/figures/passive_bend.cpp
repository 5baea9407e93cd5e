#include "launch/figures/passive_bend.h"

#include <Eigen/Core>
#include <array>
#include <boost/numeric/odeint.hpp>
#include <cmath>
#include <stdexcept>

namespace fastball::launch {
namespace {

/// Times at which the curve goes up through `level`, and its mean from the first of them to the
/// last.
struct Crossings {
  std::vector<double> times;
  double mean = 0;
};

Crossings crossings(const Curve& curve, double level) {
  Crossings result;
  double sum = 0, sum_at_last = 0;
  int n = 0, n_at_last = 0;
  for (std::size_t i = 1; i < curve.t.size(); ++i) {
    const double before = curve.y[i - 1] - level, after = curve.y[i] - level;
    if (before < 0 && after >= 0) {
      const double part = before / (before - after);
      result.times.push_back(curve.t[i - 1] + part * (curve.t[i] - curve.t[i - 1]));
      sum_at_last = sum;
      n_at_last = n;
    }
    if (!result.times.empty()) {
      sum += curve.y[i];
      ++n;
    }
  }
  result.mean = n_at_last > 0 ? sum_at_last / n_at_last : level;
  return result;
}

}  // namespace

BendMotion passiveBend(const model::SwingModel& model,
                       double qd1,
                       double qd3,
                       double q2_start,
                       double duration,
                       double step) {
  using State = std::array<double, 2>;
  namespace ode = boost::numeric::odeint;
  const auto rate = [&](const State& x, State& dx, double t) {
    dx = {x[1], model.passiveBend({qd1 * t, x[0], qd3 * t}, {qd1, x[1], qd3}, 0, 0)};
  };
  BendMotion motion{qd1, qd3, {}};
  State x{q2_start, 0};
  ode::integrate_const(ode::make_dense_output<ode::runge_kutta_dopri5<State>>(1e-10, 1e-10), rate,
                       x, 0.0, duration + step / 2, step, [&](const State& at, double t) {
                         motion.q2.t.push_back(t);
                         motion.q2.y.push_back(at[0]);
                       });
  return motion;
}

Oscillation oscillation(const Curve& curve) {
  const Eigen::Map<const Eigen::ArrayXd> y(curve.y.data(),
                                           static_cast<Eigen::Index>(curve.y.size()));
  // The level settles at once: the mean between crossings hardly depends on where they are.
  double level = 0.5 * (y.minCoeff() + y.maxCoeff());
  for (int round = 0; round < 3; ++round)
    level = crossings(curve, level).mean;
  const std::vector<double> times = crossings(curve, level).times;
  if (times.size() < 2)
    return {0, level};
  return {2 * M_PI * static_cast<double>(times.size() - 1) / (times.back() - times.front()), level};
}

Line fitLine(const std::vector<double>& x, const std::vector<double>& y) {
  const Eigen::Index n = static_cast<Eigen::Index>(x.size());
  const Eigen::Map<const Eigen::ArrayXd> X(x.data(), n), Y(y.data(), n);
  if (n < 2 || x.size() != y.size() || X.maxCoeff() == X.minCoeff())
    throw std::invalid_argument("a line needs two points with different x");
  const Eigen::ArrayXd dx = X - X.mean();
  const double slope = (dx * Y).sum() / dx.square().sum();
  return {slope, Y.mean() - slope * X.mean()};
}

}  // namespace fastball::launch
