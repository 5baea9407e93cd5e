#include "bench/free_form_problem.h"

#include <limits>

namespace fastball::bench {
namespace {

using model::kArmJoints;

// [s]; a motion that takes longer than the longest has no more room to gather speed in the joints' ranges.
constexpr double kShortest = 0.2, kLongest = 2.0;
// Of the motion, before and after the release.
constexpr double kLeastShare = 0.15;
constexpr double kShortestFlight = 0.02, kLongestFlight = 3.0;  // [s]

}  // namespace

FreeFormProblem::FreeFormProblem(const FreeThrow& task, int control_points)
    : task_(task), basis_(control_points) {
  for (int j = 0; j < kArmJoints; ++j)
    first_[j + 1] = first_[j] + (j == 1 && task.hold_shoulder ? 1 : basis_.size());
  size_ = first_[kArmJoints] + 3;
}

Eigen::VectorXd FreeFormProblem::lower() const {
  Eigen::VectorXd bound =
      Eigen::VectorXd::Constant(size_, -std::numeric_limits<double>::infinity());
  bound.tail<3>() << kShortest, kLeastShare, kShortestFlight;
  return bound;
}

Eigen::VectorXd FreeFormProblem::upper() const {
  Eigen::VectorXd bound = Eigen::VectorXd::Constant(size_, std::numeric_limits<double>::infinity());
  bound.tail<3>() << kLongest, 1 - kLeastShare, kLongestFlight;
  return bound;
}

model::ArmMotion FreeFormProblem::motion(const Eigen::VectorXd& x,
                                         const SplineBasis::Rows& at) const {
  model::ArmMotion motion;
  const double T = x[durationIndex()];
  for (int j = 0; j < kArmJoints; ++j) {
    if (count(j) == 1) {
      motion.q[j] = x[first(j)];
      continue;
    }
    const Eigen::Vector3d curve = at * x.segment(first(j), count(j));
    motion.q[j] = curve[0];
    motion.qd[j] = curve[1] / T;
    motion.qdd[j] = curve[2] / (T * T);
  }
  return motion;
}

ReleaseRows FreeFormProblem::release(const Eigen::VectorXd& x) const {
  const model::ArmMotion at = motion(x, x[releaseIndex()]);
  return releaseRows(task_, at.q, at.qd, x[flightIndex()]);
}

void FreeFormProblem::gradient(const SplineBasis::Rows& at,
                               const model::ArmMotion& motion,
                               double duration,
                               const Eigen::RowVector4d& by_q,
                               const Eigen::RowVector4d& by_qd,
                               const Eigen::RowVector4d& by_qdd,
                               Eigen::Ref<Eigen::VectorXd> gradient) const {
  for (int j = 0; j < kArmJoints; ++j) {
    if (count(j) == 1) {
      gradient[first(j)] = by_q[j];
      continue;
    }
    const Eigen::RowVector3d weights(by_q[j], by_qd[j] / duration,
                                     by_qdd[j] / (duration * duration));
    gradient.segment(first(j), count(j)) = (weights * at).transpose();
  }
  gradient.tail<3>() << -(by_qd.dot(motion.qd) + 2 * by_qdd.dot(motion.qdd)) / duration, 0, 0;
}

Eigen::MatrixXd FreeFormProblem::releaseGradient(const Eigen::VectorXd& x,
                                                 const Eigen::MatrixXd& slopes) const {
  const double T = x[durationIndex()];
  const SplineBasis::Rows at = basis_.at(x[releaseIndex()]);
  const model::ArmMotion now = motion(x, at);
  Eigen::MatrixXd gradients(slopes.rows(), size_);
  Eigen::VectorXd row(size_);
  for (int i = 0; i < slopes.rows(); ++i) {
    const Eigen::RowVector4d by_q = slopes.block<1, kArmJoints>(i, 0);
    const Eigen::RowVector4d by_qd = slopes.block<1, kArmJoints>(i, kArmJoints);
    gradient(at, now, T, by_q, by_qd, Eigen::RowVector4d::Zero(), row);
    row[releaseIndex()] = T * (by_q.dot(now.qd) + by_qd.dot(now.qdd));
    row[flightIndex()] = slopes(i, 2 * kArmJoints);
    gradients.row(i) = row.transpose();
  }
  return gradients;
}

Eigen::VectorXd withFreeShoulder(const FreeFormProblem& held,
                                 const Eigen::VectorXd& x,
                                 const FreeFormProblem& free) {
  Eigen::VectorXd result(free.size());
  for (int j = 0; j < kArmJoints; ++j) {
    if (held.count(j) == 1) {
      const int places = 2 * free.count(j);
      result.segment(free.first(j), free.count(j)) =
          free.basis().fit(Eigen::VectorXd::LinSpaced(places, 0, 1),
                           Eigen::VectorXd::Constant(places, x[held.first(j)]));
    } else {
      result.segment(free.first(j), free.count(j)) = x.segment(held.first(j), held.count(j));
    }
  }
  result.tail<3>() = x.tail<3>();
  return result;
}

}  // namespace fastball::bench
