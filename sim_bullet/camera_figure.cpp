#include "sim_bullet/camera_figure.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace fastball::sim_bullet {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr int kShift = 4;            // OpenCV's fixed point: 1/16 px
constexpr double kNearest = 0.2;     // [m], nearer to the camera nothing is drawn
constexpr double kUpperArm = 0.055;  // [m], radii as they look on the WAM
constexpr double kForearm = 0.042;   // [m]
constexpr double kWrist = 0.035;     // [m]

void addLimb(const model::Camera& camera,
             const Eigen::Vector3d& a,
             const Eigen::Vector3d& b,
             double radius,
             int grey,
             std::vector<Limb>& limbs) {
  const double za = camera.toCamera(a).z(), zb = camera.toCamera(b).z();
  if (std::min(za, zb) < kNearest)
    return;
  limbs.push_back({camera.project(a), camera.project(b), camera.fx * radius / za,
                   camera.fx * radius / zb, (za + zb) / 2, grey});
}

/// Fills the outline of a limb whose radii are scaled by `scale` and which is moved by `shift` [px].
void fillLimb(const Limb& limb,
              double scale,
              const Eigen::Vector2d& shift,
              int grey,
              const cv::Point& origin,
              cv::Mat& image) {
  constexpr int kArc = 9;
  const Eigen::Vector2d axis = limb.end - limb.start;
  const double heading = axis.norm() > 1e-9 ? std::atan2(axis.y(), axis.x()) : 0;
  std::array<cv::Point, std::size_t{2} * kArc> outline;
  for (int i = 0; i < 2 * kArc; ++i) {
    const bool at_end = i < kArc;
    const double turn = kPi * (i % kArc) / (kArc - 1) - kPi / 2;
    const double angle = heading + turn + (at_end ? 0 : kPi);
    const Eigen::Vector2d p = (at_end ? limb.end : limb.start) + shift +
                              scale * (at_end ? limb.end_radius : limb.start_radius) *
                                  Eigen::Vector2d(std::cos(angle), std::sin(angle));
    outline[static_cast<std::size_t>(i)] = {
        static_cast<int>(std::lround((p.x() - origin.x) * (1 << kShift))),
        static_cast<int>(std::lround((p.y() - origin.y) * (1 << kShift)))};
  }
  cv::fillConvexPoly(image, outline.data(), 2 * kArc, cv::Scalar(grey), cv::LINE_AA, kShift);
}

}  // namespace

Figure::Figure(const model::ArmParameters& arm, const model::HandParameters& hand)
    : arm_(arm), hand_(hand) {}

std::vector<Limb> Figure::limbs(const model::Camera& camera, const SceneSnapshot& snapshot) const {
  std::vector<Limb> limbs;
  const model::Vector4& q = snapshot.q_arm;
  const Eigen::Vector3d elbow = arm_.X_WLink(q, 3).translation();
  const Eigen::Vector3d forearm = arm_.X_WLink(q, 4).translation();
  const Eigen::Isometry3d X_WT = arm_.X_WT(q);
  addLimb(camera, Eigen::Vector3d::Zero(), elbow, kUpperArm, 125, limbs);
  addLimb(camera, elbow, forearm, kForearm, 105, limbs);
  addLimb(camera, forearm, X_WT.translation(), kForearm, 135, limbs);
  const Eigen::Isometry3d X_WH =
      X_WT * hand_.X_TH(snapshot.q_hand[model::kWristRoll], snapshot.q_hand[model::kWristFlexion]);
  const model::HandParameters& hand = hand_.parameters();
  addLimb(camera, X_WH.translation(), X_WH * Eigen::Vector3d(0, 0, hand.palm_distance), kWrist, 90,
          limbs);
  for (const model::Finger finger : {model::kFingerA, model::kThumb, model::kFingerB}) {
    for (const model::Segment& phalanx : hand_.phalanges(finger, snapshot.q_hand))
      addLimb(camera, X_WH * phalanx.p_start, X_WH * phalanx.p_end, hand.finger_radius, 115, limbs);
  }
  std::stable_sort(limbs.begin(), limbs.end(),
                   [](const Limb& a, const Limb& b) { return a.depth > b.depth; });
  return limbs;
}

cv::Rect boundsOf(const Limb& limb) {
  constexpr double kBorder = 3;
  const Eigen::Vector2d a(limb.start_radius + kBorder, limb.start_radius + kBorder);
  const Eigen::Vector2d b(limb.end_radius + kBorder, limb.end_radius + kBorder);
  const Eigen::Vector2d low = (limb.start - a).cwiseMin(limb.end - b);
  const Eigen::Vector2d high = (limb.start + a).cwiseMax(limb.end + b);
  return {cv::Point(static_cast<int>(std::floor(low.x())), static_cast<int>(std::floor(low.y()))),
          cv::Point(static_cast<int>(std::ceil(high.x())) + 1,
                    static_cast<int>(std::ceil(high.y())) + 1)};
}

void drawLimb(const Limb& limb, const cv::Point& origin, cv::Mat& image) {
  fillLimb(limb, 1, {0, 0}, limb.grey - 25, origin, image);
  // The lit side: a narrower limb, moved towards the lamp.
  const double radius = std::min(limb.start_radius, limb.end_radius);
  fillLimb(limb, 0.6, {-0.2 * radius, -0.3 * radius}, limb.grey + 15, origin, image);
}

}  // namespace fastball::sim_bullet
