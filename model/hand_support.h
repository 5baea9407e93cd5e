#pragma once

#include <Eigen/Core>

#include "model/arm.h"
#include "model/finger_body.h"
#include "model/hand.h"
#include "model/hand_motion.h"

namespace fastball::model {

/// Joints that carry the hand: the arm's four, wrist roll, wrist flexion.
inline constexpr int kSupportJoints = kArmJoints + 2;
using SupportVector = Eigen::Matrix<double, kSupportJoints, 1>;
using SupportMatrix = Eigen::Matrix<double, kSupportJoints, kSupportJoints>;

/// How arm and wrist give way under the hand while their feedback holds them to the plan: linear about one pose of the arm,
///     M d2e/dt2 + kd de/dt + kp e = J^T (force, moment on the hand),  e the joints' deviation from the plan.
struct HandSupport {
  SupportMatrix M =
      SupportMatrix::Identity();             ///< [kg m^2], with the hand and its ball as one body
  SupportVector kp = SupportVector::Zero();  ///< [N m/rad]
  SupportVector kd = SupportVector::Zero();  ///< [N m s/rad]
  /// Velocity of H's origin and angular velocity of H, in the world, by joint speed.
  Eigen::Matrix<double, 6, kSupportJoints> J = Eigen::Matrix<double, 6, kSupportJoints>::Zero();
};

/// Of an arm at q with the wrist at (roll, flexion) [rad], whose servos have these gains.
HandSupport handSupport(const Arm& arm,
                        const HandParameters& hand,
                        const Vector4& q,
                        const Eigen::Vector2d& q_wrist,
                        const SupportVector& kp,
                        const SupportVector& kd);

/// The deviation of the hand from its plan, through time.
class SupportedHand {
 public:
  /// @param support must outlive this; null: nothing gives way.
  explicit SupportedHand(const HandSupport* support);
  /// Advances by dt [s] under what acts on the hand beyond what the plan has reckoned with, in H.
  void step(const HandWrench& load_H, const Eigen::Matrix3d& R_WH, double dt);
  /// The planned motion with the deviation.
  HandMotion moved(const HandMotion& planned) const;

 private:
  const HandSupport* support_;
  SupportMatrix inverse_ = SupportMatrix::Zero();
  SupportVector e_ = SupportVector::Zero(), ed_ = SupportVector::Zero(),
                edd_ = SupportVector::Zero();
};

}  // namespace fastball::model
