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

}  // namespace fastball::planner
