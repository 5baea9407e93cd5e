#include "sim_bullet/scene.h"

#include <cmath>
#include <sstream>
#include <stdexcept>

#include "model/ball_flight.h"

namespace fastball::sim_bullet {
namespace {

using Eigen::Vector3d;
using Eigen::Vector4d;

/// Stiffness and damping that hold the open hand before the first command: a tenth of a radian calls for the full torque.
constexpr double kOpenKp = 12;   // [N m/rad]
constexpr double kOpenKd = 0.1;  // [N m s/rad]

HandCommand openHand(const config::Experiment& experiment, const SimulationSettings& settings) {
  const model::Hand hand(experiment.hand);
  const double distance =
      experiment.ball.radius + experiment.hand.finger_radius + settings.open_clearance;
  HandCommand command;
  command.q = hand.posture(0, 0, {distance, distance, distance});
  command.kp.setConstant(kOpenKp);
  command.kd.setConstant(kOpenKd);
  return command;
}

void requireInsideStops(const model::ArmParameters& arm, const Vector4d& q) {
  for (int i = 0; i < model::kArmJoints; ++i) {
    if (!(q[i] >= arm.q_min[i] && q[i] <= arm.q_max[i])) {
      std::ostringstream message;
      message << "the arm cannot start with joint " << i + 1 << " at " << q[i]
              << " rad: its stops are at " << arm.q_min[i] << " and " << arm.q_max[i]
              << " rad (profile " << arm.profile << ")";
      throw std::invalid_argument(message.str());
    }
  }
}

/// Drag on the ball [N].
Vector3d drag(const model::BallParameters& ball, const Vector3d& v_W) {
  return ball.mass * model::flightAcceleration(v_W, ball.dragPerMetre(), 0);
}

model::ArmParameters withFriction(model::ArmParameters arm, double factor) {
  arm.viscous_friction *= factor;
  arm.coulomb_friction *= factor;
  return arm;
}

model::HandParameters withLag(model::HandParameters hand, double factor) {
  hand.actuator_lag *= factor;
  return hand;
}

}  // namespace

Scene::Scene(const config::Experiment& experiment,
             const SimulationSettings& settings,
             const Uncertainty& uncertainty,
             const SceneStart& start)
    : settings_(settings),
      errors_(drawErrors(uncertainty, experiment.ball, start.seeds)),
      arm_(withFriction(experiment.arm, errors_.joint_friction), experiment.hand.payload),
      gravity_(experiment.arm.gravity),
      target_(errors_.room.target(start.target)),
      open_hand_(sim_bullet::openHand(experiment, settings)),
      arm_hand_(experiment.arm, experiment.hand, open_hand_.q),
      world_(arm_hand_, errors_.ball, target_, settings.net, settings.floor, gravity_),
      contacts_(experiment.hand, errors_.ball, errors_.unevenness),
      servo_(withLag(experiment.hand, errors_.finger_lag),
             errors_.finger_delay,
             kTick / settings.substeps),
      tactile_(settings.tactile, kTick / settings.substeps, start.seeds.scene),
      encoder_noise_(errors_.encoder_noise, kTick, start.seeds.scene),
      stops_(experiment.arm, experiment.hand, settings),
      feeder_(experiment.hand.p_HBall + errors_.ball_offset_H,
              errors_.ball,
              settings.feeder_frequency),
      bag_(target_, settings.net, errors_.ball),
      judge_(target_, errors_.ball.dragPerMetre(), gravity_) {
  requireInsideStops(experiment.arm, start.q_arm);
  arm_hand_.setState({start.q_arm, open_hand_.q}, {});
  arm_hand_.updateKinematics();
  world_.setBall(feeder_.rest(arm_hand_));
  events_.reserve(8);  // more than one tick can bring
  readState();
}

void Scene::advance(const Vector4d& tau_arm, const HandCommand& hand) {
  const Vector4d clipped = arm_.clipTorque(tau_arm);
  tickWith(&clipped, hand);
}

void Scene::brake(const HandCommand& hand) {
  tickWith(nullptr, hand);
}

void Scene::tickWith(const Vector4d* tau_arm, const HandCommand& hand) {
  events_.clear();
  state_.tau_arm.setZero();
  state_.tau_hand.setZero();
  state_.forces = {};
  const double dt = kTick / settings_.substeps;
  for (int i = 0; i < settings_.substeps; ++i)
    substep(tau_arm, hand, dt);
  const double share = 1.0 / settings_.substeps;
  state_.tau_arm *= share;
  state_.tau_hand *= share;
  for (FingerForce& force : state_.forces) {
    force.normal *= share;
    force.tangential *= share;
  }
  state_.felt = tactile_.read();
  ++tick_;
  encoder_noise_.step();
  readState();
}

void Scene::substep(const Vector4d* tau_arm, const HandCommand& hand, double dt) {
  const JointVectors q = arm_hand_.q();
  const JointVectors qd = arm_hand_.qd();
  JointVectors motor;
  motor.arm = tau_arm ? *tau_arm
                      : arm_.clipTorque(arm_.gravityTorque(q.arm) -
                                        settings_.brake_damping.cwiseProduct(qd.arm));
  motor.hand = servo_.step(hand, q.hand, qd.hand);
  JointVectors tau = stops_.torque(q, qd);
  tau.arm += motor.arm - arm_.frictionTorque(qd.arm);
  tau.hand += motor.hand;
  arm_hand_.addTorques(tau);
  state_.tau_arm += motor.arm;
  state_.tau_hand += motor.hand;

  JudgedStep judged;
  pushBall(dt, &judged);
  world_.step(dt);
  ++substep_;

  const BallMotion ball = world_.ball();
  judged.time = static_cast<double>(substep_) * dt;
  judged.dt = dt;
  judged.after = {ball.p_WBall, ball.v_WBall};
  judged.w_WBall = ball.w_WBall;
  judged.ring_touches = world_.touchesRing();
  judged.floor_touches = world_.touchesFloor();
  judge_.step(judged, &events_);
}

void Scene::pushBall(double dt, JudgedStep* judged) {
  arm_hand_.updateKinematics();
  const BallMotion ball = world_.ball();
  judged->before = {ball.p_WBall, ball.v_WBall};
  judged->held = static_cast<double>(substep_) * dt < settings_.feeder_release;
  Wrench wrench = contacts_.step(arm_hand_, ball, dt);
  judged->hand_touches = contacts_.touching();
  tactile_.step(contacts_.forces());
  for (int i = 0; i < model::kFingers; ++i) {
    state_.forces[i].normal += contacts_.forces()[i].normal;
    state_.forces[i].tangential += contacts_.forces()[i].tangential;
  }
  if (judged->held) {
    const Wrench feeder = feeder_.step(arm_hand_, ball);
    wrench.force += feeder.force;
    wrench.moment += feeder.moment;
  }
  wrench.force += drag(errors_.ball, ball.v_WBall) + bag_.force(ball);
  world_.addBallForce(wrench.force, wrench.moment);
}

void Scene::readState() {
  state_.q = arm_hand_.q();
  state_.qd = arm_hand_.qd();
  state_.q_arm = state_.q.arm + errors_.encoder_offset + encoder_noise_.q();
  state_.qd_arm = state_.qd.arm + encoder_noise_.qd();
}

SceneSnapshot Scene::snapshot(int64_t start_utime) const {
  const BallMotion ball = world_.ball();
  const auto tick_us = static_cast<int64_t>(std::lround(kTick * 1e6));
  return {start_utime + tick_ * tick_us, ball.p_WBall, ball.R_WBall, state_.q.arm, state_.q.hand};
}

bool Scene::healthy() const {
  const BallMotion ball = world_.ball();
  return state_.q.arm.allFinite() && state_.q.hand.allFinite() && state_.qd.arm.allFinite() &&
         state_.qd.hand.allFinite() && ball.p_WBall.allFinite() && ball.v_WBall.allFinite() &&
         ball.w_WBall.allFinite();
}

}  // namespace fastball::sim_bullet
