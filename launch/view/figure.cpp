#include "launch/view/figure.h"

#include <limits>

namespace fastball::view {
namespace {

// [m], outlines for drawing; the model has no thickness. The column is as wide as planner.paper.body_clearance takes it to be.
constexpr double kColumnRadius = 0.13;
constexpr double kUpperArmRadius = 0.065;
constexpr double kElbowRadius = 0.055;
constexpr double kForearmRadius = 0.047;

}  // namespace

Figure::Figure(const config::Experiment& experiment, double floor)
    : arm_(experiment.arm), hand_(experiment.hand), floor_(floor) {
  parts_ = {{kBase, kShoulder, kColumnRadius, false},
            {kShoulder, kUpperArmEnd, kUpperArmRadius, false},
            {kUpperArmEnd, kElbow, kElbowRadius, false},
            {kElbow, kForearmStart, kElbowRadius, false},
            {kForearmStart, kToolPlate, kForearmRadius, false},
            {kToolPlate, kPalm, experiment.hand.palm_radius, true}};
  for (int finger = 0; finger < model::kFingers; ++finger) {
    const int base = kFirstFinger + 3 * finger;
    parts_.push_back({kPalm, base, experiment.hand.finger_radius, true});
    parts_.push_back({base, base + 1, experiment.hand.finger_radius, true});
    parts_.push_back({base + 1, base + 2, experiment.hand.finger_radius, true});
  }
}

Figure::Points Figure::points(const std::optional<model::Vector4>& q_arm,
                              const std::optional<model::HandVector>& q_hand) const {
  Points points;
  points.fill(Eigen::Vector3f::Constant(std::numeric_limits<float>::quiet_NaN()));
  const auto set = [&points](int i, const Eigen::Vector3d& p_W) {
    points.at(static_cast<std::size_t>(i)) = p_W.cast<float>();
  };
  set(kBase, {0, 0, floor_});
  set(kShoulder, Eigen::Vector3d::Zero());
  if (!q_arm)
    return points;
  set(kUpperArmEnd, arm_.X_WLink(*q_arm, 2) * Eigen::Vector3d(0, 0, arm_.parameters().dh[2].d));
  set(kElbow, arm_.X_WLink(*q_arm, 3).translation());
  set(kForearmStart, arm_.X_WLink(*q_arm, 4).translation());
  const Eigen::Isometry3d X_WT = arm_.X_WT(*q_arm);
  set(kToolPlate, X_WT.translation());
  if (!q_hand)
    return points;
  const Eigen::Isometry3d X_WH =
      X_WT * hand_.X_TH((*q_hand)[model::kWristRoll], (*q_hand)[model::kWristFlexion]);
  set(kPalm, X_WH * Eigen::Vector3d(0, 0, hand_.parameters().palm_distance));
  set(kHeldBall, X_WH * hand_.parameters().p_HBall);
  for (int finger = 0; finger < model::kFingers; ++finger) {
    const auto phalanges = hand_.phalanges(static_cast<model::Finger>(finger), *q_hand);
    const int base = kFirstFinger + 3 * finger;
    set(base, X_WH * phalanges[0].p_start);
    set(base + 1, X_WH * phalanges[0].p_end);
    set(base + 2, X_WH * phalanges[1].p_end);
  }
  return points;
}

}  // namespace fastball::view
