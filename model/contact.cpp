#include "model/contact.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

namespace fastball::model {
namespace {

/// Above this deformation Eq. (27) would let the force fall again; the force stays at its maximum.
double deformationOfMaximum(const BallParameters& ball) {
  return 2.0 / 3.0 * ball.radius;
}

}  // namespace

double elasticForce(const BallParameters& ball, double y) {
  if (!(y > 0))
    return 0;
  y = std::min(y, deformationOfMaximum(ball));
  return M_PI * ball.youngs_modulus * (1 - y / ball.radius) * y * y;
}

double elasticStiffness(const BallParameters& ball, double y) {
  if (!(y > 0) || y >= deformationOfMaximum(ball))
    return 0;
  return M_PI * ball.youngs_modulus * (2 - 3 * y / ball.radius) * y;
}

double elasticEnergy(const BallParameters& ball, double y) {
  if (!(y > 0))
    return 0;
  const double y_law = std::min(y, deformationOfMaximum(ball));
  const double law =
      M_PI * ball.youngs_modulus * y_law * y_law * y_law * (1.0 / 3.0 - y_law / (4 * ball.radius));
  return law + maximumForce(ball) * (y - y_law);
}

double maximumForce(const BallParameters& ball) {
  return 4.0 * M_PI * ball.youngs_modulus * ball.radius * ball.radius / 27.0;
}

double deformation(const BallParameters& ball, double force) {
  const double maximum = maximumForce(ball);
  if (!(force >= 0 && force <= maximum)) {
    std::ostringstream message;
    message << "a contact force of " << force
            << " N has no equilibrium: the ball (E = " << ball.youngs_modulus << " Pa, radius "
            << ball.radius << " m) carries 0 to " << maximum << " N (Eq. 27)";
    throw std::invalid_argument(message.str());
  }
  // With s = y/a the law is s^2 - s^3 = b, 0 <= b <= 4/27. Its middle root is 1/3 + 2/3 cos(third +
  // 4 pi/3) with cos(3 third) = 1 - 27/2 b; written in half angles it keeps its digits for small
  // forces.
  const double b = force / (M_PI * ball.youngs_modulus * ball.radius * ball.radius);
  const double third = 2.0 / 3.0 * std::asin(std::min(1.0, std::sqrt(6.75 * b)));
  const double sine = std::sin(third / 2);
  const double s = 2.0 / 3.0 * sine * sine + std::sin(third) / std::sqrt(3.0);
  return ball.radius * s;
}

Eigen::Vector3d Contact::step(const BallParameters& ball,
                              const Eigen::Vector3d& n_W,
                              double y,
                              const Eigen::Vector3d& v_W,
                              double dt) {
  slipping_ = false;
  if (!(y > 0)) {
    reset();
    return Eigen::Vector3d::Zero();
  }
  const double v_normal = n_W.dot(v_W);
  const double damping = 2 * ball.damping_ratio * std::sqrt(elasticStiffness(ball, y) * ball.mass);
  const double normal = std::max(0.0, elasticForce(ball, y) - damping * v_normal);
  const Eigen::Vector3d v_slip = v_W - v_normal * n_W;
  return normal * n_W + friction(ball, n_W, normal, v_slip, dt);
}

Eigen::Vector3d Contact::friction(const BallParameters& ball,
                                  const Eigen::Vector3d& n_W,
                                  double normal,
                                  const Eigen::Vector3d& v_slip,
                                  double dt) {
  bristle_W_ -= n_W.dot(bristle_W_) * n_W;  // the contact plane turns with the finger
  const Eigen::Vector3d stuck = bristle_W_ + v_slip * dt;
  const Eigen::Vector3d pull = ball.bristle_stiffness * stuck + ball.bristle_damping * v_slip;
  const double limit = ball.friction * normal;
  const double size = pull.norm();
  if (size <= limit) {
    bristle_W_ = stuck;
    return -pull;
  }
  // The foot of the bristle slides at exactly the limit: stiffness s + damping ds/dt = limit.
  // Solved for the new s (implicit Euler), so that the bristle never holds more energy than the
  // slip has put in.
  slipping_ = true;
  const Eigen::Vector3d limited = limit / size * pull;
  const double rate = ball.bristle_damping / dt;
  bristle_W_ = (limited + rate * bristle_W_) / (ball.bristle_stiffness + rate);
  return -limited;
}

}  // namespace fastball::model
