#include "bench/contact_cases.h"

#include <fmt/format.h>

namespace fastball::bench {
namespace {

/// [kg], a ball that presses on the fingers with 8 N in these swings.
constexpr double kHeavy = 0.15;

}  // namespace

model::ArmMotion CubicMotion::at(double t) const {
  return {q + t * (qd + t / 2 * (qdd + t / 3 * qddd)), qd + t * (qdd + t / 2 * qddd),
          qdd + t * qddd};
}

std::vector<ContactCase> contactCases(const config::Experiment& experiment) {
  // Arm stretched, joint 2 swings it in a vertical plane; or all joints move.
  const CubicMotion slow{{0, 0.6, 0, 0}, {0, 5.2, 0, 0}, {0, 45, 0, 0}, {0, -1200, 0, 0}};
  CubicMotion fast = slow;
  fast.qddd[1] = -3000;
  const CubicMotion spatial{
      {-0.6, 1.3, 0.2, 0.5}, {4, 0.5, 2, 2}, {35, 5, 10, 10}, {-1500, -100, -300, -600}};
  std::vector<ContactCase> cases;
  for (const double modulus : {2e4, 1e5, 5e5, 1e6, 1e7}) {
    for (const double damping : {experiment.ball.damping_ratio, 0.0}) {
      for (const double mass : {experiment.ball.mass, kHeavy}) {
        model::BallParameters ball = experiment.ball;
        ball.youngs_modulus = modulus;
        ball.damping_ratio = damping;
        ball.mass = mass;
        const std::string of =
            fmt::format("E = {:.0e} Pa, zeta = {}, {} kg", modulus, damping, mass);
        cases.push_back({"one finger, slow, " + of, ball, false, slow});
        cases.push_back({"one finger, fast, " + of, ball, false, fast});
        cases.push_back({"groove, slow, " + of, ball, true, slow});
        cases.push_back({"groove, fast, " + of, ball, true, fast});
        cases.push_back({"groove, all joints, " + of, ball, true, spatial});
      }
    }
  }
  return cases;
}

}  // namespace fastball::bench
