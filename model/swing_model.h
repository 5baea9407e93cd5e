#pragma once

#include <Eigen/Core>

#include "model/arm_parameters.h"

namespace fastball::model {

/// The constants of Eq. (3) [kg m^2].
struct SwingInertias {
  double J1 = 0, J2 = 0, A12 = 0, B2 = 0;
};

/// Upper and lower arm of the swing models as the paper has them: a point mass each, at the
/// distance L_ig from the joint.
struct SwingParameters {
  double m1 = 0;   ///< [kg], upper arm
  double L1 = 0;   ///< [m], shoulder to elbow
  double L1g = 0;  ///< [m], shoulder to m1
  double m2 = 0;   ///< [kg], lower arm with what it carries
  double L2 = 0;   ///< [m], elbow to end effector
  double L2g = 0;  ///< [m], elbow to m2

  /// Eq. (3).
  SwingInertias inertias() const {
    return {m1 * L1g * L1g, m2 * L2g * L2g, m2 * L1 * L2g, m2 * L1 * L1};
  }
};

/// The WAM as such a pair. Upper arm: link 3, which turns with the upper arm beyond the shoulder,
/// at its centre of mass along the arm's line; links 1 and 2 are left out, their masses lie within
/// 2 cm of the shoulder. Lower arm: link 4 and the payload as one mass at their common centre of
/// mass. The elbow's offset of 45 mm from that line, moments of inertia about the bodies' own
/// centres, and the drives' inertia are left out, as the paper ignores "the moment of inertia".
/// @param payload on the tool plate, in frame T.
/// @param p_TEnd [m], end effector in frame T; its distance along the forearm counts.
SwingParameters swingParameters(const ArmParameters& arm,
                                const RigidBody& payload,
                                const Eigen::Vector3d& p_TEnd);

/// A mechanism of three joints q = (q1, q2, q3) without gravity: tau = M(q) qdd + h(q, qd), Eq.
/// (1). Fixed size: nothing allocates or throws.
class SwingModel {
 public:
  explicit SwingModel(const SwingParameters& parameters)
      : p_(parameters), i_(parameters.inertias()) {}
  virtual ~SwingModel() = default;
  const SwingParameters& parameters() const { return p_; }

  /// [kg m^2], symmetric; positive definite where the joints move the masses independently.
  virtual Eigen::Matrix3d massMatrix(const Eigen::Vector3d& q) const = 0;
  /// Coriolis and centrifugal torques [N m].
  virtual Eigen::Vector3d h(const Eigen::Vector3d& q, const Eigen::Vector3d& qd) const = 0;
  /// A point [m] on the line of the lower arm at `along` [m] from the elbow; axis 1 is z.
  virtual Eigen::Vector3d lowerArmPoint(const Eigen::Vector3d& q, double along) const = 0;
  /// Velocity [m/s] of that point.
  virtual Eigen::Vector3d lowerArmVelocity(const Eigen::Vector3d& q,
                                           const Eigen::Vector3d& qd,
                                           double along) const = 0;

  Eigen::Vector3d endEffector(const Eigen::Vector3d& q) const { return lowerArmPoint(q, p_.L2); }
  Eigen::Vector3d endEffectorVelocity(const Eigen::Vector3d& q, const Eigen::Vector3d& qd) const {
    return lowerArmVelocity(q, qd, p_.L2);
  }
  /// [J]
  double kineticEnergy(const Eigen::Vector3d& q, const Eigen::Vector3d& qd) const;
  /// tau [N m], Eq. (1).
  Eigen::Vector3d inverseDynamics(const Eigen::Vector3d& q,
                                  const Eigen::Vector3d& qd,
                                  const Eigen::Vector3d& qdd) const;
  /// qdd [rad/s^2] under tau. Not finite where M is singular.
  Eigen::Vector3d forwardDynamics(const Eigen::Vector3d& q,
                                  const Eigen::Vector3d& qd,
                                  const Eigen::Vector3d& tau) const;
  /// qdd2 [rad/s^2] of joint 2 without torque while joints 1 and 3 have the accelerations given.
  double passiveBend(const Eigen::Vector3d& q,
                     const Eigen::Vector3d& qd,
                     double qdd1,
                     double qdd3) const;

 protected:
  SwingParameters p_;
  SwingInertias i_;
};

/// Section 2.2, Fig. 2: upper arm at polar angle q2 from axis 1 and azimuth q1; lower arm kept
/// level (perpendicular to axis 1) at azimuth q1 + q3.
class LevelSwingModel : public SwingModel {
 public:
  using SwingModel::SwingModel;
  Eigen::Matrix3d massMatrix(const Eigen::Vector3d& q) const override;
  Eigen::Vector3d h(const Eigen::Vector3d& q, const Eigen::Vector3d& qd) const override;
  Eigen::Vector3d lowerArmPoint(const Eigen::Vector3d& q, double along) const override;
  Eigen::Vector3d lowerArmVelocity(const Eigen::Vector3d& q,
                                   const Eigen::Vector3d& qd,
                                   double along) const override;
};

/// Section 2.6, Fig. 6: upper arm at the fixed polar angle gamma and azimuth q1; lower arm at polar
/// angle gamma + q2 and azimuth q1 + q3.
class AnalogousSwingModel : public SwingModel {
 public:
  AnalogousSwingModel(const SwingParameters& parameters, double gamma)
      : SwingModel(parameters), gamma_(gamma) {}
  double gamma() const { return gamma_; }
  Eigen::Matrix3d massMatrix(const Eigen::Vector3d& q) const override;
  Eigen::Vector3d h(const Eigen::Vector3d& q, const Eigen::Vector3d& qd) const override;
  Eigen::Vector3d lowerArmPoint(const Eigen::Vector3d& q, double along) const override;
  Eigen::Vector3d lowerArmVelocity(const Eigen::Vector3d& q,
                                   const Eigen::Vector3d& qd,
                                   double along) const override;

 private:
  double gamma_;
};

/// Eq. (2) as printed: the elements for (q2, q3); the paper prints none of M11, M12, M13, h1. It is
/// not the model of any mechanism (it does not keep its energy) and stands here to be compared
/// only.
struct PrintedSwingModel {
  Eigen::Matrix2d M;  ///< M22, M23; M32, M33 [kg m^2]
  Eigen::Vector2d h;  ///< h2, h3 [N m]
};
PrintedSwingModel printedSwingModel(const SwingInertias& inertias,
                                    const Eigen::Vector3d& q,
                                    const Eigen::Vector3d& qd);

// The approximate accelerations [rad/s^2] from which the paper takes its base functions.

/// Eq. (7), level model, joint 2: the exp base function near q2 = 0, an oscillation of angular
/// frequency qd1 about pi/2.
double bendByEq7(double q2, double qd1);
/// Eq. (9), level model, joint 3.
double elbowByEq9(const SwingInertias& inertias, double q2, double q3, double qd1);
/// Frequency omega3 [rad/s] of Eq. (10) by Eq. (9) for small q3.
double elbowFrequencyByEq9(const SwingParameters& parameters, double q2, double qd1);
/// Eq. (16), analogous model, joint 2.
double bendByEq16(double gamma, double q2, double qd1);
/// Eq. (17), analogous model, joint 3 at q2 = 0.
double elbowByEq17(const SwingInertias& inertias, double q3, double qd1);

}  // namespace fastball::model
