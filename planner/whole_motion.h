#pragma once

#include <functional>

#include "model/arm.h"
#include "model/trajectory.h"
#include "planner/follow_through.h"
#include "planner/swing_curve.h"

namespace fastball::planner {

/// What surrounds a swing.
struct MotionSettings {
  double sample_time = 0;     ///< [s], whole milliseconds
  int max_samples = 0;        ///< a longer motion is sampled more coarsely
  double ready_time = 0;      ///< [s], the arm rests at least so long before the swing
  double approach_speed = 0;  ///< share of the speed limits that the approach uses
};

/// A throw from rest to rest.
struct WholeMotion {
  model::SampledTrajectory trajectory;
  double t_ready = 0, t_swing = 0, t_swing_end = 0;  ///< [s] from the start, as Plan has them
  double t_zero = 0;  ///< [s], time of the swing's t = 0, a sample; a release window begins there
  double window = 0;  ///< [s], length of the release window, 0: none
};

/// A swing from rest to where braking begins. t = 0 is a sample of the whole motion.
struct SwingMotion {
  double begin = 0;  ///< [s], negative; at rest before
  double end = 0;    ///< [s]
  Eigen::Vector4d brake_time =
      Eigen::Vector4d::Zero();  ///< [s], then each joint comes to rest in this time
  std::function<model::ArmMotion(double t)> at;  ///< asked for in order of time
};

/// Approach from q_arm [rad] (quintic), rest, swing, braking (quartics).
WholeMotion wholeMotion(const model::Arm& arm,
                        const MotionSettings& settings,
                        const Eigen::Vector4d& q_arm,
                        const SwingMotion& swing);

/// The same for a swing by base functions.
WholeMotion wholeMotion(const model::Arm& arm,
                        const MotionSettings& settings,
                        const FollowThrough& follow,
                        const Eigen::Vector4d& q_arm,
                        const SwingCurve& swing);

/// Time [s] that the approach from one pose to another takes.
double approachTime(const model::Arm& arm,
                    const MotionSettings& settings,
                    const Eigen::Vector4d& from,
                    const Eigen::Vector4d& to);

}  // namespace fastball::planner
