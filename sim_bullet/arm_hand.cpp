#include "sim_bullet/arm_hand.h"

#include <BulletDynamics/Featherstone/btMultiBody.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include "sim_bullet/bullet_eigen.h"

namespace fastball::sim_bullet {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using model::kArmJoints;
using model::kHandJoints;

/// Bullet clamps joint speeds at 100 rad/s unless told otherwise; this is never reached.
constexpr double kNoSpeedClamp = 1e9;
/// Base velocities stand before the joints in Bullet's vectors.
constexpr int kBaseEntries = 6;

struct Principal {
  Matrix3d R_FB;     ///< axes of Bullet's link frame in F
  Vector3d moments;  ///< [kg m^2]
};

Principal principalAxes(const LinkSpec& link) {
  const Matrix3d I = link.body.I_BCom + link.drive_inertia * link.axis_F * link.axis_F.transpose();
  const Eigen::SelfAdjointEigenSolver<Matrix3d> solver(I);
  Principal result{solver.eigenvectors(), solver.eigenvalues().cwiseMax(0.0)};
  if (result.R_FB.determinant() < 0)
    result.R_FB.col(0) *= -1;
  return result;
}

}  // namespace

struct ArmHand::Scratch {
  btAlignedObjectArray<btQuaternion> rotations;
  btAlignedObjectArray<btVector3> origins, vectors;
  btAlignedObjectArray<btScalar> reals;
  std::array<btVector3, kJoints + 1> w, v;
  std::array<double, kBaseEntries + kJoints> unit{};
  std::array<std::array<double, kBaseEntries + kJoints>, kArmJoints> response;
};

ArmHand::ArmHand(const model::ArmParameters& arm,
                 const model::HandParameters& hand,
                 const model::HandVector& q_hand,
                 Fingers fingers)
    : tree_(linkTree(arm, hand)),
      drive_inertia_(arm.drive_inertia),
      q_frozen_(q_hand),
      hand_joints_(fingers == Fingers::kMoving ? kHandJoints : 0),
      scratch_(std::make_unique<Scratch>()) {
  build(q_hand, fingers);
  setState({Eigen::Vector4d::Zero(), q_hand}, {});
  updateKinematics();
}

ArmHand::~ArmHand() = default;

void ArmHand::build(const model::HandVector& q_hand, Fingers fingers) {
  body_ = std::make_unique<btMultiBody>(kJoints, 0.0, btVector3(0, 0, 0), true, false);
  body_->setLinearDamping(0);
  body_->setAngularDamping(0);
  body_->setHasSelfCollision(false);
  body_->setMaxCoordinateVelocity(kNoSpeedClamp);
  for (int i = 0; i < kJoints; ++i) {
    const LinkSpec& link = tree_[i];
    const Principal principal = principalAxes(link);
    const Matrix3d& R_FB = principal.R_FB;
    R_FPrincipal_[i] = R_FB;
    const bool fixed = fingers == Fingers::kFrozen && i >= kArmJoints;
    const Eigen::Isometry3d X_PF = fixed ? jointPose(link, q_hand[i - kArmJoints]) : link.X_PF;
    const Matrix3d R_PB =
        link.parent < 0 ? Matrix3d::Identity() : R_FPrincipal_[link.parent];  // parent's axes
    const Vector3d p_PCom = link.parent < 0 ? Vector3d::Zero() : tree_[link.parent].body.p_BCom;
    const btQuaternion rotation =
        toBullet(Matrix3d(R_FB.transpose() * X_PF.linear().transpose() * R_PB));
    const btVector3 to_axis = toBullet(Vector3d(R_PB.transpose() * (X_PF * link.p_FAxis - p_PCom)));
    const btVector3 to_com =
        toBullet(Vector3d(R_FB.transpose() * (link.body.p_BCom - link.p_FAxis)));
    if (fixed) {
      body_->setupFixed(i, link.body.mass, toBullet(principal.moments), link.parent, rotation,
                        to_axis, to_com);
    } else {
      body_->setupRevolute(i, link.body.mass, toBullet(principal.moments), link.parent, rotation,
                           toBullet(Vector3d(R_FB.transpose() * link.axis_F)), to_axis, to_com,
                           true);
    }
  }
  body_->finalizeMultiDof();
}

btMultiBody& ArmHand::body() {
  return *body_;
}

void ArmHand::setState(const JointVectors& q, const JointVectors& qd) {
  for (int i = 0; i < kArmJoints; ++i) {
    body_->setJointPos(i, q.arm[i]);
    body_->setJointVel(i, qd.arm[i]);
  }
  for (int i = 0; i < hand_joints_; ++i) {
    body_->setJointPos(kArmJoints + i, q.hand[i]);
    body_->setJointVel(kArmJoints + i, qd.hand[i]);
  }
}

JointVectors ArmHand::q() const {
  JointVectors q{Eigen::Vector4d::Zero(), q_frozen_};
  for (int i = 0; i < kArmJoints; ++i)
    q.arm[i] = body_->getJointPos(i);
  for (int i = 0; i < hand_joints_; ++i)
    q.hand[i] = body_->getJointPos(kArmJoints + i);
  return q;
}

JointVectors ArmHand::qd() const {
  JointVectors qd;
  for (int i = 0; i < kArmJoints; ++i)
    qd.arm[i] = body_->getJointVel(i);
  for (int i = 0; i < hand_joints_; ++i)
    qd.hand[i] = body_->getJointVel(kArmJoints + i);
  return qd;
}

void ArmHand::addTorques(const JointVectors& tau) {
  for (int i = 0; i < kArmJoints; ++i)
    body_->addJointTorque(i, tau.arm[i]);
  for (int i = 0; i < hand_joints_; ++i)
    body_->addJointTorque(kArmJoints + i, tau.hand[i]);
}

void ArmHand::addForceAt(int link, const Vector3d& p_W, const Vector3d& f_W) {
  const Vector3d p_WCom = motion_[link].X_WF * tree_[link].body.p_BCom;
  body_->addLinkForce(link, toBullet(f_W));
  body_->addLinkTorque(link, toBullet(Vector3d((p_W - p_WCom).cross(f_W))));
}

void ArmHand::addMoment(int link, const Vector3d& m_W) {
  body_->addLinkTorque(link, toBullet(m_W));
}

void ArmHand::updateKinematics() {
  body_->forwardKinematics(scratch_->rotations, scratch_->origins);
  body_->compTreeLinkVelocities(scratch_->w.data(), scratch_->v.data());
  for (int i = 0; i < kJoints; ++i) {
    const btTransform& X_WB = body_->getLink(i).m_cachedWorldTransform;
    const Vector3d w_W = toEigen(X_WB.getBasis() * scratch_->w[i + 1]);
    const Vector3d v_WCom = toEigen(X_WB.getBasis() * scratch_->v[i + 1]);
    LinkMotion& motion = motion_[i];
    motion.X_WF.linear().noalias() = toEigen(X_WB.getBasis()) * R_FPrincipal_[i].transpose();
    const Vector3d p_FCom_W = motion.X_WF.linear() * tree_[i].body.p_BCom;
    motion.X_WF.translation() = toEigen(X_WB.getOrigin()) - p_FCom_W;
    motion.w_WF = w_W;
    motion.v_WF = v_WCom - w_W.cross(p_FCom_W);
  }
}

void ArmHand::addDriveInertia(const Eigen::Vector4d& qd_before, double dt) {
  Eigen::Vector4d qdd0;
  Eigen::Matrix4d W_aa;
  for (int j = 0; j < kArmJoints; ++j) {
    qdd0[j] = (body_->getJointVel(j) - qd_before[j]) / dt;
    scratch_->unit[kBaseEntries + j] = 1;
    body_->calcAccelerationDeltasMultiDof(scratch_->unit.data(), scratch_->response[j].data(),
                                          scratch_->reals, scratch_->vectors);
    scratch_->unit[kBaseEntries + j] = 0;
    for (int i = 0; i < kArmJoints; ++i)
      W_aa(i, j) = scratch_->response[j][kBaseEntries + i];
  }
  const Eigen::Matrix4d A = Eigen::Matrix4d::Identity() + W_aa * drive_inertia_.asDiagonal();
  const Eigen::Vector4d qdd = A.inverse() * qdd0;
  for (int j = 0; j < kArmJoints; ++j)
    body_->applyDeltaVeeMultiDof(scratch_->response[j].data(), -drive_inertia_[j] * qdd[j] * dt);
}

double ArmHand::energy(double gravity) {
  updateKinematics();
  double energy = 0.5 * qd().arm.cwiseAbs2().dot(drive_inertia_);
  for (int i = 0; i < kJoints; ++i) {
    const LinkSpec& link = tree_[i];
    const LinkMotion& motion = motion_[i];
    const Vector3d p_WCom = motion.X_WF * link.body.p_BCom;
    const Vector3d w_F = motion.X_WF.linear().transpose() * motion.w_WF;
    const Matrix3d I =
        link.body.I_BCom + link.drive_inertia * link.axis_F * link.axis_F.transpose();
    energy += 0.5 * link.body.mass * motion.velocityAt(p_WCom).squaredNorm() +
              0.5 * w_F.dot(I * w_F) + link.body.mass * gravity * p_WCom.z();
  }
  return energy;
}

}  // namespace fastball::sim_bullet
