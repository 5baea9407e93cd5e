#include "vision_tracker/rig_calibration.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <opencv2/calib3d.hpp>
#include <stdexcept>

namespace fastball::vision_tracker {
namespace {

constexpr std::size_t kLeastShared = 3;  // views of a pair of cameras

/// p_to = R p_from + p.
struct Motion {
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  Eigen::Vector3d p = Eigen::Vector3d::Zero();
  Motion operator*(const Motion& first) const { return {R * first.R, R * first.p + p}; }
  Motion inverse() const { return {R.transpose(), -R.transpose() * p}; }
};

/// What two cameras see together.
struct Shared {
  std::vector<std::vector<cv::Point3f>> places;
  std::vector<std::vector<cv::Point2f>> first, second;
};

Shared sharedOf(const BoardCalibration& first, const BoardCalibration& second) {
  Shared shared;
  for (const BoardView& a : first.views) {
    for (const BoardView& b : second.views) {
      if (!a.used || !b.used || a.name != b.name)
        continue;
      BoardCorners of_a = a.corners, of_b = b.corners;
      keepCommon(of_a, of_b);
      if (!of_a.isEnough())
        continue;
      shared.places.push_back(of_a.places);
      shared.first.push_back(of_a.pixels);
      shared.second.push_back(of_b.pixels);
    }
  }
  return shared;
}

cv::Mat1d cameraMatrix(const model::Camera& c) {
  return (cv::Mat1d(3, 3) << c.fx, 0, c.cx, 0, c.fy, c.cy, 0, 0, 1);
}

cv::Mat1d distortion(const model::Camera& c) {
  cv::Mat1d d(1, 5);
  for (int i = 0; i < 5; ++i)
    d(i) = c.distortion[i];
  return d;
}

/// From the first camera's frame to the second's.
Motion between(const Shared& shared,
               const model::Camera& first,
               const model::Camera& second,
               double* rms) {
  cv::Mat1d K1 = cameraMatrix(first), D1 = distortion(first), K2 = cameraMatrix(second),
            D2 = distortion(second), R, T, E, F;
  *rms = cv::stereoCalibrate(shared.places, shared.first, shared.second, K1, D1, K2, D2,
                             {first.width, first.height}, R, T, E, F, cv::CALIB_FIX_INTRINSIC,
                             {cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 100, 1e-9});
  Motion motion;
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c)
      motion.R(r, c) = R(r, c);
    motion.p[r] = T(r);
  }
  return motion;
}

/// From the first camera's frame to each camera's.
std::vector<Motion> placesInRig(const std::vector<CameraImages>& images, RigCalibration& rig) {
  const std::size_t n = rig.cameras.size();
  std::vector<Motion> X_CiC0(n);
  std::vector<std::size_t> placed = {0};
  while (placed.size() < n) {
    Shared most;
    std::size_t from = 0, next = 0;
    for (std::size_t j = 1; j < n; ++j) {
      if (std::find(placed.begin(), placed.end(), j) != placed.end())
        continue;
      for (const std::size_t i : placed) {
        const Shared shared = sharedOf(rig.cameras[i], rig.cameras[j]);
        if (next != 0 && shared.places.size() <= most.places.size())
          continue;
        most = shared;
        from = i;
        next = j;
      }
    }
    if (most.places.size() < kLeastShared)
      throw std::invalid_argument(
          fmt::format("{} and {} see the board together in only {} views, {} are needed",
                      images[from].name, images[next].name, most.places.size(), kLeastShared));
    double rms = 0;
    X_CiC0[next] =
        between(most, rig.cameras[from].camera, rig.cameras[next].camera, &rms) * X_CiC0[from];
    rig.pair_rms = std::max(rig.pair_rms, rms);
    placed.push_back(next);
  }
  return X_CiC0;
}

/// From the board's frame in the world's view to the first camera's, by the camera that sees most of it.
Motion boardInRig(const RigCalibration& rig,
                  const std::vector<Motion>& X_CiC0,
                  const std::string& name) {
  const BoardView* best = nullptr;
  std::size_t camera = 0;
  for (std::size_t i = 0; i < rig.cameras.size(); ++i) {
    for (const BoardView& view : rig.cameras[i].views) {
      if (view.name != name || !view.used ||
          (best != nullptr && view.corners.ids.size() <= best->corners.ids.size()))
        continue;
      best = &view;
      camera = i;
    }
  }
  if (best == nullptr)
    throw std::invalid_argument(
        fmt::format("'{}' cannot be the world's view: it is none of the images, or shows too "
                    "little of the board",
                    name));
  return X_CiC0[camera].inverse() * Motion{best->R_CB, best->p_CB};
}

std::string firstUsed(const BoardCalibration& camera) {
  for (const BoardView& view : camera.views)
    if (view.used)
      return view.name;
  return {};
}

}  // namespace

RigCalibration calibrateRig(const std::vector<CameraImages>& images,
                            const BoardShape& shape,
                            const WorldBoard& world) {
  if (images.empty())
    throw std::invalid_argument("there is no camera to calibrate");
  RigCalibration rig;
  for (const CameraImages& camera : images) {
    try {
      rig.cameras.push_back(calibrateFromBoard(camera.images, shape));
    } catch (const std::invalid_argument& e) {
      throw std::invalid_argument(camera.name.empty() ? e.what() : camera.name + ": " + e.what());
    }
  }
  const std::vector<Motion> X_CiC0 = placesInRig(images, rig);
  const std::string name = world.view.empty() ? firstUsed(rig.cameras.front()) : world.view;
  const Motion X_C0W = boardInRig(rig, X_CiC0, name) * Motion{world.R_WB, world.p_WB}.inverse();
  for (std::size_t i = 0; i < rig.cameras.size(); ++i) {
    const Motion X_CW = X_CiC0[i] * X_C0W;
    rig.cameras[i].camera.R_CW = X_CW.R;
    rig.cameras[i].camera.p_CW = X_CW.p;
  }
  return rig;
}

}  // namespace fastball::vision_tracker
