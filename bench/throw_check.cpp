#include "bench/throw_check.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

namespace fastball::bench {
namespace {

constexpr double kStep = 1e-4;         // [s]
constexpr double kActive = 0.01;       // of a limit, or rad or m
constexpr double kLeastActive = 0.05;  // of the time before the release

/// The rows of each limit, and how long it was active.
class Uses {
 public:
  explicit Uses(bool differential) {
    for (int row = 0; row < LimitRows::kCount; ++row) {
      names_[row] = limitName(row, differential);
      is_share_[names_[row]] = row >= LimitRows::kSpeed && row < LimitRows::kColumn;
    }
  }
  void look(const LimitRows& rows) {
    ++moments_;
    for (const auto& [name, value] : largest(rows))
      active_[name] += value > -kActive ? 1 : 0;
  }
  std::vector<LimitUsed> atRelease(const LimitRows& rows) const {
    std::vector<LimitUsed> used;
    for (const auto& [name, value] : largest(rows)) {
      const double time_active = static_cast<double>(active_.at(name)) / moments_;
      const bool active = value > -kActive;
      if (active || time_active > kLeastActive)
        used.push_back({name, is_share_.at(name) ? 1 + value : active, time_active});
    }
    return used;
  }

 private:
  std::map<std::string, double> largest(const LimitRows& rows) const {
    std::map<std::string, double> values;
    for (int row = 0; row < LimitRows::kCount; ++row) {
      const auto [at, is_new] = values.emplace(names_[row], rows.value[row]);
      at->second = std::max(at->second, rows.value[row]);
    }
    return values;
  }
  std::array<std::string, LimitRows::kCount> names_;
  std::map<std::string, bool> is_share_;
  std::map<std::string, int> active_;
  int moments_ = 0;
};

}  // namespace

ThrowCheck checkThrow(const FreeThrow& task,
                      const model::SampledTrajectory& trajectory,
                      double t_release) {
  const model::Arm& arm = *task.arm;
  ThrowCheck check;
  Uses uses(arm.parameters().differential);
  const auto look = [&](double t) {
    const LimitRows rows = limitRows(task, trajectory.at(t));
    check.violation = std::max(check.violation, rows.value.maxCoeff());
    if (t <= t_release)
      uses.look(rows);
  };
  // The arm rests before and after.
  const auto steps = static_cast<int>(std::ceil(trajectory.duration() / kStep));
  for (int k = -1; k <= steps + 1; ++k)
    look(k * kStep);
  look(trajectory.duration());
  look(t_release);
  const model::ArmMotion at = trajectory.at(t_release);
  check.release = {arm.p_WPoint(at.q, task.p_TBall), arm.pointJacobian(at.q, task.p_TBall) * at.qd};
  check.limits = uses.atRelease(limitRows(task, at));
  if (task.across_forearm) {
    const Eigen::Vector3d forearm = arm.X_WT(at.q).linear().col(2);
    check.violation = std::max(check.violation, std::abs(forearm.dot(check.release.v_WBall)));
  }
  if (!task.target)
    return check;
  const auto landing =
      model::land(check.release, *task.target, task.drag_per_metre, arm.parameters().gravity);
  const double miss = landing ? landing->landing.norm() : std::numeric_limits<double>::infinity();
  check.violation = std::max(check.violation, miss);
  check.flight_time = landing ? landing->time : 0;
  return check;
}

}  // namespace fastball::bench
