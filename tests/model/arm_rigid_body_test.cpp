#include "model/rigid_body.h"

#include <gtest/gtest.h>

#include "tests/model/arm_states.h"

namespace fastball::model {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

Matrix3d tensor(double xx, double yy, double zz, double xy, double xz, double yz) {
  return (Matrix3d() << xx, xy, xz, xy, yy, yz, xz, yz, zz).finished();
}

// Barrett's AC-02 tables also give the inertia about each link's frame. That the two agree by the
// parallel-axis theorem proves the signs of the off-diagonals in config/arm/wam4.yaml, which are
// opposite to the printed ones.
TEST(ArmRigidBody, InertiaAboutTheLinkFramesIsTheManufacturers) {
  const std::vector<Matrix3d> printed = {
      tensor(0.29486350, 0.11350017, 0.25065343, 0.00795023, 0.00009311, 0.00018711),
      tensor(0.02606840, 0.01472202, 0.01934814, 0.00001346, 0.00011701, -0.00003659),
      tensor(0.13671601, 0.00588354, 0.13951371, 0.01680434, -0.00000510, 0.00000530),
      tensor(0.03952350, 0.04008214, 0.00210299, -0.00000189, -0.00003117, -0.00000131)};
  for (int i = 0; i < kArmJoints; ++i) {
    const Matrix3d I = inertiaAboutOrigin(defaultExperiment().arm.links[i]);
    EXPECT_LT((I - printed[i]).cwiseAbs().maxCoeff(), 3e-8) << "link " << i + 1 << "\n"
                                                            << I - printed[i];
  }
}

TEST(ArmRigidBody, TwoHalvesOfASphereAreTheSphere) {
  const Vector3d centre(0.1, -0.2, 0.3);
  const RigidBody half = solidSphere(1, 0.05, centre);
  const RigidBody whole = combine(half, half);
  EXPECT_DOUBLE_EQ(whole.mass, 2);
  EXPECT_TRUE(whole.p_BCom.isApprox(centre));
  EXPECT_TRUE(whole.I_BCom.isApprox(0.4 * 2 * 0.05 * 0.05 * Matrix3d::Identity()));
}

TEST(ArmRigidBody, CombiningKeepsTheInertiaAboutTheOriginInEveryFrame) {
  const auto& links = defaultExperiment().arm.links;
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  X.rotate(Eigen::AngleAxisd(1.1, Vector3d(1, 2, -3).normalized()));
  X.pretranslate(Vector3d(0.3, -0.1, 0.7));
  for (int i = 0; i + 1 < kArmJoints; ++i) {
    const RigidBody both = combine(links[i], links[i + 1]);
    EXPECT_TRUE(inertiaAboutOrigin(both).isApprox(
        inertiaAboutOrigin(links[i]) + inertiaAboutOrigin(links[i + 1]), 1e-12));
    // Moved together or one by one: the same body.
    const RigidBody moved = transformed(X, both);
    const RigidBody one_by_one = combine(transformed(X, links[i]), transformed(X, links[i + 1]));
    EXPECT_TRUE(moved.p_BCom.isApprox(one_by_one.p_BCom, 1e-12));
    EXPECT_TRUE(moved.I_BCom.isApprox(one_by_one.I_BCom, 1e-12));
  }
}

TEST(ArmRigidBody, NothingAddsNothing) {
  const RigidBody& link = defaultExperiment().arm.links[3];
  const RigidBody same = combine(link, RigidBody());
  EXPECT_EQ(same.mass, link.mass);
  EXPECT_TRUE(same.p_BCom.isApprox(link.p_BCom));
  EXPECT_TRUE(same.I_BCom.isApprox(link.I_BCom));
  EXPECT_EQ(combine(RigidBody(), RigidBody()).p_BCom, Vector3d::Zero());
}

}  // namespace
}  // namespace fastball::model
