#include "controller/control_law.h"

namespace fastball::controller {

ControlLaw::Torque ControlLaw::torque(Law law,
                                      const model::ArmMotion& desired,
                                      const Eigen::Vector4d& q,
                                      const Eigen::Vector4d& qd) const {
  Eigen::Vector4d wanted = kp_.cwiseProduct(desired.q - q) + kd_.cwiseProduct(desired.qd - qd);
  if (law == Law::kGravityPd) {
    wanted += arm_.gravityTorque(desired.q);
  } else {
    wanted +=
        arm_.inverseDynamics(desired.q, desired.qd, desired.qdd) + arm_.frictionTorque(desired.qd);
  }
  Torque result;
  result.tau = arm_.clipTorque(wanted);
  result.clipped = result.tau != wanted;
  return result;
}

}  // namespace fastball::controller
