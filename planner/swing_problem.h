#pragma once

#include <Eigen/Core>
#include <string>

#include "model/arm.h"
#include "model/ball_parameters.h"
#include "model/target.h"
#include "planner/follow_through.h"
#include "planner/swing_curve.h"

namespace fastball::planner {

/// How a swing is bounded besides by the arm's own limits.
struct SwingSettings {
  Eigen::Vector3d omega_max =
      Eigen::Vector3d::Zero();  ///< [rad/s, 1/s, rad/s], of the base functions
  double elbow_margin =
      0;  ///< [rad], |J4| at least, in the swing: the map from the swing model is singular at 0
  double body_clearance =
      0;  ///< [m], ball centre from the axis of the column that carries the shoulder, at least
  double lowest_ball = 0;  ///< [m], world z of the ball centre, at least
  double wrist_limit = 0;  ///< [rad], |roll| of the wrist at most
  FollowThrough follow;
};

/// One throw to be optimised by Eq. (15).
struct SwingTask {
  const model::Arm* arm = nullptr;
  model::BallParameters ball;
  model::Target target;
  Eigen::Vector2d aim = Eigen::Vector2d::Zero();      ///< [m], plane coordinates of the landing
  Eigen::Vector3d p_TBall = Eigen::Vector3d::Zero();  ///< [m], ball centre in the grasp
  SwingSettings settings;
  double limit_factor = 1;  ///< the share of speed and torque limits that may be used
  bool must_land = true;    ///< false: fastest throw of all, wherever it goes
};

/// What Eq. (15) asks of parameters x. Inequalities hold where <= 0, equalities where 0.
class SwingProblem {
 public:
  static constexpr int kEarlySamples = 22, kLateSamples = 26, kBrakeSamples = 8;
  static constexpr int kSwingSamples = kEarlySamples + kLateSamples;
  static constexpr int kPerSample = 11;
  static constexpr int kInequalities = kPerSample * (kSwingSamples + kBrakeSamples) + 2;
  static constexpr int kEqualities = 4;
  struct Values {
    double release_speed = 0;  ///< [m/s]
    Eigen::Matrix<double, kInequalities, 1> inequalities;
    /// Ball velocity along the forearm [m/s] (Eq. 25); ball at the flight time minus the point aimed at [m].
    Eigen::Matrix<double, kEqualities, 1> equalities;
    /// Largest violation of any constraint; infinite if one is not finite.
    double violation() const;
  };

  SwingProblem(const SwingTask& task, int elbow_sign);
  Values evaluate(const SwingVector& x) const;
  /// The constraint that x violates most, in words ("breaks the range of joint 3 (by 0.1 of it)").
  std::string worstConstraint(const SwingVector& x) const;
  const SwingVector& lower() const { return lower_; }
  const SwingVector& upper() const { return upper_; }
  const SwingTask& task() const { return task_; }
  int elbowSign() const { return elbow_sign_; }
  /// How many of the equalities hold for the task: without a landing only the first.
  int equalityCount() const { return task_.must_land ? kEqualities : 1; }

 private:
  void atSample(const model::ArmMotion& motion, bool swinging, double* c) const;
  void atRelease(const SwingVector& x, const model::ArmMotion& motion, Values& values) const;
  SwingTask task_;
  int elbow_sign_;
  SwingVector lower_, upper_;
};

/// A solved swing.
struct SwingSolution {
  SwingVector x = SwingVector::Zero();
  int elbow_sign = 1;
  double release_speed = 0;  ///< [m/s]
  double violation = 0;      ///< of the constraints, as SwingProblem states them
  int evaluations = 0;
};

/// NLopt's SLSQP from `start`, at most `max_evaluations` evaluations of the problem with gradient.
SwingSolution optimiseSwing(const SwingTask& task,
                            const SwingVector& start,
                            int elbow_sign,
                            int max_evaluations);

/// The solution of `task` that lies nearest to `near` (in variables over their scales) instead of the fastest: for a task
/// that differs little from the one that `near` solves.
SwingSolution correctSwing(const SwingTask& task, const SwingSolution& near, int max_evaluations);

}  // namespace fastball::planner
