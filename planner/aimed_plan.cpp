#include "planner/aimed_plan.h"

#include <algorithm>
#include <utility>

#include "model/landing_biases.h"

namespace fastball::planner {
namespace {

/// No aim is farther [m] from the target's centre: beyond that it is the biases that are wrong.
constexpr double kFarthestAim = 0.3;

/// More than the farthest aim changes a throw: share of the velocity of the leaving ball.
constexpr double kOtherThrow = 0.1;

/// [s], shorter is no release window: a plan without one names how well it knows the time of the release.
constexpr double kShortestWindow = 0.005;

/// Where an aim can only be reached by a throw of another kind, without a window or much faster, nothing that was learned holds
/// for it.
bool alike(const Plan& a, const Plan& b) {
  const auto window = [](const Plan& plan) {
    return plan.release_window[1] - plan.release_window[0] >= kShortestWindow;
  };
  const Eigen::Vector3d& v_WBall = b.release.v_WBall;
  return window(a) == window(b) &&
         (a.release.v_WBall - v_WBall).norm() < kOtherThrow * v_WBall.norm();
}

PlanResult planTowards(const Planner& planner,
                       const ThrowRequest& request,
                       const Eigen::Vector2d& aim) {
  ThrowRequest aimed = request;
  aimed.target.p_WTarget +=
      aim.x() * request.target.rightAxis() + aim.y() * request.target.upAxis();
  PlanResult result = planner.plan(aimed);
  if (Plan* plan = std::get_if<Plan>(&result))
    plan->landing += aim;
  return result;
}

}  // namespace

PlanResult planAimed(const Planner& planner, const ThrowRequest& request) {
  PlanResult result = planner.plan(request);
  Plan* plan = std::get_if<Plan>(&result);
  if (plan == nullptr || request.biases.isZero())
    return result;
  const auto expected = [&](const Plan& of) -> Eigen::Vector2d {
    return model::landingJacobian(of.release, request.target, planner.config().ball,
                                  planner.config().arm.gravity) *
           request.biases;
  };
  Eigen::Vector2d aim = -expected(*plan);
  aim *= std::min(1.0, kFarthestAim / aim.norm());
  for (const double share : {1.0, 0.5, 0.25}) {
    PlanResult aimed = planTowards(planner, request, share * aim);
    if (Plan* nearer = std::get_if<Plan>(&aimed); nearer && alike(*nearer, *plan)) {
      result = std::move(aimed);
      break;
    }
  }
  plan = &std::get<Plan>(result);
  plan->landing += expected(*plan);
  return result;
}

}  // namespace fastball::planner
