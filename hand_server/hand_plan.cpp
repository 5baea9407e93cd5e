#include "hand_server/hand_plan.h"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

namespace fastball::hand_server {
namespace {

void requireWrist(const HandPlan& plan, double limit) {
  for (int i = 0; i < 2; ++i) {
    if (!(std::abs(plan.q_wrist[i]) <= limit)) {
      throw std::invalid_argument(
          fmt::format("plan {}: wrist {} of {:.4g} rad, its limit is {:.4g} rad", plan.id,
                      i == 0 ? "roll" : "flexion", plan.q_wrist[i], limit));
    }
  }
}

void requireTimes(const HandPlan& plan) {
  const double end = plan.arm.duration();
  if (!(plan.t_swing >= 0 && plan.t_swing <= plan.t_release_command &&
        plan.t_release_command <= end)) {
    throw std::invalid_argument(
        fmt::format("plan {}: release is commanded at {:.4g} s, outside the motion from its swing "
                    "at {:.4g} s to its end "
                    "at {:.4g} s",
                    plan.id, plan.t_release_command, plan.t_swing, end));
  }
}

void requireTorques(const HandPlan& plan, const model::HandVector& tau, double limit) {
  int joint = 0;
  if (tau.cwiseAbs().maxCoeff(&joint) > limit) {
    throw std::invalid_argument(fmt::format(
        "plan {}: a grip of {:.4g} N needs {:.4g} N m at hand joint {}, its limit is {:.4g} N m",
        plan.id, plan.grip_force, tau[joint], joint, limit));
  }
}

}  // namespace

bool operator==(const HandPlan& a, const HandPlan& b) {
  return a.id == b.id && a.t_swing == b.t_swing && a.t_release_command == b.t_release_command &&
         a.t_release == b.t_release && a.window == b.window && a.grip_force == b.grip_force &&
         a.q_wrist == b.q_wrist && a.adapts == b.adapts && a.arm == b.arm;
}

PlannedGrasp planGrasp(const HandPlan& plan,
                       const model::Hand& hand,
                       const model::BallParameters& ball) {
  if (!(plan.grip_force > 0)) {
    throw std::invalid_argument(
        fmt::format("plan {}: a grip of {:.4g} N does not hold the ball, it must be positive",
                    plan.id, plan.grip_force));
  }
  requireWrist(plan, hand.parameters().wrist_limit);
  requireTimes(plan);
  PlannedGrasp result{plan, {}};
  try {
    result.geometry = model::grasp(ball, hand, plan.grip_force);
  } catch (const std::invalid_argument& e) {
    throw std::invalid_argument(fmt::format("plan {}: {}", plan.id, e.what()));
  }
  result.q = hand.posture(plan.q_wrist[0], plan.q_wrist[1], result.geometry.distances());
  result.tau = result.geometry.torques();
  requireTorques(plan, result.tau, hand.parameters().finger_torque_max);
  return result;
}

}  // namespace fastball::hand_server
