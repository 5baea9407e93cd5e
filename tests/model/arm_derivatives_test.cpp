#include "model/arm_derivatives.h"

#include <gtest/gtest.h>

#include "tests/model/arm_states.h"

namespace fastball::model {
namespace {

using Eigen::Vector3d;

// Steps of central differences. Torques and accelerations are of second degree in the speeds and of
// first degree in the accelerations, so those steps need not be small.
constexpr double kAngleStep = 1e-5;
constexpr double kSpeedStep = 0.1;
constexpr double kAccelerationStep = 1;
constexpr double kTolerance = 1e-8;  // relative

const Vector3d kPoint(0.02, -0.03, 0.11);  // [m] in T, on no axis

/// Derivative of a vector `f` of four joint values at x.
template <typename Function>
auto slopes(const Function& f, const Vector4& x, double step) {
  Eigen::Matrix<double, decltype(f(x))::RowsAtCompileTime, kArmJoints> result;
  for (int i = 0; i < kArmJoints; ++i) {
    const Vector4 shift = step * Vector4::Unit(i);
    result.col(i) = (f(x + shift) - f(x - shift)) / (2 * step);
  }
  return result;
}

template <typename Value>
void expectNear(const Value& value, const Value& expected, double tolerance = kTolerance) {
  EXPECT_LT((value - expected).norm(), tolerance * (1 + expected.norm())) << value << "\nexpected\n"
                                                                          << expected;
}

enum class Shape { kEmpty, kLoaded, kCrooked };

/// The arm with an empty tool plate, with hand and ball on it, and with no term of its
/// Denavit-Hartenberg table zero.
Arm armOf(Shape shape) {
  ArmParameters parameters = defaultExperiment().arm;
  if (shape == Shape::kCrooked) {
    parameters.dh = {{{0.1, -1.2, 0.3}, {-0.2, 1.4, 0.05}, {0.1, -0.7, 0.5}, {-0.04, 0.9, 0.2}}};
  }
  return shape == Shape::kEmpty ? Arm(parameters)
                                : Arm(parameters, defaultExperiment().hand.payload);
}

class ArmTorqueDerivatives : public testing::TestWithParam<Shape> {
 protected:
  const Arm arm_ = armOf(GetParam());
};

INSTANTIATE_TEST_SUITE_P(Shapes,
                         ArmTorqueDerivatives,
                         testing::Values(Shape::kEmpty, Shape::kLoaded, Shape::kCrooked));

TEST_P(ArmTorqueDerivatives, TorqueAndMassMatrixAreThoseOfTheArm) {
  for (const auto& [q, qd, qdd] : testStates()) {
    const TorqueDerivatives torque = arm_.inverseDynamicsDerivatives(q, qd, qdd);
    expectNear(torque.tau, arm_.inverseDynamics(q, qd, qdd), 1e-13);
    expectNear(torque.dtau_dqdd, arm_.massMatrix(q), 1e-13);
  }
}

TEST_P(ArmTorqueDerivatives, TorqueSlopesAreFiniteDifferences) {
  for (const ArmState& at : testStates()) {
    const auto by_q = [&](const Vector4& q) { return arm_.inverseDynamics(q, at.qd, at.qdd); };
    const auto by_qd = [&](const Vector4& qd) { return arm_.inverseDynamics(at.q, qd, at.qdd); };
    const auto by_qdd = [&](const Vector4& qdd) { return arm_.inverseDynamics(at.q, at.qd, qdd); };
    const TorqueDerivatives torque = arm_.inverseDynamicsDerivatives(at.q, at.qd, at.qdd);
    expectNear(torque.dtau_dq, slopes(by_q, at.q, kAngleStep));
    expectNear(torque.dtau_dqd, slopes(by_qd, at.qd, kSpeedStep));
    expectNear(torque.dtau_dqdd, slopes(by_qdd, at.qdd, kAccelerationStep));
  }
}

// Joint 1 is vertical: nothing depends on where it stands.
TEST_P(ArmTorqueDerivatives, TheFirstAngleDoesNotMatter) {
  for (const auto& [q, qd, qdd] : testStates()) {
    EXPECT_EQ(arm_.inverseDynamicsDerivatives(q, qd, qdd).dtau_dq.col(0), Vector4::Zero());
  }
}

// C of Christoffel's symbols: its product with qd is the torque of the speeds, and dM/dt - 2 C is
// skew-symmetric.
TEST_P(ArmTorqueDerivatives, TheSpeedSlopeIsTwiceTheCoriolisMatrix) {
  for (const auto& [q, qd, qdd] : testStates()) {
    const Matrix4 twice_C = arm_.inverseDynamicsDerivatives(q, qd, qdd).dtau_dqd;
    const Vector4 torque = arm_.inverseDynamics(q, qd, Vector4::Zero()) - arm_.gravityTorque(q);
    expectNear<Vector4>(0.5 * twice_C * qd, torque, 1e-12);
    const double time = kAngleStep / (1 + qd.norm());
    const Matrix4 M_rate =
        (arm_.massMatrix(q + time * qd) - arm_.massMatrix(q - time * qd)) / (2 * time);
    const Matrix4 skew = M_rate - twice_C;
    expectNear<Matrix4>(skew, -skew.transpose());
  }
}

TEST_P(ArmTorqueDerivatives, AtRestTheAngleSlopeOfTheHoldingTorqueIsSymmetric) {
  for (const ArmState& state : testStates()) {
    const Matrix4 stiffness =
        arm_.inverseDynamicsDerivatives(state.q, Vector4::Zero(), Vector4::Zero()).dtau_dq;
    expectNear<Matrix4>(stiffness, stiffness.transpose(), 1e-13);
  }
}

TEST(ArmPointDerivatives, PointMotionIsThatOfTheArm) {
  const Arm arm = armOf(Shape::kCrooked);
  for (const auto& [q, qd, qdd] : testStates()) {
    const PointMotion point = arm.pointMotion(q, qd, qdd, kPoint);
    const Jacobian J = arm.pointJacobian(q, kPoint);
    expectNear(point.p, arm.p_WPoint(q, kPoint), 1e-14);
    expectNear(point.J, J, 1e-14);
    expectNear<Vector3d>(point.v, J * qd, 1e-14);
    expectNear(point.a, arm.pointAcceleration(q, qd, qdd, kPoint), 1e-13);
  }
}

TEST(ArmPointDerivatives, PointSlopesAreFiniteDifferences) {
  const Arm arm = armOf(Shape::kCrooked);
  for (const ArmState& at : testStates()) {
    const auto by_q = [&](const Vector4& q) { return arm.pointMotion(q, at.qd, at.qdd, kPoint); };
    const auto p_by_q = [&](const Vector4& q) { return by_q(q).p; };
    const auto v_by_q = [&](const Vector4& q) { return by_q(q).v; };
    const auto a_by_q = [&](const Vector4& q) { return by_q(q).a; };
    const auto a_by_qd = [&](const Vector4& qd) {
      return arm.pointMotion(at.q, qd, at.qdd, kPoint).a;
    };
    const auto a_by_qdd = [&](const Vector4& qdd) {
      return arm.pointMotion(at.q, at.qd, qdd, kPoint).a;
    };
    const PointMotion point = by_q(at.q);
    expectNear(point.J, slopes(p_by_q, at.q, kAngleStep));
    expectNear(point.dv_dq, slopes(v_by_q, at.q, kAngleStep));
    expectNear(point.da_dq, slopes(a_by_q, at.q, kAngleStep));
    expectNear(point.da_dqd, slopes(a_by_qd, at.qd, kSpeedStep));
    expectNear(point.J, slopes(a_by_qdd, at.qdd, kAccelerationStep));
  }
}

TEST(ArmPointDerivatives, ToolAxisTurnsWithTheTool) {
  const Arm arm = armOf(Shape::kCrooked);
  for (const ArmState& state : testStates()) {
    const DirectionMotion axis = arm.toolAxis(state.q);
    const auto axis_by_q = [&](const Vector4& x) { return arm.toolAxis(x).e; };
    expectNear<Vector3d>(axis.e, arm.X_WT(state.q).linear().col(2), 1e-15);
    expectNear(axis.de_dq, slopes(axis_by_q, state.q, kAngleStep));
  }
}

TEST(ArmFriction, SlopeIsAFiniteDifference) {
  const Arm arm = armOf(Shape::kCrooked);
  const auto friction = [&](const Vector4& qd) { return arm.frictionTorque(qd); };
  std::vector<Vector4> speeds = {Vector4(0.01, -0.02, 0.003, -0.005)};  // where it bends
  for (const ArmState& state : testStates()) {
    speeds.push_back(state.qd);
  }
  for (const Vector4& qd : speeds) {
    expectNear<Matrix4>(arm.frictionSlope(qd).asDiagonal(), slopes(friction, qd, 1e-7), 1e-6);
  }
}

}  // namespace
}  // namespace fastball::model
