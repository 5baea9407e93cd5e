#include "hand_server/release_timing.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "hand_server/hand_sample.h"

namespace fastball::hand_server {
namespace {

int64_t microseconds(double seconds) {
  return std::llround(seconds * 1e6);
}

}  // namespace

ReleaseTiming::ReleaseTiming(const model::Arm& arm,
                             const Eigen::Vector3d& p_HBall,
                             const HandServerConfig& config)
    : arm_(arm), p_HBall_(p_HBall), config_(config) {}

void ReleaseTiming::beginThrow(std::shared_ptr<const PlannedGrasp> run,
                               int64_t start_utime,
                               const Eigen::Isometry3d& X_TH) {
  run_ = std::move(run);
  start_utime_ = start_utime;
  X_TH_ = X_TH;
  push_end_ = {};
  dead_times_.reset();
}

double ReleaseTiming::planTime(int64_t utime) const {
  return static_cast<double>(utime - start_utime_) / 1e6;
}

int64_t ReleaseTiming::plannedCommand() const {
  return start_utime_ + microseconds(run_->plan.t_release_command);
}

int64_t ReleaseTiming::plannedDeparture() const {
  return start_utime_ + microseconds(run_->plan.t_release);
}

/// [s], from the command to the departure, as the plan says.
double ReleaseTiming::plannedDelay() const {
  return run_->plan.t_release - run_->plan.t_release_command;
}

/// [s], of the finger that obeys last; 0 if it is not known.
double ReleaseTiming::deadTime() const {
  return dead_times_ ? *std::max_element(dead_times_->begin(), dead_times_->end()) : 0;
}

model::FingerTimes ReleaseTiming::fingerTimes() const {
  model::FingerTimes later{};
  if (dead_times_) {
    for (std::size_t i = 0; i < later.size(); ++i)
      later[i] = microseconds(deadTime() - (*dead_times_)[i]);
  }
  return later;
}

ReleaseTiming::Decision ReleaseTiming::decide(int64_t utime) {
  if (config_.release_by == ReleaseBy::kNormalForce)
    return decideByForce(planTime(utime));
  const HandPlan& plan = run_->plan;
  // In a window the moment does not matter.
  const bool shifted = plan.adapts && !config_.release.isWindow(plan.window);
  const double shift = shifted ? delay_.commandShift(mode(), config_.command_shift_max) : 0;
  // Felt dead times do not end with a tick: the nearest one.
  const double early = dead_times_ ? deadTime() + kHalfTick : 0;
  const bool due = planTime(utime) >= plan.t_swing &&
                   utime >= start_utime_ + microseconds(plan.t_release_command + shift - early);
  return due ? Decision::kRelease : Decision::kWait;
}

/// Eq. (24) at time t [s] of the plan, near the planned release only.
ReleaseTiming::Decision ReleaseTiming::decideByForce(double t) {
  const HandPlan& plan = run_->plan;
  if (t < std::max(plan.t_swing, plan.t_release_command - config_.normal_force_window))
    return Decision::kWait;
  if (t > plan.t_release_command + config_.normal_force_window)
    return Decision::kMissed;
  return push_end_.reached(pushingAcceleration(arm_, plan.arm.at(t), X_TH_, p_HBall_))
             ? Decision::kRelease
             : Decision::kWait;
}

void ReleaseTiming::command(int64_t utime) {
  commanded_utime_ = utime;
  predicted_utime_ = utime + microseconds(plannedDelay() + deadTime() + delay_.correction(mode()));
}

void ReleaseTiming::learn(int64_t departure_utime) {
  delay_.learn(mode(), plannedDelay() + deadTime(),
               1e-6 * static_cast<double>(departure_utime - commanded_utime_));
}

}  // namespace fastball::hand_server
