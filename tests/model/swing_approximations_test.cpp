// What the paper's approximations of the swing model (sections 2.2 and 2.6) leave out.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

#include "model/swing.h"
#include "model/swing_model.h"
#include "tests/model/wam_swing.h"

namespace fastball::model {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// The WAM's lower arm under an upper arm `factor` times as heavy: Eq. (4) holds better and better.
SwingParameters heavyUpperArm(double factor) {
  SwingParameters p = wamParameters();
  p.m1 *= factor;
  return p;
}

TEST(PrintedEq2, GainsEnergyOutOfNothing) {
  const SwingParameters p = wamParameters();
  const LevelSwingModel model(p);
  std::mt19937 random(3);
  std::uniform_real_distribution<> unit(-1, 1);
  double largest = 0;
  for (int i = 0; i < 200; ++i) {
    const Vector3d q(0, 1.5 + unit(random), 3 * unit(random)),
        qd(0, 6 * unit(random), 6 * unit(random));
    const PrintedSwingModel printed = printedSwingModel(p.inertias(), q, qd);
    const Eigen::Vector2d rate = qd.tail<2>();
    const double h = 1e-6;
    const Eigen::Matrix2d M_rate = (printedSwingModel(p.inertias(), q + h * qd, qd).M -
                                    printedSwingModel(p.inertias(), q - h * qd, qd).M) /
                                   (2 * h);
    // q1 locked, tau2 = tau3 = 0: M qdd = -h, and dE/dt = qd . (M qdd + 1/2 dM/dt qd).
    const double power = rate.dot(-printed.h + 0.5 * M_rate * rate);
    const double S2 = std::sin(q[1]), C2 = std::cos(q[1]), S3 = std::sin(q[2]), C3 = std::cos(q[2]);
    EXPECT_NEAR(power,
                2 * p.inertias().A12 * qd[1] * qd[1] * (2 * C2 * C3 * qd[1] + S2 * S3 * qd[2]),
                1e-6);
    largest = std::max(largest, std::abs(power));
    // The derivation keeps it.
    const Matrix3d model_rate =
        (model.massMatrix(q + h * qd) - model.massMatrix(q - h * qd)) / (2 * h);
    EXPECT_NEAR(qd.dot(-model.h(q, qd) + 0.5 * model_rate * qd), 0, 1e-6);
  }
  EXPECT_GT(largest, 10) << "[W]: with the WAM's masses it is no trifle";
}

TEST(PrintedEq2, DiffersFromTheDerivationByALowerArmThatTurnsByTwiceQ2) {
  const SwingParameters p = wamParameters();
  const LevelSwingModel model(p);
  const Vector3d q(0.2, 1.1, 0.7), qd(3, 2, -4);
  const PrintedSwingModel printed = printedSwingModel(p.inertias(), q, qd);
  const double C2 = std::cos(q[1]), S2 = std::sin(q[1]), S3 = std::sin(q[2]), C3 = std::cos(q[2]);
  const double M22 = model.massMatrix(q)(1, 1), J2 = p.inertias().J2, A12 = p.inertias().A12;
  EXPECT_NEAR(printed.M(0, 0) - M22, 4 * J2 * C3 * C3 + 4 * A12 * S2 * C3, 1e-12);
  EXPECT_NEAR(printed.h[0] - model.h(q, qd)[1],
              -4 * J2 * std::sin(2 * q[2]) * qd[1] * qd[2] - 2 * A12 * C2 * C3 * qd[1] * qd[1] -
                  4 * A12 * S2 * S3 * qd[1] * qd[2],
              1e-12);
  EXPECT_NEAR(printed.h[1] - model.h(q, qd)[2], 2 * J2 * std::sin(2 * q[2]) * qd[1] * qd[1], 1e-12);
  EXPECT_EQ(printed.M(0, 1), model.massMatrix(q)(1, 2));
  EXPECT_EQ(printed.M(1, 1), model.massMatrix(q)(2, 2));
}

/// States (q2, q3) with both joints bent, and speeds of joint 3.
std::array<State, 4> bentStates() {
  return {{{{0.3, 0.8, 0.5}, {6, 0, 0}},
           {{0, 1.2, -1.0}, {4, 0, 2}},
           {{0, 2.0, 2.0}, {-5, 0, -1}},
           {{1, 1e-6, 1e-6}, {7, 0, 0}}}};
}

TEST(Eq7, LeavesOutA12OverJ1PlusB2) {
  for (const double factor : {1.0, 10.0, 100.0, 1e6}) {
    const SwingParameters p = heavyUpperArm(factor);
    const double dropped = p.inertias().A12 / (p.inertias().J1 + p.inertias().B2);
    for (const State& s : bentStates()) {
      const double complete = LevelSwingModel(p).passiveBend(s.q, s.qd, 0, 0);
      const double speed = s.qd[0] + s.qd[2];
      EXPECT_NEAR(complete - bendByEq7(s.q[1], s.qd[0]),
                  dropped * std::cos(s.q[1]) * std::cos(s.q[2]) * speed * speed,
                  1e-12 * speed * speed);
    }
  }
  const SwingParameters wam = wamParameters();
  EXPECT_NEAR(wam.inertias().A12 / (wam.inertias().J1 + wam.inertias().B2), 0.35, 0.01);
  const SwingParameters heavy = heavyUpperArm(100);
  EXPECT_LT(heavy.inertias().A12 / (heavy.inertias().J1 + heavy.inertias().B2), 0.02);
}

TEST(Eq7, GrowsAtTheRateDq1NearZeroAndOscillatesWithDq1AboutAQuarterTurn) {
  const double qd1 = 5, h = 1e-5;
  EXPECT_EQ(bendByEq7(0, qd1), 0);
  EXPECT_NEAR(bendByEq7(h, qd1) / h, qd1 * qd1, 1e-6) << "exp(qd1 t)";
  EXPECT_NEAR(bendByEq7(M_PI / 2 + h, qd1) / h, -qd1 * qd1, 1e-6) << "sin(qd1 t)";
}

TEST(Eq9, IsCompleteWhileJoint2RestsAndLeavesOutItsSpeed) {
  const SwingParameters p = wamParameters();
  const LevelSwingModel model(p);
  for (State s : bentStates()) {
    for (const double ratio : {0.0, 0.01, 0.3}) {
      s.qd[1] = ratio * s.qd[0];
      const double complete = -model.h(s.q, s.qd)[2] / model.massMatrix(s.q)(2, 2);
      const double kept = elbowByEq9(p.inertias(), s.q[1], s.q[2], s.qd[0]);
      const double share = 2 * ratio / (std::tan(s.q[1]) * std::tan(s.q[2])) + ratio * ratio;
      EXPECT_NEAR(complete, kept * (1 + share), 1e-9);
    }
  }
  const double h = 1e-5, omega3 = elbowFrequencyByEq9(p, 1.1, 6);
  EXPECT_NEAR(elbowByEq9(p.inertias(), 1.1, h, 6) / h, -omega3 * omega3, 1e-6);
  EXPECT_NEAR(elbowFrequencyByEq9(p, M_PI / 2, 1), 1.44, 0.01) << "of the WAM, times dq1";
}

TEST(Eq16, LeavesOutATermThatIsNotSmall) {
  const SwingParameters p = wamParameters();
  for (const double gamma : {0.4, 1.0, 1.5}) {
    const AnalogousSwingModel model(p, gamma);
    for (State s : bentStates()) {
      s.qd[2] = 0;
      const double polar = gamma + s.q[1];
      const double kept = bendByEq16(gamma, s.q[1], s.qd[0]);
      const double share =
          p.inertias().A12 / p.inertias().J2 * std::sin(gamma) * std::cos(s.q[2]) / std::sin(polar);
      EXPECT_NEAR(model.passiveBend(s.q, s.qd, 0, 0), kept * (1 + share), 1e-9);
    }
  }
  // In the straight arm it is L1 / L2g times what is kept, and no heavy upper arm makes it small.
  for (const double factor : {1.0, 1e6}) {
    const AnalogousSwingModel model(heavyUpperArm(factor), 1.0);
    const double complete = model.passiveBend({0, 0, 0}, {5, 0, 0}, 0, 0);
    EXPECT_NEAR(complete / bendByEq16(1.0, 0, 5) - 1, p.L1 / p.L2g, 1e-9);
    EXPECT_NEAR(complete / bendByEq16(1.0, 0, 5) - 1, 2.08, 0.01);
  }
}

TEST(Eq17, IsCompleteAtQ2ZeroWhileJoint2Rests) {
  const SwingParameters p = wamParameters();
  for (const double gamma : {0.4, 1.0, 1.5}) {
    const AnalogousSwingModel model(p, gamma);
    for (State s : bentStates()) {
      for (const double q2 : {0.0, 0.3}) {
        s.q[1] = q2;
        const double complete = -model.h(s.q, s.qd)[2] / model.massMatrix(s.q)(2, 2);
        const double off = std::sin(gamma) / std::sin(gamma + q2);
        EXPECT_NEAR(complete, off * elbowByEq17(p.inertias(), s.q[2], s.qd[0]), 1e-9);
      }
    }
  }
}

TEST(Eq8, AmplitudeAndPhaseAreOneParameter) {
  // Derivatives of alpha e^(omega t + phi) by alpha and phi are proportional at all times: rank
  // one.
  const double alpha = 0.3, phi = -0.7, omega = 6;
  Eigen::Matrix<double, 20, 2> jacobian;
  for (int i = 0; i < 20; ++i) {
    const double e = std::exp(omega * 0.02 * i + phi);
    jacobian.row(i) << e, alpha * e;
  }
  const Eigen::Matrix2d gram = jacobian.transpose() * jacobian;
  EXPECT_NEAR(gram.determinant(), 0, 1e-10 * gram.squaredNorm());
  // So ExpBase has one: alpha2 e^(phi2 + omega2 t_switch).
  const double t_switch = 0.26;
  for (const double shift : {0.0, 0.5, -2.0}) {
    const ExpBase base{alpha * std::exp(shift) * std::exp(phi - shift + omega * t_switch), omega,
                       t_switch, 0.1};
    for (const double t : {-0.5, 0.0, 0.2})
      EXPECT_NEAR(base.at(t).q, alpha * std::exp(omega * t + phi) + 0.1, 1e-12);
  }
}

TEST(Eq14, IsExactForTheSinJointsOnly) {
  const double omega = 5, phi = 0.3;
  const SinBase sin_base{0.8, omega, phi, 0};
  for (const double t : {(-phi - M_PI / 2) / omega, (-phi + M_PI / 2) / omega})
    EXPECT_NEAR(0.8 * omega * std::cos(omega * t + phi), 0, 1e-12);
  EXPECT_EQ(sin_base.start(), (-phi - M_PI / 2) / omega);
  EXPECT_EQ(sin_base.end(), (-phi + M_PI / 2) / omega);
  // "Defined in a similar way", an exp joint still has a fifth of the speed that it has at its
  // phase zero.
  const ExpBase exp_base{0.8, omega, 1, 0};  // alpha e^(omega t + phi) with phi = -omega
  const double at_start = exp_base.at((omega - M_PI / 2) / omega).qd, at_zero = exp_base.at(1).qd;
  EXPECT_NEAR(at_start / at_zero, std::exp(-M_PI / 2), 1e-12);
  EXPECT_NEAR(at_start / at_zero, 0.208, 0.001);
}

}  // namespace
}  // namespace fastball::model
