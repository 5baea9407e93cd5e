#include "model/landing_biases.h"

#include <stdexcept>

namespace fastball::model {
namespace {

// Steps of the central differences: landings are smooth over centimetres.
constexpr double kDragStep = 1e-3, kVelocityStep = 1e-3;  // share, [m/s]

Eigen::Vector2d landingOf(const BallState& release,
                          const Target& target,
                          double drag_per_metre,
                          double gravity) {
  const auto landing = land(release, target, drag_per_metre, gravity);
  if (!landing)
    throw std::invalid_argument("a ball that does not reach the target's plane has no landing");
  return landing->landing;
}

}  // namespace

LandingJacobian landingJacobian(const BallState& release,
                                const Target& target,
                                const BallParameters& ball,
                                double gravity) {
  const double k = ball.dragPerMetre();
  Eigen::Matrix3d R_WAim;  // towards the target, left, up
  const Eigen::Vector3d to_target = target.p_WTarget - release.p_WBall;
  const Eigen::Vector3d forward = Eigen::Vector3d(to_target.x(), to_target.y(), 0).normalized();
  R_WAim << forward, Eigen::Vector3d::UnitZ().cross(forward), Eigen::Vector3d::UnitZ();
  LandingJacobian H;
  H.col(0) = (landingOf(release, target, k * (1 + kDragStep), gravity) -
              landingOf(release, target, k * (1 - kDragStep), gravity)) /
             (2 * kDragStep);
  for (int axis = 0; axis < 3; ++axis) {
    BallState faster = release, slower = release;
    faster.v_WBall += kVelocityStep * R_WAim.col(axis);
    slower.v_WBall -= kVelocityStep * R_WAim.col(axis);
    H.col(1 + axis) =
        (landingOf(faster, target, k, gravity) - landingOf(slower, target, k, gravity)) /
        (2 * kVelocityStep);
  }
  H.rightCols<2>() = -Eigen::Matrix2d::Identity();
  return H;
}

}  // namespace fastball::model
