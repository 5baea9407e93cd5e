#pragma once

#include <Eigen/Core>
#include <vector>

#include "bench/spline_basis.h"
#include "bench/throw_limits.h"

namespace fastball::bench {

/// A throw with one curve of a SplineBasis for each joint over the share s = 0..1 of the whole motion.
/// Variables: the curves' coordinates joint by joint (a held shoulder: its angle), then the whole
/// motion's duration [s], the release's s, and the flight time [s].
class FreeFormProblem {
 public:
  FreeFormProblem(const FreeThrow& task, int control_points);

  const FreeThrow& task() const { return task_; }
  const SplineBasis& basis() const { return basis_; }
  int size() const { return size_; }
  /// Where joint j's coordinates begin, and how many they are.
  int first(int joint) const { return first_[joint]; }
  int count(int joint) const { return first_[joint + 1] - first_[joint]; }
  int durationIndex() const { return size_ - 3; }
  int releaseIndex() const { return size_ - 2; }
  int flightIndex() const { return size_ - 1; }
  /// Bounds of the variables; those of the coordinates are infinite.
  Eigen::VectorXd lower() const;
  Eigen::VectorXd upper() const;

  /// With the basis at s, which may be computed beforehand.
  model::ArmMotion motion(const Eigen::VectorXd& x, const SplineBasis::Rows& at) const;
  model::ArmMotion motion(const Eigen::VectorXd& x, double s) const {
    return motion(x, basis_.at(s));
  }
  ReleaseRows release(const Eigen::VectorXd& x) const;

  /// Gradient by x of a function of the motion at s from its derivatives by (q, qd, qdd).
  void gradient(const SplineBasis::Rows& at,
                const model::ArmMotion& motion,
                double duration,
                const Eigen::RowVector4d& by_q,
                const Eigen::RowVector4d& by_qd,
                const Eigen::RowVector4d& by_qdd,
                Eigen::Ref<Eigen::VectorXd> gradient) const;
  /// Gradients by x of functions of the release from their derivatives by (q, qd, flight time).
  Eigen::MatrixXd releaseGradient(const Eigen::VectorXd& x, const Eigen::MatrixXd& slopes) const;

 private:
  FreeThrow task_;
  SplineBasis basis_;
  std::array<int, model::kArmJoints + 1> first_{};
  int size_;
};

/// The throw x of a problem that holds the shoulder, as one of the same problem that does not.
Eigen::VectorXd withFreeShoulder(const FreeFormProblem& held,
                                 const Eigen::VectorXd& x,
                                 const FreeFormProblem& free);

}  // namespace fastball::bench
