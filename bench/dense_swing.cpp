#include "bench/dense_swing.h"

#include <algorithm>
#include <cmath>
#include <nlopt.hpp>
#include <vector>

namespace fastball::bench {
namespace {

using planner::SwingVector;

constexpr double kStep = 1e-7;       // of the differences
constexpr double kTolerance = 1e-5;  // as the planner's
constexpr double kSettled = 5e-6;

class DenseSwing {
 public:
  DenseSwing(const planner::SwingTask& task, const SwingVector& start, int elbow_sign, int samples)
      : task_(task),
        bounds_(task_, elbow_sign),
        limits_(task_, elbow_sign),
        release_(task_),
        x_(start),
        elbow_sign_(elbow_sign),
        samples_(samples) {
    for (int i = 0; i < planner::kSwingVariables; ++i) {
      if (bounds_.isFree(i))
        free_.push_back(i);
    }
  }

  unsigned size() const { return static_cast<unsigned>(free_.size()); }
  unsigned inequalityCount() const {
    return static_cast<unsigned>(planner::kSwingLimits * samples_ + 1);
  }
  unsigned equalityCount() const { return static_cast<unsigned>(bounds_.equalityCount()); }
  std::vector<double> free(const SwingVector& x) const {
    std::vector<double> u;
    for (const int i : free_)
      u.push_back(x[i]);
    return u;
  }
  SwingVector whole(const double* u) const {
    SwingVector x = x_;
    for (std::size_t k = 0; k < free_.size(); ++k)
      x[free_[k]] = u[k];
    return x;
  }
  const planner::SwingProblem& bounds() const { return bounds_; }

  /// Objective, inequalities, equalities in one column.
  const Eigen::VectorXd& values(const double* u) {
    const SwingVector x = whole(u);
    if (values_.size() == 0 || x != at_) {
      at_ = x;
      values_ = evaluate(x);
      has_slopes_ = false;
    }
    return values_;
  }
  /// Their derivatives by the free variables, one column each.
  const Eigen::MatrixXd& slopes(const double* u) {
    values(u);
    if (!has_slopes_) {
      has_slopes_ = true;
      slopes_.resize(values_.size(), size());
      for (unsigned k = 0; k < size(); ++k)
        slopes_.col(k) = (evaluate(at_ + kStep * SwingVector::Unit(free_[k])) - values_) / kStep;
    }
    return slopes_;
  }

 private:
  Eigen::VectorXd evaluate(const SwingVector& x) const {
    const planner::SwingCurve curve(x, elbow_sign_);
    const planner::HeldBall held(*task_.hand, x[planner::kWristRoll], x[planner::kWristFlexion]);
    const planner::FollowThrough& follow = task_.settings.follow;
    const double begin = curve.begin(), end = follow.delay + follow.brake_time.maxCoeff();
    Eigen::VectorXd column(1 + inequalityCount() + planner::SwingProblem::kEqualities);
    model::ArmMotion motion, brake_start;
    for (int i = 0; i < samples_; ++i) {
      const double t = begin + (end - begin) * i / (samples_ - 1);
      if (t <= follow.delay) {
        motion = curve.at(t, motion.q[2]);
        brake_start = curve.at(follow.delay, motion.q[2]);
      } else {
        motion = follow.braked(brake_start, t - follow.delay);
      }
      auto values = column.segment<planner::kSwingLimits>(1 + planner::kSwingLimits * i);
      values = limits_.at(motion, held.p_TBall);
      if (t > follow.delay)
        values[planner::kElbow] = -1;
    }
    const auto release = release_.values(x, curve.at(0));
    column[0] = -0.05 * release.speed * release.speed;
    column[inequalityCount()] = release.hand_lead;
    column.tail<planner::SwingProblem::kEqualities>() = release.equalities;
    return column;
  }

  planner::SwingTask task_;
  planner::SwingProblem bounds_;
  planner::SwingLimits limits_;
  planner::ReleaseConditions release_;
  SwingVector x_, at_ = SwingVector::Zero();
  int elbow_sign_, samples_;
  std::vector<int> free_;
  Eigen::VectorXd values_;
  Eigen::MatrixXd slopes_;
  bool has_slopes_ = false;
};

double objective(unsigned n, const double* u, double* gradient, void* data) {
  auto& swing = *static_cast<DenseSwing*>(data);
  if (gradient != nullptr)
    Eigen::Map<Eigen::RowVectorXd>(gradient, n) = swing.slopes(u).row(0);
  return swing.values(u)[0];
}

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

void inequalities(unsigned m,
                  double* c,
                  unsigned n,
                  const double* u,
                  double* gradient,
                  void* data) {
  auto& swing = *static_cast<DenseSwing*>(data);
  Eigen::Map<Eigen::VectorXd>(c, m) = swing.values(u).segment(1, m);
  if (gradient != nullptr)
    Eigen::Map<RowMajor>(gradient, m, n) = swing.slopes(u).middleRows(1, m);
}

void equalities(unsigned m, double* c, unsigned n, const double* u, double* gradient, void* data) {
  auto& swing = *static_cast<DenseSwing*>(data);
  const auto first = 1 + swing.inequalityCount();
  Eigen::Map<Eigen::VectorXd>(c, m) = swing.values(u).segment(first, m);
  if (gradient != nullptr)
    Eigen::Map<RowMajor>(gradient, m, n) = swing.slopes(u).middleRows(first, m);
}

}  // namespace

planner::SwingSolution optimiseDensely(const planner::SwingTask& task,
                                       const SwingVector& start,
                                       int elbow_sign,
                                       int samples,
                                       int max_evaluations) {
  DenseSwing swing(task, start, elbow_sign, samples);
  const planner::SwingProblem& bounds = swing.bounds();
  std::vector<double> u = swing.free(start.cwiseMax(bounds.lower()).cwiseMin(bounds.upper()));
  nlopt::opt optimiser(nlopt::LD_SLSQP, swing.size());
  optimiser.set_lower_bounds(swing.free(bounds.lower()));
  optimiser.set_upper_bounds(swing.free(bounds.upper()));
  optimiser.set_min_objective(objective, &swing);
  optimiser.add_inequality_mconstraint(inequalities, &swing,
                                       std::vector<double>(swing.inequalityCount(), kTolerance));
  optimiser.add_equality_mconstraint(equalities, &swing,
                                     std::vector<double>(swing.equalityCount(), kTolerance));
  optimiser.set_maxeval(max_evaluations);
  optimiser.set_ftol_abs(kSettled);
  double value = 0;
  try {
    optimiser.optimize(u, value);
  } catch (const std::exception&) {
    // u is the best so far.
  }
  planner::SwingSolution solution;
  solution.x = swing.whole(u.data());
  solution.elbow_sign = elbow_sign;
  const planner::SwingProblem::Values values = bounds.evaluate(solution.x);
  solution.release_speed = values.release_speed;
  solution.violation = values.violation();
  return solution;
}

}  // namespace fastball::bench
