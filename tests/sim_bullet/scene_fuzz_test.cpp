// Random balls, errors and commands, sensible or not: everything stays finite, and no energy comes from nowhere.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/sim_bullet/test_scene.h"

namespace fastball::sim_bullet {
namespace {

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine_);
  }
  double decades(double low, double high) {
    return std::exp(between(std::log(low), std::log(high)));
  }
  std::mt19937& engine() { return engine_; }

 private:
  std::mt19937 engine_;
};

config::Experiment randomExperiment(Random& random) {
  config::Experiment fuzzed = experiment();
  fuzzed.ball.mass = random.decades(0.01, 0.3);
  fuzzed.ball.youngs_modulus = random.decades(6e4, 1e7);
  fuzzed.ball.friction = random.between(0, 2);
  fuzzed.ball.damping_ratio = random.between(0, 1);
  fuzzed.ball.radius = random.between(0.03, 0.051);
  return fuzzed;
}

HandCommand randomCommand(Random& random) {
  using model::HandVector;
  const double wild = random.decades(0.1, 1e3);  // from what a hand can follow to what nothing can
  HandCommand command;
  command.q = randomVector<HandVector>(random.engine(), HandVector::Constant(wild));
  command.qd = randomVector<HandVector>(random.engine(), HandVector::Constant(10 * wild));
  command.tau = randomVector<HandVector>(random.engine(), HandVector::Constant(wild));
  command.kp.setConstant(random.between(0, 100));
  command.kd.setConstant(random.between(0, 0.3));
  return command;
}

/// [J], of its motion.
double ballEnergy(const config::Experiment& experiment, const BallMotion& ball) {
  return 0.5 * experiment.ball.mass * ball.v_WBall.squaredNorm() +
         0.5 * experiment.ball.inertia() * ball.w_WBall.squaredNorm();
}

TEST(SceneFuzz, StaysFiniteAndTheBallTakesNoMoreThanTheHandCanGive) {
  constexpr int kScenes = 2000, kTicks = 25;
  Random random(20);
  SimulationSettings settings = simulation();
  settings.feeder_release = 0.003;  // so that the hand soon has the ball alone
  double fastest = 0;
  for (int scene_number = 0; scene_number < kScenes; ++scene_number) {
    const config::Experiment fuzzed = randomExperiment(random);
    SceneStart start = restStart();
    start.seeds.scene = scene_number;
    Uncertainty uncertainty;
    uncertainty.setNormal(Uncertainty::kThrow, Error::kGraspOffset, 0.003);
    uncertainty.of(Uncertainty::kThrow, Error::kOpeningDelay).distribution = {
        Distribution::Shape::kHalfNormal, 0.003, 0};
    Scene scene(fuzzed, settings, uncertainty, start);
    const Eigen::Vector4d tau =
        randomVector<Eigen::Vector4d>(random.engine(), Eigen::Vector4d::Constant(200));
    HandCommand command = randomCommand(random);
    // [J]: what motors and drives can have done at most, with half a joule for gravity, feeder and the grip at the start.
    double work = 0.5;
    for (int k = 0; k < kTicks; ++k) {
      if (k % 8 == 7)
        command = randomCommand(random);
      scene.advance(tau, command);
      ASSERT_TRUE(scene.healthy()) << "scene " << scene_number << ", tick " << k;
      const RobotState& state = scene.state();
      work += kTick * (state.tau_arm.cwiseAbs().dot(state.qd.arm.cwiseAbs()) +
                       1.2 * state.qd.hand.tail<8>().cwiseAbs().sum() +
                       10 * state.qd.hand.head<2>().cwiseAbs().sum());
      const double energy = ballEnergy(fuzzed, scene.ball());
      EXPECT_LT(energy, work) << "scene " << scene_number << ", tick " << k;
      fastest = std::max(fastest, scene.ball().v_WBall.norm());
    }
  }
  EXPECT_LT(fastest, 30) << "m/s";
  EXPECT_GT(fastest, 0.5) << "the hands do move the ball";
}

}  // namespace
}  // namespace fastball::sim_bullet
