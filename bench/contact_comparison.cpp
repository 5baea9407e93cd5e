#include "bench/contact_comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "model/ball_flight.h"
#include "model/contact.h"
#include "planner/hand_motion.h"
#include "sim_bullet/ball_contact.h"
#include "sim_bullet/world.h"

namespace fastball::bench {
namespace {

using Eigen::Vector3d;

constexpr double kAway = 0.1;         // [m], of fingers that are not to touch from the hand's axis
constexpr double kQuietTime = 3e-3;   // [s] without touch after which the ball has left
constexpr double kBeforeSlip = 5e-3;  // [s], the end of what is compared with the rigid ball

/// The hand with fingers that the ball does not roll off, nothing else in its way.
model::HandParameters longFingers(const model::HandParameters& hand, bool groove) {
  constexpr double kLength = 0.2;
  model::HandParameters result = hand;
  result.base_distance += hand.distal_length / 2 - kLength / 2;  // the ball stays in the middle
  result.distal_length = kLength;
  result.palm_distance = -kLength;
  result.azimuth[model::kFingerA] = groove ? -2 * M_PI / 3 : -M_PI / 2;
  result.azimuth[model::kFingerB] = -M_PI / 3;
  return result;
}

model::FingerPair fingerPair(const model::HandParameters& hand, double ball_radius, bool groove) {
  model::FingerPair fingers;
  fingers.X_HF.linear() << 0, 0, -1, 0, 1, 0, 1, 0, 0;
  fingers.X_HF.translation() = hand.p_HBall;
  fingers.finger_radius = hand.finger_radius;
  if (groove) {
    const double sine = std::cos(hand.azimuth[model::kFingerB]);
    fingers.half_spacing = (ball_radius + hand.finger_radius) * sine;
  }
  return fingers;
}

/// The simulated hand, moved from outside: its own kinematics and contacts, but the joints are set before every step, so that
/// no force moves them.
class MovedHand {
 public:
  MovedHand(const config::Experiment& experiment,
            const sim_bullet::SimulationSettings& settings,
            const model::HandParameters& hand,
            const planner::WristAngles& wrist,
            const ContactCase& contact,
            double step)
      : ball_(contact.ball),
        motion_(contact.motion),
        step_(step),
        q_hand_(posture(hand, contact, wrist)),
        arm_hand_(experiment.arm, hand, q_hand_),
        world_(arm_hand_,
               contact.ball,
               experiment.target,
               settings.net,
               settings.floor,
               experiment.arm.gravity),
        contacts_(hand, contact.ball) {}

  /// Puts the ball where `start` says in the fingers' frame.
  void place(const model::FingerPair& fingers, const model::ElasticStart& start) {
    move(0);
    const sim_bullet::LinkMotion& hand = arm_hand_.motion(sim_bullet::kHandLink);
    const Eigen::Isometry3d X_WF = hand.X_WF * fingers.X_HF;
    sim_bullet::BallMotion ball;
    ball.p_WBall = X_WF * start.p_FBall;
    ball.v_WBall = hand.velocityAt(ball.p_WBall) + X_WF.linear() * start.v_FBall;
    ball.w_WBall = hand.w_WF + X_WF.linear() * start.w_F;
    world_.setBall(ball);
  }

  /// One step of the simulator from time t.
  void step(double t) {
    move(t);
    const sim_bullet::BallMotion ball = world_.ball();
    const sim_bullet::Wrench wrench = contacts_.step(arm_hand_, ball, step_);
    const Vector3d drag =
        ball_.mass * model::flightAcceleration(ball.v_WBall, ball_.dragPerMetre(), 0);
    world_.addBallForce(wrench.force + drag, wrench.moment);
    world_.step(step_);
  }

  bool touching() const {
    const auto& touching = contacts_.touching();
    return std::any_of(touching.begin(), touching.end(), [](bool touches) { return touches; });
  }
  /// [N], normal force of a finger in the last step.
  double normal(model::Finger finger) const { return contacts_.forces()[finger].normal; }
  sim_bullet::BallMotion ball() const { return world_.ball(); }
  const sim_bullet::LinkMotion& hand() const { return arm_hand_.motion(sim_bullet::kHandLink); }

 private:
  static model::HandVector posture(const model::HandParameters& hand,
                                   const ContactCase& contact,
                                   const planner::WristAngles& wrist) {
    const double touch = contact.ball.radius + hand.finger_radius;
    return model::Hand(hand).posture(wrist.roll, wrist.flexion,
                                     {touch, kAway, contact.groove ? touch : kAway});
  }
  /// The joints at t, with the speeds that Bullet's step pairs with them: q_k = q_(k-1) + dt qd_k. Ball and hand must have theirs
  /// of the same moment.
  void move(double t) {
    const Eigen::Vector4d q = motion_.at(t).q;
    const Eigen::Vector4d qd = (q - motion_.at(t - step_).q) / step_;
    arm_hand_.setState({q, q_hand_}, {qd, model::HandVector::Zero()});
    arm_hand_.updateKinematics();
  }

  const model::BallParameters& ball_;
  const CubicMotion& motion_;
  double step_;
  model::HandVector q_hand_;
  sim_bullet::ArmHand arm_hand_;
  sim_bullet::World world_;
  sim_bullet::BallContacts contacts_;
};

/// One case with all that both sides are made of.
struct Setting {
  model::HandParameters hand_parameters;
  model::Arm arm;
  model::Hand hand;
  planner::WristAngles wrist;
  model::FingerPair fingers;
  model::HandPath path;

  Setting(const config::Experiment& experiment, const ContactCase& contact)
      : hand_parameters(longFingers(experiment.hand, contact.groove)),
        arm(experiment.arm),
        hand(hand_parameters),
        wrist(planner::throwDirection(arm, hand, contact.motion.at(0)).wrist),
        fingers(fingerPair(hand_parameters, contact.ball.radius, contact.groove)),
        path([this, &contact](double t) {
          return planner::handMotion(arm, hand, wrist, contact.motion.at(t));
        }) {}
  Setting(const Setting&) = delete;
  Setting& operator=(const Setting&) = delete;
};

/// What the simulator makes of a case, step by step.
struct SimulatedRoll {
  std::vector<double> x;                      ///< [m], x' at the start of each step
  std::vector<std::array<double, 2>> normal;  ///< [N], fingers A and B
  double t_release = -1;                      ///< [s], last touch; negative: none
  bool released = false;                      ///< nothing touched for 3 ms after it
};

SimulatedRoll simulate(MovedHand& hand, const Setting& setting, double duration, double step) {
  SimulatedRoll roll;
  for (int k = 0; k * step < duration && !roll.released; ++k) {
    const Vector3d p_W = hand.ball().p_WBall;
    hand.step(k * step);
    roll.x.push_back(((hand.hand().X_WF * setting.fingers.X_HF).inverse() * p_W).x());
    roll.normal.push_back({hand.normal(model::kFingerA), hand.normal(model::kFingerB)});
    if (hand.touching())
      roll.t_release = (k + 1) * step;
    roll.released = roll.t_release >= 0 && (k + 1) * step - roll.t_release > kQuietTime;
  }
  return roll;
}

SimulatedRoll simulate(const config::Experiment& experiment,
                       const sim_bullet::SimulationSettings& settings,
                       const ContactCase& contact,
                       const Setting& setting,
                       const model::ElasticStart& start,
                       double step) {
  MovedHand hand(experiment, settings, setting.hand_parameters, setting.wrist, contact, step);
  hand.place(setting.fingers, start);
  return simulate(hand, setting, contact.duration, step);
}

model::RollingTask taskOf(const config::Experiment& experiment,
                          const ContactCase& contact,
                          double step) {
  model::RollingTask task;
  task.t_end = contact.duration;
  task.gravity = experiment.arm.gravity;
  task.sample_step = step;
  return task;
}

void requireReleased(const ContactCase& contact, bool simulated, bool reference) {
  if (simulated && reference)
    return;
  throw std::runtime_error(fmt::format("{}: the ball of the {} does not leave within {} s",
                                       contact.name, simulated ? "reference" : "simulator",
                                       contact.duration));
}

}  // namespace

ContactError elasticError(const config::Experiment& experiment,
                          const sim_bullet::SimulationSettings& settings,
                          const ContactCase& contact,
                          double step) {
  const Setting setting(experiment, contact);
  const model::RollingTask task = taskOf(experiment, contact, step);
  const model::ElasticStart start =
      model::settledStart(contact.ball, setting.fingers, setting.path, task);
  const model::ElasticMotion reference =
      model::elasticOnFingers(contact.ball, setting.fingers, setting.path, start, task);
  const SimulatedRoll roll = simulate(experiment, settings, contact, setting, start, step);
  requireReleased(contact, roll.released, reference.released);

  ContactError error;
  std::array<double, 2> squares{};
  const std::size_t steps = std::min(roll.x.size(), reference.elastic.size() - 1);
  for (std::size_t k = 0; k < steps; ++k) {
    const model::ElasticSample& sample = reference.elastic[k];
    if (sample.t <= reference.t_release) {
      error.rolling = std::max(error.rolling, std::abs(roll.x[k] - sample.p_FBall.x()));
      error.distance = sample.p_FBall.x();
    }
    for (std::size_t i = 0; i < sample.normal.size(); ++i)
      squares[i] += std::pow(roll.normal[k][i] - sample.normal[i], 2);
  }
  error.force = std::sqrt(std::max(squares[0], squares[1]) / static_cast<double>(steps));
  error.release = std::abs(roll.t_release - reference.t_release);
  error.t_release = reference.t_release;
  return error;
}

ContactError rigidError(const config::Experiment& experiment,
                        const sim_bullet::SimulationSettings& settings,
                        const ContactCase& contact,
                        double step) {
  const Setting setting(experiment, contact);
  const model::RollingTask task = taskOf(experiment, contact, step);
  const model::ElasticStart start =
      model::settledStart(contact.ball, setting.fingers, setting.path, task);
  const model::RollingMotion reference =
      model::rollOnFingers(contact.ball, setting.fingers, setting.path, task);
  const SimulatedRoll roll = simulate(experiment, settings, contact, setting, start, step);
  requireReleased(contact, roll.released, reference.released);

  ContactError error;
  double squares = 0;
  std::size_t k = 0;
  for (; k < roll.x.size() && reference.samples[k].t < reference.t_slip - kBeforeSlip; ++k) {
    const model::RollingSample& sample = reference.samples[k];
    error.rolling = std::max(error.rolling, std::abs(roll.x[k] - sample.p_FBall.x()));
    if (!contact.groove)
      squares += std::pow(roll.normal[k][0] - sample.force_F.y(), 2);
  }
  error.force = std::sqrt(squares / static_cast<double>(k));
  error.release = std::abs(roll.t_release - reference.t_release);
  error.t_release = reference.t_release;
  error.distance = reference.samples.back().p_FBall.x();
  return error;
}

Bounce bounceOff(const config::Experiment& experiment,
                 const sim_bullet::SimulationSettings& settings,
                 const ContactCase& contact,
                 const model::ElasticStart& start,
                 double step) {
  config::Experiment floating = experiment;
  floating.arm.gravity = 0;
  ContactCase still = contact;
  still.ball.drag_coefficient = 0;
  still.motion = {contact.motion.q, Eigen::Vector4d::Zero(), Eigen::Vector4d::Zero(),
                  Eigen::Vector4d::Zero()};
  const Setting setting(floating, still);
  MovedHand hand(floating, settings, setting.hand_parameters, setting.wrist, still, step);
  hand.place(setting.fingers, start);
  const auto kinetic = [&] {
    const sim_bullet::BallMotion ball = hand.ball();
    return still.ball.mass / 2 * ball.v_WBall.squaredNorm() +
           still.ball.inertia() / 2 * ball.w_WBall.squaredNorm();
  };
  Bounce bounce;
  bounce.before = kinetic();
  const SimulatedRoll roll = simulate(hand, setting, still.duration, step);
  requireReleased(still, roll.released, true);
  bounce.after = kinetic();
  return bounce;
}

}  // namespace fastball::bench
