#include "planner/whole_motion.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "planner/polynomial.h"

namespace fastball::planner {
namespace {

constexpr double kShortestApproach = 0.2;  // [s]

model::ArmMotion approach(const Eigen::Vector4d& from,
                          const Eigen::Vector4d& to,
                          double T,
                          double t) {
  // One quintic for the way along the straight line between the poses.
  const model::BaseValue way = quinticAt({0, 0, 0}, {1, 0, 0}, T, std::min(t, T));
  return {from + way.q * (to - from), way.qd * (to - from), way.qdd * (to - from)};
}

}  // namespace

double approachTime(const model::Arm& arm,
                    const MotionSettings& settings,
                    const Eigen::Vector4d& from,
                    const Eigen::Vector4d& to) {
  // The speed of a quintic from rest to rest peaks at 15/8 of its mean.
  return std::max(kShortestApproach, 1.875 * arm.speedRatio(to - from) / settings.approach_speed);
}

WholeMotion wholeMotion(const model::Arm& arm,
                        const MotionSettings& settings,
                        const Eigen::Vector4d& q_arm,
                        const SwingMotion& swing) {
  WholeMotion motion;
  const model::ArmMotion ready = swing.at(swing.begin);
  motion.t_ready = approachTime(arm, settings, q_arm, ready.q);
  const double brake = swing.brake_time.maxCoeff();
  const double least = motion.t_ready + settings.ready_time - swing.begin + swing.end + brake;
  // Whole milliseconds; the release falls on a sample.
  const double sample_ms = std::max(std::round(1e3 * settings.sample_time),
                                    std::ceil(1e3 * least / (settings.max_samples - 3)));
  const double dt = 1e-3 * sample_ms;
  const auto sampleAtOrAfter = [dt](double t) { return std::ceil(t / dt - 1e-9); };
  const double zero_sample = sampleAtOrAfter(motion.t_ready + settings.ready_time - swing.begin);
  motion.t_zero = 1e-3 * sample_ms * zero_sample;
  motion.t_swing = motion.t_zero + swing.begin;
  motion.t_swing_end = motion.t_zero + swing.end;
  const int last = static_cast<int>(sampleAtOrAfter(motion.t_swing_end + brake));

  std::vector<model::ArmMotion> samples(last + 1);
  const FollowThrough follow{swing.end, swing.brake_time};
  std::optional<model::ArmMotion> braking;
  for (int k = 0; k <= last; ++k) {
    const double t = k * dt;
    if (t <= motion.t_swing) {
      samples[k] = approach(q_arm, ready.q, motion.t_ready, t);
    } else if (t <= motion.t_swing_end) {
      samples[k] = swing.at(t - motion.t_zero);
    } else {
      if (!braking)
        braking = swing.at(swing.end);
      samples[k] = follow.braked(*braking, t - motion.t_swing_end);
    }
  }
  samples.front() = {q_arm, Eigen::Vector4d::Zero(), Eigen::Vector4d::Zero()};
  samples.back().qd.setZero();
  samples.back().qdd.setZero();
  motion.trajectory = model::SampledTrajectory(dt, std::move(samples));
  return motion;
}

WholeMotion wholeMotion(const model::Arm& arm,
                        const MotionSettings& settings,
                        const FollowThrough& follow,
                        const Eigen::Vector4d& q_arm,
                        const SwingCurve& swing) {
  // Joint 3 is known but for whole turns: it goes on from the last time asked for.
  double q3_near = swing.at(swing.begin()).q[2];
  const auto at = [&](double t) {
    const model::ArmMotion motion = swing.at(t, q3_near);
    q3_near = motion.q[2];
    return motion;
  };
  return wholeMotion(arm, settings, q_arm, {swing.begin(), follow.delay, follow.brake_time, at});
}

}  // namespace fastball::planner
