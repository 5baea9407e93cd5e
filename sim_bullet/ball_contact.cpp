#include "sim_bullet/ball_contact.h"

#include <algorithm>

#include "model/hand.h"

namespace fastball::sim_bullet {
namespace {

using Eigen::Vector3d;
using model::kArmJoints;

/// A point nearer than this to a surface's middle has no normal; the contact is left out.
constexpr double kNoDirection = 1e-9;

}  // namespace

BallContacts::BallContacts(const model::HandParameters& hand,
                           const model::BallParameters& ball,
                           const std::array<double, model::kFingers>& unevenness)
    : hand_(hand), ball_(ball) {
  finger_balls_.fill(ball);
  for (std::size_t i = 0; i < finger_balls_.size(); ++i)
    finger_balls_[i].youngs_modulus *= unevenness[i];
}

Wrench BallContacts::step(ArmHand& hand, const BallMotion& ball, double dt) {
  forces_ = {};
  touching_ = {};
  Wrench wrench;
  const Eigen::Isometry3d& X_WH = hand.motion(kHandLink).X_WF;
  const double reach = hand_.base_distance + hand_.proximal_length + hand_.distal_length +
                       hand_.base_radius + hand_.finger_radius + ball_.radius;
  if ((ball.p_WBall - X_WH.translation()).squaredNorm() > reach * reach) {
    for (auto& finger : finger_contacts_)
      for (model::Contact& contact : finger)
        contact.reset();
    palm_contact_.reset();
    return wrench;
  }
  for (int finger = 0; finger < model::kFingers; ++finger)
    touchFinger(finger, hand, ball, dt, &wrench);
  touchPalm(hand, ball, dt, &wrench);
  return wrench;
}

void BallContacts::touchFinger(int finger,
                               ArmHand& hand,
                               const BallMotion& ball,
                               double dt,
                               Wrench* wrench) {
  const int proximal = kArmJoints + model::Hand::proximalJoint(static_cast<model::Finger>(finger));
  const std::array<double, 2> lengths{hand_.proximal_length, hand_.distal_length};
  std::array<double, 2> along;  // nearest point of each axis, from the phalanx' base [m]
  for (int i = 0; i < 2; ++i) {
    const Vector3d p_FBall = hand.motion(proximal + i).X_WF.inverse() * ball.p_WBall;
    along[i] = std::clamp(p_FBall.z(), 0.0, lengths[i]);
  }
  // The capsules share the sphere at the distal joint, which must not push twice: it belongs to the distal phalanx unless
  // the ball lies beside the proximal one.
  const bool beside_proximal = along[0] < lengths[0];
  const std::array<bool, 2> counts{beside_proximal, !beside_proximal || along[1] > 0};
  const Vector3d z_H = hand.motion(kHandLink).X_WF.linear().col(2);
  for (int i = 0; i < 2; ++i) {
    model::Contact& contact = finger_contacts_[finger][i];
    const Eigen::Isometry3d& X_WF = hand.motion(proximal + i).X_WF;
    const Vector3d r_W = ball.p_WBall - X_WF * Vector3d(0, 0, along[i]);
    const double distance = r_W.norm();
    const double y = ball_.radius + hand_.finger_radius - distance;
    if (!counts[i] || y <= 0 || distance < kNoDirection) {
      contact.reset();
      continue;
    }
    const Touch touch{r_W / distance, y};
    const Vector3d f_W = apply(finger_balls_[static_cast<std::size_t>(finger)], touch, proximal + i,
                               hand, ball, dt, &contact, wrench);
    const double normal = touch.n_W.dot(f_W);
    const Vector3d distal = z_H - touch.n_W.dot(z_H) * touch.n_W;
    const double size = distal.norm();
    forces_[finger].normal += normal;
    if (size > kNoDirection) {
      forces_[finger].tangential +=
          Eigen::Vector2d(distal.dot(f_W), touch.n_W.cross(distal).dot(f_W)) / size;
    }
    touching_[finger] = touching_[finger] || normal > 0;
  }
}

void BallContacts::touchPalm(ArmHand& hand, const BallMotion& ball, double dt, Wrench* wrench) {
  const Eigen::Isometry3d& X_WH = hand.motion(kHandLink).X_WF;
  const Vector3d p_HBall = X_WH.inverse() * ball.p_WBall;
  Vector3d nearest(p_HBall.x(), p_HBall.y(), 0);
  const double radial = nearest.norm();
  if (radial > hand_.palm_radius)
    nearest *= hand_.palm_radius / radial;
  nearest.z() = hand_.palm_distance;
  const Vector3d r_H = p_HBall - nearest;
  const double distance = r_H.norm();
  const double y = ball_.radius - distance;
  // A centre below the surface has come in from the back, where the palm has none.
  if (y <= 0 || r_H.z() <= 0 || distance < kNoDirection) {
    palm_contact_.reset();
    return;
  }
  const Touch touch{X_WH.linear() * r_H / distance, y};
  const Vector3d f_W = apply(ball_, touch, kHandLink, hand, ball, dt, &palm_contact_, wrench);
  touching_[kPalm] = touch.n_W.dot(f_W) > 0;
}

Vector3d BallContacts::apply(const model::BallParameters& felt,
                             const Touch& touch,
                             int link,
                             ArmHand& hand,
                             const BallMotion& ball,
                             double dt,
                             model::Contact* contact,
                             Wrench* wrench) {
  // The material point lies a - y from the centre: the deformed ball's lever arm.
  const Vector3d arm_W = -(ball_.radius - touch.deformation) * touch.n_W;
  const Vector3d p_W = ball.p_WBall + arm_W;
  const Vector3d v_W = ball.v_WBall + ball.w_WBall.cross(arm_W) - hand.motion(link).velocityAt(p_W);
  Vector3d f_W = contact->step(felt, touch.n_W, touch.deformation, v_W, dt);
  wrench->force += f_W;
  wrench->moment += arm_W.cross(f_W);
  hand.addForceAt(link, p_W, -f_W);
  return f_W;
}

}  // namespace fastball::sim_bullet
