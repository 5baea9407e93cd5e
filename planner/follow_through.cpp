#include "planner/follow_through.h"

#include "planner/polynomial.h"

namespace fastball::planner {

model::ArmMotion FollowThrough::braked(const model::ArmMotion& from, double t) const {
  model::ArmMotion motion;
  for (int j = 0; j < motion.q.size(); ++j) {
    const model::BaseValue value = brakeAt({from.q[j], from.qd[j], from.qdd[j]}, brake_time[j], t);
    motion.q[j] = value.q;
    motion.qd[j] = value.qd;
    motion.qdd[j] = value.qdd;
  }
  return motion;
}

MotionGradient FollowThrough::beforeBraking(const MotionGradient& g, double t) const {
  // Braking is linear in the motion from which it begins.
  MotionGradient before;
  for (int j = 0; j < g.q.size(); ++j) {
    const auto pulled = [&](const model::BaseValue& unit) {
      const model::BaseValue d = brakeAt(unit, brake_time[j], t);
      return g.q[j] * d.q + g.qd[j] * d.qd + g.qdd[j] * d.qdd;
    };
    before.q[j] = pulled({1, 0, 0});
    before.qd[j] = pulled({0, 1, 0});
    before.qdd[j] = pulled({0, 0, 1});
  }
  return before;
}

}  // namespace fastball::planner
