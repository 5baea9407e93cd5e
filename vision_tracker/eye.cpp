#include "vision_tracker/eye.h"

#include <algorithm>
#include <cmath>

#include "vision_tracker/sphere_outline.h"

namespace fastball::vision_tracker {
namespace {

constexpr int kImagesToLearn = 4;
constexpr double kSizeTolerance = 0.03;  // of the radius: foam, shading at the limb
constexpr int kWayMargin = 40;           // [px], around the predicted way to the plane

}  // namespace

bool sameCamera(const CameraSetup& a, const CameraSetup& b) {
  return a.rate == b.rate && a.exposure == b.exposure && a.camera.width == b.camera.width &&
         a.camera.height == b.camera.height && a.camera.fx == b.camera.fx &&
         a.camera.fy == b.camera.fy && a.camera.cx == b.camera.cx && a.camera.cy == b.camera.cy &&
         a.camera.distortion == b.camera.distortion && a.camera.R_CW == b.camera.R_CW &&
         a.camera.p_CW == b.camera.p_CW;
}

Eye::Eye(const CameraSetup& setup, const DetectorOptions& options)
    : setup_(setup), detector_(setup.camera, setup.exposure, options) {}

void Eye::reset() {
  background_.reset();
  way_ = {};
  followed_ = 0;
}

Observation Eye::observation(int64_t utime,
                             int camera,
                             const BallFit& fit,
                             const Eigen::Vector3d& p_WBall,
                             double ball_radius) const {
  // An outline of a wrong size is wrong somewhere by as much: a finger or the ring covers a part.
  const double radius = sphereOutline(setup_.camera, p_WBall, ball_radius).meanRadius();
  const double off = std::max(0.0, std::abs(fit.radius - radius) - kSizeTolerance * radius);
  return {utime,      camera,
          fit.centre, fit.cov + off * off * Eigen::Matrix2d::Identity(),
          fit.radius, fit.radius_variance + off * off};
}

bool Eye::hasLearned() const {
  return background_.images() >= kImagesToLearn;
}

void Eye::learn(const cv::Mat& image, const cv::Rect& leave, bool following) {
  // A track that is sure needs the background on its way only, which was learned before: half as
  // often will do.
  const bool sure = following && knowsWay();
  if (!sure || ++followed_ % 2 == 0)
    background_.learn(image, leave, sure ? way_ : cv::Rect());
}

void Eye::expectWay(const std::vector<Eigen::Vector3d>& places_W) {
  way_ = {};
  for (const Eigen::Vector3d& p_W : places_W) {
    const cv::Rect area = detector_.area(p_W);
    if (!area.empty())
      way_ |= area + cv::Size(2 * kWayMargin, 2 * kWayMargin) - cv::Point(kWayMargin, kWayMargin);
  }
}

}  // namespace fastball::vision_tracker
