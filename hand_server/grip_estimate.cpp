#include "hand_server/grip_estimate.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "model/contact.h"

namespace fastball::hand_server {
namespace {

constexpr double kAverage = 0.020;   // [s]
constexpr double kLeastForce = 0.2;  // [N], of a finger that holds the ball
constexpr double kSoftest = 2e4;     // [Pa], of flexible foam
constexpr double kHardest = 1e8;     // [Pa], beyond it the fingers give way, not the ball
constexpr double kFarthest = 0.03;   // [m], from the hand's axis; along it, from the planned place
constexpr double kExact = 1e-9;      // [m]
constexpr int kMostSteps = 20;

/// The ball's centre and how it gives: x, y [m] and 1/sqrt(E) [Pa^-1/2], to which a deformation is about proportional.
using Unknowns = Eigen::Vector3d;

bool sensible(const Unknowns& x) {
  return x.allFinite() && x.head<2>().norm() < kFarthest && x[2] > 1 / std::sqrt(kHardest) &&
         x[2] < 1 / std::sqrt(kSoftest);
}

/// The equations' errors [m] and their derivatives.
struct Equations {
  Eigen::Vector3d error;
  Eigen::Matrix3d slope;
};

std::optional<Equations> equations(const Unknowns& x,
                                   const std::array<model::Segment, model::kFingers>& axes,
                                   const FingerForces& force,
                                   model::BallParameters ball,
                                   const model::HandParameters& hand) {
  ball.youngs_modulus = 1 / (x[2] * x[2]);
  Equations result;
  for (int i = 0; i < model::kFingers; ++i) {
    if (!(force[i] < model::maximumForce(ball)))
      return {};
    const Eigen::Vector3d along = (axes[i].p_end - axes[i].p_start).normalized();
    const Eigen::Vector3d to_ball = Eigen::Vector3d(x[0], x[1], hand.p_HBall.z()) - axes[i].p_start;
    const Eigen::Vector3d away = to_ball - to_ball.dot(along) * along;
    const double distance = away.norm();
    const double y = model::deformation(ball, force[i]);
    result.error[i] = y - (ball.radius + hand.finger_radius - distance);
    // With F = pi E (1 - y/a) y^2 fixed: dy/dE = -F / (E dF/dy), and dE/ds = -2 E / s.
    const double dy_ds = 2 * force[i] / (x[2] * model::elasticStiffness(ball, y));
    result.slope.row(i) << away.head<2>().transpose() / distance, dy_ds;
  }
  return result;
}

}  // namespace

void GripFeeling::step(const HandSample& sample, double dt) {
  const double share = begun_ ? 1 - std::exp(-std::max(dt, 0.0) / kAverage) : 1;
  begun_ = true;
  q_ += share * (sample.q - q_);
  tau_ += share * (sample.tau - tau_);
  for (int i = 0; i < model::kFingers; ++i) {
    force_[i] += share * (sample.force[i] - force_[i]);
    along_[i] += share * (sample.tangential[i][0] - along_[i]);
  }
}

/// z of the ball's centre [m]. At rest each distal joint's torque is that of the force on the ball, linear in z, and of the
/// phalanx' weight; least squares over the fingers. As planned where that is where the palm would carry the ball too and push
/// it off in the throw, or where it makes no sense: not every hand measures torques.
double GripFeeling::placeAlongFingers(const model::Hand& hand,
                                      const model::BallParameters& ball,
                                      const Eigen::Vector2d& across,
                                      const Eigen::Vector3d& g_H) const {
  const double nominal = hand.parameters().p_HBall.z();
  const Eigen::Vector3d centre(across.x(), across.y(), nominal);
  const Eigen::Vector3d phalanx_weight = hand.parameters().finger_mass / 2 * g_H;  // [N]
  double slope_error = 0, slope_slope = 0;
  for (const model::Finger finger : {model::kFingerA, model::kThumb, model::kFingerB}) {
    const model::Segment distal = hand.phalanges(finger, q_)[1];
    const Eigen::Vector3d axis = (distal.p_end - distal.p_start).normalized();
    const Eigen::Vector3d foot = distal.p_start + (centre - distal.p_start).dot(axis) * axis;
    const Eigen::Vector3d normal = (centre - foot).normalized();
    const Eigen::Vector3d contact = foot + hand.parameters().finger_radius * normal;
    const Eigen::Vector3d force = force_[finger] * normal + along_[finger] * axis;
    const auto torque = [&](const Eigen::Vector3d& p_H, const Eigen::Vector3d& force_H) {
      return hand.fingerTorque(finger, q_, p_H, force_H)[2];
    };
    const double held =
        torque(contact, force) + torque((distal.p_start + distal.p_end) / 2, -phalanx_weight);
    const double slope = torque(contact + axis, force) - torque(contact, force);
    slope_error += slope * (tau_[model::Hand::proximalJoint(finger) + 1] - held);
    slope_slope += slope * slope;
  }
  const double z = nominal + slope_error / slope_slope;
  const bool clear = z > hand.parameters().palm_distance + ball.radius && z < nominal + kFarthest;
  return clear ? z : nominal;
}

std::optional<GripEstimate> GripFeeling::estimate(const model::Hand& hand,
                                                  const model::BallParameters& ball,
                                                  const Eigen::Vector3d& g_H) const {
  if (*std::min_element(force_.begin(), force_.end()) < kLeastForce)
    return {};
  std::array<model::Segment, model::kFingers> axes;
  for (const model::Finger finger : {model::kFingerA, model::kThumb, model::kFingerB})
    axes[finger] = hand.phalanges(finger, q_)[1];
  Unknowns x(0, 0, 1 / std::sqrt(ball.youngs_modulus));
  for (int i = 0; i < kMostSteps; ++i) {
    const auto found = equations(x, axes, force_, ball, hand.parameters());
    if (!found)
      return {};
    if (found->error.cwiseAbs().maxCoeff() < kExact) {
      const double z = placeAlongFingers(hand, ball, x.head<2>(), g_H);
      return GripEstimate{force_[model::kThumb], {x[0], x[1], z}, 1 / (x[2] * x[2])};
    }
    x -= found->slope.partialPivLu().solve(found->error);
    if (!sensible(x))
      return {};
  }
  return {};
}

}  // namespace fastball::hand_server
