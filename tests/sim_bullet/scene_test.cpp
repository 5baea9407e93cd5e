#include "sim_bullet/scene.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>

#include "model/ball_flight.h"
#include "tests/sim_bullet/test_scene.h"

namespace fastball::sim_bullet {
namespace {

using Eigen::Vector3d;
using Eigen::Vector4d;

/// Gravity compensation with a stiff PD about q, as a controller would send it.
Vector4d holdTorque(const Scene& scene, const Vector4d& q, const Vector4d& qd = Vector4d::Zero()) {
  static const model::Arm arm(experiment().arm, experiment().hand.payload);
  const Vector4d kp(2000, 2000, 300, 500);
  const Vector4d kd(60, 60, 3, 10);
  return arm.gravityTorque(scene.state().q_arm) + kp.cwiseProduct(q - scene.state().q_arm) +
         kd.cwiseProduct(qd - scene.state().qd_arm);
}

Scene restScene() {
  return {experiment(), simulation(), {}, restStart()};
}

Vector3d p_HBall(const Scene& scene) {
  static const model::Arm arm(experiment().arm);
  static const model::Hand hand(experiment().hand);
  const JointVectors& q = scene.state().q;
  const Eigen::Isometry3d X_TH = hand.X_TH(q.hand[model::kWristRoll], q.hand[model::kWristFlexion]);
  return (arm.X_WT(q.arm) * X_TH).inverse() * scene.ball().p_WBall;
}

std::vector<SceneEvent> eventsOf(const Scene& scene, SceneEvent::Kind kind) {
  std::vector<SceneEvent> found;
  for (const SceneEvent& event : scene.events())
    if (event.kind == kind)
      found.push_back(event);
  return found;
}

TEST(Scene, TheArmStaysWhereGravityIsBalanced) {
  Scene scene = restScene();
  for (int k = 0; k < 1000; ++k)
    scene.advance(holdTorque(scene, experiment().q_rest), scene.openHand());
  EXPECT_LT((scene.state().q.arm - experiment().q_rest).norm(), 1e-3);
  EXPECT_LT(scene.state().qd.arm.norm(), 1e-2);
}

TEST(Scene, MotorTorquesAreClippedAtTheLimits) {
  const model::Arm arm(experiment().arm);
  Scene scene = restScene();
  const Vector4d wanted(1000, -1000, 1000, -1000);
  scene.advance(wanted, scene.openHand());
  EXPECT_LT((scene.state().tau_arm - arm.clipTorque(wanted)).norm(), 1e-12);
  EXPECT_LE(arm.torqueRatio(scene.state().tau_arm), 1 + 1e-12);
}

// Full torque against each stop from either side: it gives, then holds.
TEST(Scene, StopsHoldTheArm) {
  const model::ArmParameters& arm = experiment().arm;
  for (int joint = 0; joint < model::kArmJoints; ++joint) {
    for (const double side : {-1.0, 1.0}) {
      SceneStart start = restStart();
      start.q_arm[joint] = side > 0 ? arm.q_max[joint] - 0.05 : arm.q_min[joint] + 0.05;
      Scene scene(experiment(), simulation(), {}, start);
      double beyond = -1;
      for (int k = 0; k < 500; ++k) {
        Vector4d tau = holdTorque(scene, start.q_arm);
        tau[joint] = side * arm.tau_max[joint];
        scene.advance(tau, scene.openHand());
        const double q = scene.state().q.arm[joint];
        beyond = std::max(beyond, side > 0 ? q - arm.q_max[joint] : arm.q_min[joint] - q);
      }
      EXPECT_GT(beyond, 0) << "joint " << joint + 1;
      EXPECT_LT(beyond, 0.05) << "joint " << joint + 1;
      EXPECT_LT(std::abs(scene.state().qd.arm[joint]), 0.1) << "joint " << joint + 1;
    }
  }
}

TEST(Scene, TheFeederHoldsTheBallInAnOpenHand) {
  Scene scene = restScene();
  for (int k = 0; k < 390; ++k) {
    scene.advance(holdTorque(scene, experiment().q_rest), scene.openHand());
    ASSERT_LT((p_HBall(scene) - experiment().hand.p_HBall).norm(), 2e-4) << "tick " << k;
    for (const FingerForce& force : scene.state().forces)
      ASSERT_EQ(force.normal, 0);
  }
}

// From the feeder the ball falls out of the open hand as a free sphere with drag does.
TEST(Scene, AnUnheldBallFallsFreely) {
  Scene scene = restScene();
  const double release = simulation().feeder_release;
  std::vector<SceneEvent> released;
  model::BallState start;
  while (scene.ball().p_WBall.z() > simulation().floor.height + 0.1) {
    scene.advance(holdTorque(scene, experiment().q_rest), scene.openHand());
    const double time = static_cast<double>(scene.tick()) * kTick;
    const model::BallState now{scene.ball().p_WBall, scene.ball().v_WBall};
    if (time < release + 1e-9)
      start = now;
    for (const SceneEvent& event : eventsOf(scene, SceneEvent::Kind::kReleased))
      released.push_back(event);
    const auto expected = model::fly(start, std::max(0.0, time - release),
                                     experiment().ball.dragPerMetre(), experiment().arm.gravity);
    ASSERT_LT((now.p_WBall - expected.p_WBall).norm(), 1e-3) << "at " << time << " s";
  }
  ASSERT_EQ(released.size(), 1u);
  EXPECT_NEAR(released[0].time, release, 2e-3);
}

// Section 3.1: closed with the torques of the grasp, the hand carries the ball through a gentle motion and the ball stays.
TEST(Scene, AGraspHoldsTheBallWithoutCreep) {
  const double grip_force = 3;
  const HandCommand grasp = graspCommand(grip_force);
  Scene scene = restScene();
  Vector3d held = Vector3d::Zero();
  for (int k = 0; k < 2000; ++k) {
    const double t = std::max(0.0, k * kTick - 0.6);
    Vector4d q = experiment().q_rest;
    q[0] += 0.3 * (1 - std::cos(M_PI * t));
    q[3] += 0.2 * (1 - std::cos(2 * M_PI * t));
    scene.advance(holdTorque(scene, q), grasp);
    if (k == 600)
      held = p_HBall(scene);
    if (k > 600) {
      ASSERT_LT((p_HBall(scene) - held).norm(), 0.5e-3) << "tick " << k;
    }
  }
  EXPECT_LT((held - experiment().hand.p_HBall).norm(), 0.5e-3);
  EXPECT_NEAR(scene.state().forces[model::kThumb].normal, grip_force, 0.2);
}

TEST(Scene, AnOpenedThumbLetsTheBallGo) {
  HandCommand command = graspCommand(3);
  Scene scene = restScene();
  std::vector<SceneEvent> released;
  for (int k = 0; k < 800; ++k) {
    if (k == 700) {
      for (const int joint : {model::kProximalThumb, model::kDistalThumb}) {
        command.kp[joint] = 0;
        command.tau[joint] = -0.8;
      }
    }
    scene.advance(holdTorque(scene, experiment().q_rest), command);
    for (const SceneEvent& event : eventsOf(scene, SceneEvent::Kind::kReleased))
      released.push_back(event);
  }
  ASSERT_EQ(released.size(), 1u);
  EXPECT_GT(released[0].time, 0.700);
  EXPECT_LT(released[0].time, 0.730);
}

/// A swing of joints 1 and 4 with the thumb opened in it. @return the release.
SceneEvent releaseOfASwing(int substeps) {
  static const model::Arm arm(experiment().arm, experiment().hand.payload);
  SimulationSettings settings = simulation();
  settings.substeps = substeps;
  SceneStart start = restStart();
  start.q_arm = Vector4d(-1.3, 1.57, 0, 1.2);
  Scene scene(experiment(), settings, {}, start);
  HandCommand command = graspCommand(5);
  for (int k = 0; k < 1000; ++k) {
    // From 0.6 s on, a smooth swing there and back; the thumb opens in the middle of it.
    const double t = std::max(0.0, k * kTick - 0.6);
    const double rate = 2 * M_PI;
    const Vector4d swing(1.0, 0, 0, -0.6);
    const Vector4d q = start.q_arm + swing * (1 - std::cos(rate * t)) / 2;
    const Vector4d qd = swing * rate * std::sin(rate * t) / 2;
    const Vector4d qdd = swing * (t > 0 ? rate * rate * std::cos(rate * t) / 2 : 0);
    if (k == 850) {
      for (const int joint : {model::kProximalThumb, model::kDistalThumb}) {
        command.kp[joint] = 0;
        command.tau[joint] = -1;
      }
    }
    const Vector4d balance = holdTorque(scene, q, qd) - arm.gravityTorque(scene.state().q_arm);
    scene.advance(arm.inverseDynamics(q, qd, qdd) + arm.frictionTorque(qd) + balance, command);
    for (const SceneEvent& event : eventsOf(scene, SceneEvent::Kind::kReleased))
      return event;
  }
  return {};
}

// Half the step moves the ball's release by less than what moves a landing by 3 mm.
TEST(Scene, TheStepIsFineEnough) {
  const SceneEvent release = releaseOfASwing(simulation().substeps);
  const SceneEvent finer = releaseOfASwing(2 * simulation().substeps);
  EXPECT_GT(release.ball.v_WBall.norm(), 2);
  EXPECT_LT((release.ball.v_WBall - finer.ball.v_WBall).norm(), 5e-3);
  const double dt = finer.time - release.time;
  EXPECT_LT(std::abs(dt), 2e-4);
  EXPECT_LT((release.ball.p_WBall + dt * release.ball.v_WBall - finer.ball.p_WBall).norm(), 1e-3);
}

TEST(Scene, TheBrakeStopsTheArm) {
  SceneStart start = restStart();
  Scene scene(experiment(), simulation(), {}, start);
  for (int k = 0; k < 150; ++k)
    scene.advance({40, 0, 0, 0}, scene.openHand());
  EXPECT_GT(scene.state().qd.arm.norm(), 1);
  for (int k = 0; k < 600; ++k)
    scene.brake(scene.openHand());
  EXPECT_LT(scene.state().qd.arm.norm(), 0.02);
}

/// All bits of a scene's state.
uint64_t fingerprint(const Scene& scene, uint64_t hash) {
  const auto add = [&hash](const auto& vector) {
    for (int i = 0; i < vector.size(); ++i) {
      uint64_t bits;
      const double value = vector[i];
      std::memcpy(&bits, &value, sizeof(bits));
      hash = (hash ^ bits) * 0x100000001b3ull;
    }
  };
  add(scene.state().q.arm);
  add(scene.state().qd.arm);
  add(scene.state().q.hand);
  add(scene.state().qd.hand);
  add(scene.ball().p_WBall);
  add(scene.ball().v_WBall);
  add(scene.ball().w_WBall);
  for (const FingerForce& force : scene.state().forces)
    add(Eigen::Vector3d(force.normal, force.tangential[0], force.tangential[1]));
  return hash;
}

uint64_t fingerprintOfAThrow(int64_t seed) {
  Uncertainty uncertainty;
  uncertainty.setNormal(Uncertainty::kThrow, Error::kGraspOffset, 1e-3);
  SceneStart start = restStart();
  start.seeds.scene = seed;
  Scene scene(experiment(), simulation(), uncertainty, start);
  HandCommand command = graspCommand(3);
  uint64_t hash = 0xcbf29ce484222325ull;
  for (int k = 0; k < 900; ++k) {
    if (k == 750)
      command.tau[model::kProximalThumb] = -1;
    scene.advance(Vector4d(k > 600 ? 60 : 0, 0, 0, 0) + holdTorque(scene, experiment().q_rest),
                  command);
    hash = fingerprint(scene, hash);
  }
  return hash;
}

TEST(Scene, RepeatsBitForBit) {
  const uint64_t first = fingerprintOfAThrow(7);
  const auto heap_in_between =
      std::make_unique<Scene>(experiment(), simulation(), Uncertainty{}, restStart());
  EXPECT_EQ(fingerprintOfAThrow(7), first);
  EXPECT_NE(fingerprintOfAThrow(8), first);
}

TEST(Scene, ErrorsShowWhereTheyShould) {
  Uncertainty uncertainty;
  uncertainty.setNormal(Uncertainty::kThrow, Error::kGraspOffset, 3e-3);
  uncertainty.setNormal(Uncertainty::kThrow, Error::kEncoderOffset, 2e-3);
  Scene scene(experiment(), simulation(), uncertainty, restStart());
  EXPECT_GT(scene.errors().encoder_offset.norm(), 0);
  EXPECT_LT((scene.state().q_arm - scene.state().q.arm - scene.errors().encoder_offset).norm(),
            1e-15);
  EXPECT_LT((p_HBall(scene) - experiment().hand.p_HBall - scene.errors().ball_offset_H).norm(),
            1e-12);
}

TEST(Scene, RefusesAnArmBeyondItsStops) {
  SceneStart start = restStart();
  start.q_arm[1] = 2.5;
  try {
    const Scene scene(experiment(), simulation(), {}, start);
    FAIL() << "not refused";
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("joint 2 at 2.5 rad"));
  }
}

}  // namespace
}  // namespace fastball::sim_bullet
