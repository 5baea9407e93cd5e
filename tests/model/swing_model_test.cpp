// Section 2.2 (the swing model) and 2.6 (the analogous one): the complete equations of motion.
#include "model/swing_model.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <array>
#include <boost/numeric/odeint.hpp>
#include <cmath>
#include <functional>
#include <memory>
#include <random>

#include "config/experiment.h"
#include "model/arm.h"
#include "model/swing.h"
#include "tests/model/wam_swing.h"

namespace fastball::model {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// Random states of one of the two models.
class BothSwingModels : public ::testing::TestWithParam<int> {
 protected:
  double uniform(double low, double high) {
    return std::uniform_real_distribution<>(low, high)(random_);
  }
  Vector3d vector(double size) {
    return {uniform(-size, size), uniform(-size, size), uniform(-size, size)};
  }
  /// With arm lengths and masses of its own for each call.
  std::unique_ptr<SwingModel> model() {
    SwingParameters p{uniform(0.5, 5), uniform(0.2, 1), uniform(0.1, 0.5),
                      uniform(0.5, 3), uniform(0.2, 1), uniform(0.1, 0.5)};
    if (GetParam() == 0)
      return std::make_unique<LevelSwingModel>(p);
    return std::make_unique<AnalogousSwingModel>(p, gamma());
  }
  double gamma() { return gamma_ = uniform(0.4, 1.4); }
  /// Where joints 1 and 3 are not the same: the upper (first model) or lower arm (second) off axis
  /// 1.
  State state() {
    const double polar = uniform(0.2, 2.9) - (GetParam() == 0 ? 0 : gamma_);
    return {{uniform(-3, 3), polar, uniform(-3, 3)}, vector(8)};
  }
  std::mt19937 random_{11};
  double gamma_ = 0;
};

INSTANTIATE_TEST_SUITE_P(Of, BothSwingModels, ::testing::Values(0, 1), [](const auto& test) {
  return test.param == 0 ? "Section22" : "Section26";
});

/// C of h = C qd by the Christoffel symbols of M, with M's derivatives from differences.
Matrix3d coriolis(const SwingModel& model, const State& s) {
  constexpr double kStep = 1e-5;
  std::array<Matrix3d, 3> dM;
  for (int k = 0; k < 3; ++k) {
    const Vector3d step = kStep * Vector3d::Unit(k);
    dM[k] = (model.massMatrix(s.q + step) - model.massMatrix(s.q - step)) / (2 * kStep);
  }
  Matrix3d C = Matrix3d::Zero();
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      for (int k = 0; k < 3; ++k)
        C(i, j) += 0.5 * (dM[k](i, j) + dM[j](i, k) - dM[i](j, k)) * s.qd[k];
  return C;
}

TEST_P(BothSwingModels, VelocityIsTheDerivativeOfPosition) {
  for (int i = 0; i < 100; ++i) {
    const auto m = model();
    const State s = state();
    const double h = 1e-6;
    const Vector3d v = (m->endEffector(s.q + h * s.qd) - m->endEffector(s.q - h * s.qd)) / (2 * h);
    EXPECT_LT((m->endEffectorVelocity(s.q, s.qd) - v).norm(), 1e-7);
  }
}

TEST_P(BothSwingModels, KineticEnergyIsThatOfTheTwoMasses) {
  for (int i = 0; i < 100; ++i) {
    const auto m = model();
    const State s = state();
    const SwingParameters& p = m->parameters();
    // m1 is on the way from the shoulder to the elbow.
    const Vector3d elbow = m->lowerArmVelocity(s.q, s.qd, 0);
    const double energy = 0.5 * p.m1 * (p.L1g / p.L1 * elbow).squaredNorm() +
                          0.5 * p.m2 * m->lowerArmVelocity(s.q, s.qd, p.L2g).squaredNorm();
    EXPECT_NEAR(m->kineticEnergy(s.q, s.qd), energy, 1e-12 * (1 + energy));
  }
}

TEST_P(BothSwingModels, MassMatrixIsSymmetricPositiveDefinite) {
  for (int i = 0; i < 1000; ++i) {
    const auto m = model();
    const Matrix3d M = m->massMatrix(state().q);
    EXPECT_EQ(M, M.transpose());
    EXPECT_GT(Eigen::SelfAdjointEigenSolver<Matrix3d>(M).eigenvalues()[0], 0);
  }
}

TEST_P(BothSwingModels, HFollowsFromTheMassMatrix) {
  for (int i = 0; i < 200; ++i) {
    const auto m = model();
    State s = state();
    if (i == 0)
      s.qd.setZero();
    if (i == 1)
      s.qd = Vector3d::Constant(1e-9);
    const Matrix3d C = coriolis(*m, s);
    EXPECT_LT((m->h(s.q, s.qd) - C * s.qd).norm(), 1e-7 * s.qd.squaredNorm() + 1e-300);
    const double h = 1e-5;
    const Matrix3d M_rate =
        (m->massMatrix(s.q + h * s.qd) - m->massMatrix(s.q - h * s.qd)) / (2 * h);
    const Matrix3d N = M_rate - 2 * C;
    EXPECT_LT((N + N.transpose()).norm(), 1e-6 * (1 + s.qd.norm()));
  }
}

TEST_P(BothSwingModels, ForwardDynamicsInvertsInverseDynamics) {
  for (int i = 0; i < 100; ++i) {
    const auto m = model();
    const State s = state();
    const Vector3d qdd = vector(50);
    const Vector3d tau = m->inverseDynamics(s.q, s.qd, qdd);
    EXPECT_LT((m->forwardDynamics(s.q, s.qd, tau) - qdd).norm(), 1e-8);
    // Joint 2 alone without torque.
    const double passive = m->passiveBend(s.q, s.qd, qdd[0], qdd[2]);
    EXPECT_NEAR(m->inverseDynamics(s.q, s.qd, {qdd[0], passive, qdd[2]})[1], 0, 1e-9);
  }
}

/// q, qd and the work [J] of the torques.
using Motion = std::array<double, 7>;

Motion moved(const SwingModel& model,
             const State& from,
             const std::function<Vector3d(double)>& torque,
             double duration) {
  Motion x{};
  Vector3d::Map(&x[0]) = from.q;
  Vector3d::Map(&x[3]) = from.qd;
  namespace ode = boost::numeric::odeint;
  const auto rate = [&](const Motion& y, Motion& dy, double t) {
    const Vector3d q(y[0], y[1], y[2]), qd(y[3], y[4], y[5]), tau = torque(t);
    Vector3d::Map(&dy[0]) = qd;
    Vector3d::Map(&dy[3]) = model.forwardDynamics(q, qd, tau);
    dy[6] = qd.dot(tau);
  };
  ode::integrate_adaptive(ode::make_controlled<ode::runge_kutta_dopri5<Motion>>(1e-11, 1e-11), rate,
                          x, 0.0, duration, 1e-4);
  return x;
}

TEST_P(BothSwingModels, EnergyIsKeptWithoutTorqueAndGrowsByTheWorkOfTorques) {
  for (int i = 0; i < 10; ++i) {
    const auto m = model();
    State s = state();
    s.qd *= 0.3;
    const Vector3d amplitude = i % 2 == 0 ? Vector3d(0, 0, 0) : vector(2);
    const Vector3d rate = vector(10);
    const auto torque = [&](double t) -> Vector3d {
      return amplitude.array() * (rate * t).array().cos();
    };
    const Motion end = moved(*m, s, torque, 0.5);
    const double before = m->kineticEnergy(s.q, s.qd),
                 after = m->kineticEnergy({end[0], end[1], end[2]}, {end[3], end[4], end[5]});
    EXPECT_NEAR(after, before + end[6], 1e-7 * (1 + before + after));
    EXPECT_GT((Vector3d(end[0], end[1], end[2]) - s.q).norm(), 0.01) << "nothing moved";
  }
}

/// The WAM with point masses, no elbow offset, no drives and no gravity: what section 2.6 draws.
Arm pointMassWam(const SwingParameters& p) {
  ArmParameters arm;
  arm.dh = {{{0, -M_PI / 2, 0}, {0, M_PI / 2, 0}, {0, -M_PI / 2, p.L1}, {0, M_PI / 2, 0}}};
  arm.links[2].mass = p.m1;
  arm.links[2].p_BCom << 0, p.L1 - p.L1g, 0;
  arm.links[3].mass = p.m2;
  arm.links[3].p_BCom << 0, 0, p.L2g;
  arm.gravity = 0;
  arm.qd_max = arm.tau_max = Vector4::Ones();
  return Arm(arm);
}

TEST(AnalogousSwingModelOnTheWam, HasTheTorquesOfTheArmsRigidBodyDynamics) {
  const SwingParameters p = wamParameters();
  const Arm arm = pointMassWam(p);
  std::mt19937 random(5);
  std::uniform_real_distribution<> unit(-1, 1);
  int checked = 0;
  for (int i = 0; i < 200; ++i) {
    const double gamma = 0.8 + 0.6 * unit(random);
    SwingAngles swing;
    for (int k = 0; k < 3; ++k) {
      swing.q[k] = 1.5 * unit(random);
      swing.qd[k] = 8 * unit(random);
      swing.qdd[k] = 60 * unit(random);
    }
    const WamMotion wam = wamFromSwing(swing, gamma, 1, 0);
    if (wam.q[3] < 0.1)
      continue;
    ++checked;
    const Vector4 tau_wam = arm.inverseDynamics(wam.q, wam.qd, wam.qdd);
    const Vector3d tau =
        AnalogousSwingModel(p, gamma).inverseDynamics(swing.q, swing.qd, swing.qdd);
    // Virtual power: tau . dq is the same in both sets of joints for every dq.
    for (int k = 0; k < 3; ++k) {
      SwingAngles unit_speed = swing;
      unit_speed.qd = Vector3d::Unit(k);
      const Vector4 qd = wamFromSwing(unit_speed, gamma, 1, 0).qd;
      EXPECT_NEAR(tau[k], tau_wam.dot(qd), 1e-8 * (1 + tau_wam.norm() * qd.norm())) << k;
    }
  }
  EXPECT_GT(checked, 150);
}

TEST(SwingParametersOfTheWam, KeepMassAndFirstMoment) {
  const config::Experiment e =
      config::loadExperiment(FASTBALL_SOURCE_DIR "/config/experiment.yaml");
  const SwingParameters p = wamParameters();
  EXPECT_DOUBLE_EQ(p.m2, e.arm.links[3].mass + e.hand.payload.mass);
  EXPECT_DOUBLE_EQ(p.L2, 0.5);
  // Gravity of link 4 and payload about a level elbow, without its offset, is that of m2 at L2g.
  ArmParameters forearm = e.arm;
  for (int i = 0; i < 3; ++i)
    forearm.links[i] = {};
  forearm.dh[2].a = forearm.dh[3].a = 0;
  const Arm arm(forearm, e.hand.payload);
  const Vector4 q(0, 0, 0, M_PI / 2);
  EXPECT_NEAR(-arm.gravityTorque(q)[3], p.m2 * p.L2g * forearm.gravity, 1e-9);
  // Link 3 alone about the shoulder.
  ArmParameters upper = e.arm;
  upper.links[0] = upper.links[1] = upper.links[3] = {};
  EXPECT_NEAR(-Arm(upper).gravityTorque({0, M_PI / 2, M_PI / 2, 0})[1],
              p.m1 * p.L1g * upper.gravity, 1e-9);
}

TEST(SwingParametersOfTheWam, DoNotSatisfyEq4) {
  // J1 >> J2, A12, B2 does not hold with a hand at the end of the arm.
  const SwingInertias i = wamParameters().inertias();
  EXPECT_NEAR(i.J1, 0.21, 0.005);
  EXPECT_NEAR(i.J2, 0.13, 0.005);
  EXPECT_NEAR(i.A12, 0.28, 0.005);
  EXPECT_NEAR(i.B2, 0.57, 0.005);
}

}  // namespace
}  // namespace fastball::model
