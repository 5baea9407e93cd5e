#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

#include "config/experiment.h"
#include "model/arm.h"
#include "model/hand.h"

namespace fastball::view {

/// Points of arm and hand between which a viewer draws capsules.
enum FigurePoint {
  kBase,
  kShoulder,
  kUpperArmEnd,
  kElbow,
  kForearmStart,
  kToolPlate,
  kPalm,
  kHeldBall,    ///< centre of a ball in the grasp
  kFirstFinger  ///< then base, knuckle and tip of each of model::kFingers
};
inline constexpr int kFigurePoints = kFirstFinger + 3 * model::kFingers;

/// What is drawn between two points.
struct FigurePart {
  int from, to;
  double radius;  ///< [m]
  bool hand;
};

/// Arm and hand as points in the world, by the model's own kinematics.
class Figure {
 public:
  /// `floor` [m]: world z at which the arm's column stands.
  Figure(const config::Experiment& experiment, double floor);

  using Points = std::array<Eigen::Vector3f, kFigurePoints>;
  /// In the world [m]; not a number where a posture is not known.
  Points points(const std::optional<model::Vector4>& q_arm,
                const std::optional<model::HandVector>& q_hand) const;
  const std::vector<FigurePart>& parts() const { return parts_; }

 private:
  model::Arm arm_;
  model::Hand hand_;
  double floor_;
  std::vector<FigurePart> parts_;
};

}  // namespace fastball::view
