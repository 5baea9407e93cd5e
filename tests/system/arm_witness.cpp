#include "tests/system/arm_witness.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "config/experiment.h"
#include "controller/config.h"
#include "controller/stop_motion.h"
#include "messaging/channels.h"

namespace fastball::system_test {
namespace {

using Eigen::Vector4d;
using ConstMap = Eigen::Map<const Vector4d>;

const std::string kConfig = FASTBALL_SOURCE_DIR "/config/experiment.yaml";
/// What the measured arm may be off the motion that the law commands: it is led by feedback, with a bound of its own.
constexpr double kFollowing = 0.02;  // [rad]
constexpr double kRest = 0.05;       // [rad/s]
constexpr double kRounding = 1e-6;

const config::Experiment& experiment() {
  static const config::Experiment experiment = config::loadExperiment(kConfig);
  return experiment;
}

model::Arm arm() {
  return model::Arm(experiment().arm, experiment().hand.payload);
}

/// [rad], how far each joint goes from this state until it rests, by the controller's braking law.
Vector4d brakingDistance(const Vector4d& q, const Vector4d& qd) {
  controller::StopMotion stop(arm(), controller::loadConfig(kConfig).brake_share);
  stop.begin(q, qd);
  for (int tick = 0; tick < 10'000 && !stop.atRest(); ++tick)
    stop.advance(1);
  EXPECT_TRUE(stop.atRest());
  return (stop.motion().q - q).cwiseAbs();
}

using States = std::vector<arm_state_t>;

/// The state of a tick, or the first behind it.
States::const_iterator find(const States& states, int64_t scene_id, int64_t tick) {
  return std::find_if(states.begin(), states.end(), [&](const arm_state_t& m) {
    return m.scene_id == scene_id && m.tick >= tick;
  });
}

/// In the rest of its scene the arm is no further from the first state than `distance` [rad], and what following takes.
void expectWithin(States::const_iterator begin,
                  States::const_iterator end,
                  const Vector4d& distance) {
  const ConstMap q_begin(begin->q);
  const Vector4d allowed = distance + Vector4d::Constant(kFollowing);
  for (auto state = begin; state != end && state->scene_id == begin->scene_id; ++state) {
    const Vector4d way = (ConstMap(state->q) - q_begin).cwiseAbs();
    ASSERT_TRUE((way.array() <= allowed.array()).all())
        << "from tick " << begin->tick << " to " << state->tick << " the arm went "
        << way.transpose() << " rad, its braking distance is " << allowed.transpose();
  }
}

}  // namespace

void ArmWitness::listen(messaging::Endpoint& endpoint) {
  endpoint.subscribe<arm_state_t>(messaging::kArmState, [this](const arm_state_t& m) {
    if (states_.empty() || m.tick != states_.back().tick || m.scene_id != states_.back().scene_id)
      states_.push_back(m);
  });
  endpoint.subscribe<arm_command_t>(messaging::kArmCommand, [this](const arm_command_t& m) {
    if (m.phase == arm_command_t::BRAKE && !brake_)
      brake_ = m;
  });
}

void ArmWitness::expectLimitsKept() const {
  const model::ArmParameters& limits = experiment().arm;
  const double overspeed = controller::loadConfig(kConfig).overspeed;
  const model::Arm its_arm = arm();
  for (const arm_state_t& state : states_) {
    const ConstMap q(state.q);
    ASSERT_TRUE((q.array() >= limits.q_min.array()).all()) << q.transpose();
    ASSERT_TRUE((q.array() <= limits.q_max.array()).all()) << q.transpose();
    ASSERT_LT(its_arm.speedRatio(ConstMap(state.qd)), overspeed) << "tick " << state.tick;
    ASSERT_LT(its_arm.torqueRatio(ConstMap(state.tau)), 1 + kRounding) << "tick " << state.tick;
  }
  expectBrakingDistanceKept();
}

void ArmWitness::expectBrakingDistanceKept() const {
  if (!brake_)
    return;
  const auto begin = find(states_, brake_->scene_id, brake_->tick);
  if (begin != states_.end())
    expectWithin(begin, states_.end(), brakingDistance(ConstMap(begin->q), ConstMap(begin->qd)));
}

void ArmWitness::expectRest() const {
  if (states_.empty())
    return;
  EXPECT_LT(ConstMap(states_.back().qd).norm(), kRest) << "tick " << states_.back().tick;
}

}  // namespace fastball::system_test
