#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "planner/release_conditions.h"
#include "planner/swing_curve.h"
#include "planner/swing_limits.h"
#include "planner/swing_task.h"

namespace fastball::planner {

/// What Eq. (15) asks of parameters x. Inequalities hold where <= 0, equalities where 0.
///
/// The swing's limits hold at every time, not only at samples: a constraint is the highest point of one limit in
/// one window of time. It is found on a grid and between the grid's points by parabolas. Because nothing in the
/// motion has a kink, the derivative of such a peak by x is that of the limit at the peak's time.
class SwingProblem {
 public:
  static constexpr int kEqualities = ReleaseConditions::kEqualities;
  /// The highest point of one limit in one window.
  struct Peak {
    double value = -1;
    double time = 0;     ///< [s], from the release
    double q3_near = 0;  ///< [rad], to find the motion again
  };
  struct Values {
    double release_speed = 0;  ///< [m/s]
    /// Peaks in the order of rows(), then Eq. (24), then how much of the wrist's range is exceeded, then
    /// how much too flatly the ball meets the ring.
    Eigen::VectorXd inequalities;
    Eigen::Matrix<double, kEqualities, 1> equalities;
    std::vector<Peak> peaks;
    double q3_brake = 0;  ///< [rad], where the follow-through begins
    /// Largest violation of any constraint; infinite if one is not finite.
    double violation() const;
  };
  struct Gradients {
    SwingVector release_speed = SwingVector::Zero();
    Eigen::Matrix<double, Eigen::Dynamic, kSwingVariables, Eigen::RowMajor> inequalities;
    Eigen::Matrix<double, kEqualities, kSwingVariables, Eigen::RowMajor> equalities;
  };
  /// One limit in one window.
  struct Row {
    SwingLimit limit;
    int window;
  };

  SwingProblem(const SwingTask& task, int elbow_sign);
  SwingProblem(const SwingProblem&) = delete;
  SwingProblem& operator=(const SwingProblem&) = delete;

  Values evaluate(const SwingVector& x) const;
  /// @param values what evaluate(x) gave.
  Gradients gradients(const SwingVector& x, const Values& values) const;
  /// The constraint that x violates most, in words ("breaks the range of joint 3 (by 0.1 of it)").
  std::string worstConstraint(const SwingVector& x) const;
  /// Whether a variable is one at all.
  bool isFree(int variable) const {
    return lower_[variable] < upper_[variable] && !task_.fixed[variable];
  }
  const SwingVector& lower() const { return lower_; }
  const SwingVector& upper() const { return upper_; }
  const SwingTask& task() const { return task_; }
  int elbowSign() const { return elbow_sign_; }
  const std::vector<Row>& rows() const { return rows_; }
  /// Times [s] from the release at which the limits are evaluated before the peaks are looked for.
  const std::vector<double>& grid() const { return grid_; }
  int inequalityCount() const { return static_cast<int>(rows_.size()) + 3; }
  /// How many of the equalities hold for the task.
  int equalityCount() const {
    return task_.must_land ? kEqualities : ReleaseConditions::kDirectionEqualities;
  }

 private:
  /// Part of the swing or of the follow-through, with the grid points in it, both ends included.
  struct Window {
    int first, last;
  };
  class Motion;
  void addWindow(double end, double step);
  void setBounds();
  bool braking(const Window& window) const {
    return grid_[window.first] >= task_.settings.follow.delay;
  }
  Peak peak(const Row& row, const Motion& motion) const;
  double rollLimit() const;

  SwingTask task_;
  int elbow_sign_;
  SwingLimits limits_;
  ReleaseConditions release_;
  SwingVector lower_, upper_;
  std::vector<double> grid_;  ///< [s] from the release
  std::vector<Window> windows_;
  std::vector<Row> rows_;
};

/// What a second of flight is worth for SwingGoal::kShortestFlight [m/s per s].
inline constexpr double kFlightWorth = 10;

/// A solved swing.
struct SwingSolution {
  SwingVector x = SwingVector::Zero();
  int elbow_sign = 1;
  double release_speed = 0;  ///< [m/s]
  double violation = 0;      ///< of the constraints, as SwingProblem states them
};

/// NLopt's SLSQP from `start`, at most `max_evaluations` evaluations of the problem.
/// @param to_beat [m/s], of a solution already known: the search is given up when it does not look like becoming faster.
SwingSolution optimiseSwing(const SwingTask& task,
                            const SwingVector& start,
                            int elbow_sign,
                            int max_evaluations,
                            double to_beat = 0);

/// The solution of `task` that lies nearest to `near` (in variables over their scales) instead of the fastest: for a task
/// that differs little from the one that `near` solves.
SwingSolution correctSwing(const SwingTask& task, const SwingSolution& near, int max_evaluations);

}  // namespace fastball::planner
