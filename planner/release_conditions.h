#pragma once

#include <Eigen/Core>

#include "model/arm_derivatives.h"
#include "model/ball_flight.h"
#include "planner/swing_curve.h"
#include "planner/swing_task.h"

namespace fastball::planner {

/// What is asked at the release, t = 0 of a swing.
class ReleaseConditions {
 public:
  static constexpr int kEqualities = 5;
  /// Without a landing only the first two equalities are asked for.
  static constexpr int kDirectionEqualities = 2;
  struct Values {
    double speed = 0;  ///< [m/s], of the ball
    /// Eq. (24), not positive: the hand falls behind the ball; in 20 m/s^2.
    double hand_lead = 0;
    /// Not positive: the ball comes through the ring from its front, no flatter than the task asks.
    double grazing = -1;
    /// Ball velocity along x and z of H [m/s] (Eq. 25); ball at the flight time minus the point aimed at [m]: in
    /// front of the target plane, to the right and up in it.
    Eigen::Matrix<double, kEqualities, 1> equalities;
  };
  /// By the parameters of the swing.
  struct Gradients {
    SwingVector speed, hand_lead, grazing;
    Eigen::Matrix<double, kEqualities, kSwingVariables, Eigen::RowMajor> equalities;
  };

  /// @param task must outlive this.
  explicit ReleaseConditions(const SwingTask& task) : task_(task) {}
  /// @param x parameters of the swing. @param motion that they make at t = 0.
  Values values(const SwingVector& x, const model::ArmMotion& motion) const;
  Gradients gradients(const SwingVector& x, const SwingDerivatives& at_release) const;

 private:
  model::FlightDerivatives flight(const model::PointMotion& ball, double duration) const;
  const SwingTask& task_;
};

}  // namespace fastball::planner
