#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include "model/contact.h"
#include "model/elastic_ball.h"

namespace fastball::model {
namespace {

using Eigen::Vector3d;

/// The ball in the groove of two fingers, pressed straight down between them. The deeper it lies, the more the contact normals
/// lean over, so that there is a largest load.
struct Groove {
  const BallParameters& ball;
  double half_spacing;  ///< [m]
  double radii;         ///< [m], of ball and finger together
  double nominal;       ///< [m], height of the undeformed ball's centre above the fingers' axes

  Groove(const BallParameters& its_ball, const FingerPair& fingers)
      : ball(its_ball),
        half_spacing(fingers.half_spacing),
        radii(its_ball.radius + fingers.finger_radius),
        nominal(radii * fingers.cosBeta(its_ball.radius)) {}

  double height(double y) const {
    return std::sqrt(std::max(0.0, (radii - y) * (radii - y) - half_spacing * half_spacing));
  }
  double load(double y) const { return 2 * elasticForce(ball, y) * height(y) / (radii - y); }

  /// The least deformation y [m] of the ball at each finger that carries the load [N].
  double deformationUnder(double force) const {
    constexpr int kParts = 1000;
    const double deepest = std::min(2.0 / 3.0 * ball.radius, radii - half_spacing);
    double low = 0, high = 0;
    for (int k = 1; k <= kParts && load(high) < force; ++k) {
      low = high;
      high = deepest * k / kParts;
    }
    if (load(high) < force)
      refuse(force);
    for (int k = 0; k < 100 && high - low > 1e-16; ++k) {
      const double middle = (low + high) / 2;
      (load(middle) < force ? low : high) = middle;
    }
    return high;
  }

  [[noreturn]] void refuse(double force) const {
    std::ostringstream message;
    message << "two fingers " << 2 * half_spacing << " m apart cannot carry " << force
            << " N: the ball (E = " << ball.youngs_modulus << " Pa, radius " << ball.radius
            << " m) would sink through between them (Eq. 27)";
    throw std::invalid_argument(message.str());
  }
};

}  // namespace

void requireElastic(const BallParameters& ball) {
  const auto require = [](bool sound, double value, const char* name, const char* range) {
    if (sound)
      return;
    std::ostringstream message;
    message << "an elastic ball on fingers: " << name << " is " << value << ", it must be "
            << range;
    throw std::invalid_argument(message.str());
  };
  const auto positive = [&](double value, const char* name) {
    require(value > 0 && std::isfinite(value), value, name, "positive and finite");
  };
  positive(ball.youngs_modulus, "E [Pa]");
  positive(ball.bristle_stiffness, "the bristle's stiffness [N/m]");
  positive(ball.bristle_damping, "the bristle's damping [N s/m]");
  require(ball.damping_ratio >= 0 && std::isfinite(ball.damping_ratio), ball.damping_ratio,
          "the damping ratio", "0 or more and finite");
}

ElasticStart settledStart(const BallParameters& ball,
                          const FingerPair& fingers,
                          const HandPath& hand_at,
                          const RollingTask& task) {
  requireRolling(ball, task);
  requireElastic(ball);
  const FingerFrameMotion frame = fingerFrameMotion(fingers, hand_at(task.t_start));
  const Vector3d v_W = releaseVelocity(frame, Vector3d::Zero(), Vector3d::Zero());
  const Vector3d g_W = flightAcceleration(v_W, ball.dragPerMetre(), task.gravity);
  const double load = ball.mass * (frame.a_F - frame.X_WF.linear().transpose() * g_W).y();
  ElasticStart start;
  if (!(load > 0))
    return start;
  if (fingers.flat()) {
    start.p_FBall.y() = -deformation(ball, load);
  } else {
    const Groove groove(ball, fingers);
    start.p_FBall.y() = groove.height(groove.deformationUnder(load)) - groove.nominal;
  }
  return start;
}

}  // namespace fastball::model
