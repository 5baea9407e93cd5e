#include "model/finger_surface.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

namespace fastball::model {

SurfaceMeeting meet(const FingerSurface& surface, const Eigen::Vector3d& p_HBall) {
  const Eigen::Vector3d r_H = p_HBall - surface.p_H;
  const double along = surface.direction_H.dot(r_H);
  if (surface.radius == 0)
    return {surface.direction_H, along};
  const Eigen::Vector3d away = r_H - along * surface.direction_H;
  return {away.normalized(), away.norm() - surface.radius};
}

double FingerPair::cosBeta(double ball_radius) const {
  const double sine = half_spacing > 0 ? half_spacing / (ball_radius + finger_radius) : 0;
  if (!(ball_radius > 0 && half_spacing >= 0 && finger_radius >= 0 && sine < 1)) {
    std::ostringstream message;
    message << "a ball of radius " << ball_radius << " m does not lie on two fingers of radius "
            << finger_radius << " m whose axes are " << 2 * half_spacing << " m apart";
    throw std::invalid_argument(message.str());
  }
  return std::sqrt(1 - sine * sine);
}

std::vector<FingerSurface> FingerPair::surfaces(double ball_radius) const {
  const Eigen::Matrix3d R = X_HF.linear();
  const double depth = (ball_radius + finger_radius) * cosBeta(ball_radius);
  if (half_spacing == 0 && finger_radius == 0)
    return {{X_HF * Eigen::Vector3d(0, -ball_radius, 0), R.col(1), 0}};
  if (half_spacing == 0)
    return {{X_HF * Eigen::Vector3d(0, -depth, 0), R.col(0), finger_radius}};
  return {{X_HF * Eigen::Vector3d(0, -depth, half_spacing), R.col(0), finger_radius},
          {X_HF * Eigen::Vector3d(0, -depth, -half_spacing), R.col(0), finger_radius}};
}

FingerPair fingersBehind(const HandParameters& hand, double ball_radius) {
  const auto normal = [&](Finger finger) {
    return Eigen::Vector3d(-std::cos(hand.azimuth[finger]), -std::sin(hand.azimuth[finger]), 0);
  };
  const Eigen::Vector3d between = normal(kFingerA) + normal(kFingerB);
  constexpr double kOpposite = 1e-6;
  if (!(between.norm() > kOpposite))
    throw std::invalid_argument(
        "fingers A and B stand on opposite sides of the ball: none is behind it");
  FingerPair fingers;
  fingers.X_HF.linear().col(0) = Eigen::Vector3d::UnitZ();
  fingers.X_HF.linear().col(1) = between.normalized();
  fingers.X_HF.linear().col(2) = Eigen::Vector3d::UnitZ().cross(between.normalized());
  fingers.X_HF.translation() = hand.p_HBall;
  fingers.finger_radius = hand.finger_radius;
  const double half_angle = std::acos(std::min(1.0, between.norm() / 2));
  fingers.half_spacing = (ball_radius + hand.finger_radius) * std::sin(half_angle);
  return fingers;
}

FingerFrameMotion fingerFrameMotion(const FingerPair& fingers, const HandMotion& hand) {
  const Eigen::Vector3d arm_W = hand.X_WH.linear() * fingers.X_HF.translation();
  const Eigen::Vector3d v_W = hand.v_WH + hand.w_WH.cross(arm_W);
  const Eigen::Vector3d a_W =
      hand.a_WH + hand.dw_WH.cross(arm_W) + hand.w_WH.cross(hand.w_WH.cross(arm_W));
  FingerFrameMotion motion;
  motion.X_WF = hand.X_WH * fingers.X_HF;
  const Eigen::Matrix3d R_FW = motion.X_WF.linear().transpose();
  motion.v_F = R_FW * v_W;
  motion.a_F = R_FW * a_W;
  motion.w_F = R_FW * hand.w_WH;
  motion.dw_F = R_FW * hand.dw_WH;
  return motion;
}

}  // namespace fastball::model
