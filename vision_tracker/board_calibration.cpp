#include "vision_tracker/board_calibration.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

namespace fastball::vision_tracker {
namespace {

constexpr int kLeastViews = 8;
constexpr double kLeastTilt = 15;      // [deg], between the two views that differ most
constexpr double kLeastCovered = 0.3;  // share of the image's cells with a corner in them
constexpr int kCells = 6;              // along each side of the image
constexpr double kStretch = 100;       // of the residuals in the picture

/// Indices of views.
using Chosen = std::vector<std::size_t>;

double coveredShare(const std::vector<BoardView>& views,
                    const Chosen& chosen,
                    const cv::Size& size) {
  std::vector<bool> cells(kCells * kCells, false);
  for (const std::size_t k : chosen) {
    for (const cv::Point2f& p : views[k].corners.pixels) {
      const int x = std::clamp(static_cast<int>(p.x * kCells / static_cast<float>(size.width)), 0,
                               kCells - 1);
      const int y = std::clamp(static_cast<int>(p.y * kCells / static_cast<float>(size.height)), 0,
                               kCells - 1);
      cells[static_cast<std::size_t>(y * kCells + x)] = true;
    }
  }
  return static_cast<double>(std::count(cells.begin(), cells.end(), true)) / (kCells * kCells);
}

/// [deg], the largest angle between the board's normals of two views.
double largestTilt(const std::vector<BoardView>& views) {
  double least = 1;
  for (const BoardView& a : views)
    for (const BoardView& b : views)
      if (a.used && b.used)
        least = std::min(least, a.R_CB.col(2).dot(b.R_CB.col(2)));
  return std::acos(std::clamp(least, -1.0, 1.0)) * 180 / CV_PI;
}

void drawResiduals(const BoardCorners& view,
                   const std::vector<cv::Point2f>& predicted,
                   cv::Mat& picture) {
  for (std::size_t i = 0; i < predicted.size(); ++i) {
    const cv::Point2f end =
        predicted[i] + static_cast<float>(kStretch) * (view.pixels[i] - predicted[i]);
    cv::line(picture, predicted[i], end, {0, 0, 200}, 1, cv::LINE_AA);
    cv::circle(picture, predicted[i], 1, {160, 80, 0}, cv::FILLED, cv::LINE_AA);
  }
}

/// Runs OpenCV's calibration and fills everything but the checks.
void solve(const Chosen& chosen, const cv::Size& size, BoardCalibration& result) {
  std::vector<std::vector<cv::Point3f>> places;
  std::vector<std::vector<cv::Point2f>> pixels;
  for (const std::size_t k : chosen) {
    places.push_back(result.views[k].corners.places);
    pixels.push_back(result.views[k].corners.pixels);
  }
  cv::Mat1d K, D, deviations, pose_deviations, errors;
  std::vector<cv::Mat> rotations, translations;
  result.rms = cv::calibrateCamera(places, pixels, size, K, D, rotations, translations, deviations,
                                   pose_deviations, errors);
  model::Camera& camera = result.camera;
  camera.width = size.width;
  camera.height = size.height;
  camera.fx = K(0, 0);
  camera.fy = K(1, 1);
  camera.cx = K(0, 2);
  camera.cy = K(1, 2);
  for (int i = 0; i < 5; ++i)
    camera.distortion[i] = D(i);
  result.focal_sigma = deviations(0);
  result.centre_sigma = std::max(deviations(2), deviations(3));
  result.picture = cv::Mat(size, CV_8UC3, cv::Scalar::all(255));
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    BoardView& view = result.views[chosen[i]];
    view.used = true;
    view.rms = errors(static_cast<int>(i));
    cv::Mat1d R;
    cv::Rodrigues(rotations[i], R);
    for (int r = 0; r < 3; ++r) {
      for (int c = 0; c < 3; ++c)
        view.R_CB(r, c) = R(r, c);
      view.p_CB[r] = translations[i].at<double>(r);
    }
    std::vector<cv::Point2f> predicted;
    cv::projectPoints(places[i], rotations[i], translations[i], K, D, predicted);
    drawResiduals(view.corners, predicted, result.picture);
  }
}

}  // namespace

BoardCalibration calibrateFromBoard(const std::vector<BoardImage>& images,
                                    const BoardShape& shape) {
  const BoardFinder finder(shape);
  BoardCalibration result;
  Chosen chosen;
  for (std::size_t i = 0; i < images.size(); ++i) {
    if (images[i].grey.size() != images[0].grey.size())
      throw std::invalid_argument(fmt::format(
          "{}: has {} x {} pixels, but {} has {} x {}", images[i].name, images[i].grey.cols,
          images[i].grey.rows, images[0].name, images[0].grey.cols, images[0].grey.rows));
    BoardView view;
    view.name = images[i].name;
    view.corners = finder.find(images[i].grey);
    if (view.corners.isEnough())
      chosen.push_back(i);
    result.views.push_back(view);
  }
  if (static_cast<int>(chosen.size()) < kLeastViews)
    throw std::invalid_argument(
        fmt::format("only {} of {} images show at least {} corners of the board, {} are needed",
                    chosen.size(), images.size(), BoardCorners::kLeast, kLeastViews));
  const cv::Size size = images[0].grey.size();
  const double covered = coveredShare(result.views, chosen, size);
  if (covered < kLeastCovered)
    throw std::invalid_argument(
        fmt::format("the corners of all images lie in {:.0f} % of the image, at least {:.0f} % are "
                    "needed: hold the board into its "
                    "corners too",
                    100 * covered, 100 * kLeastCovered));
  solve(chosen, size, result);
  const double tilt = largestTilt(result.views);
  if (!(tilt > kLeastTilt))
    throw std::invalid_argument(
        fmt::format("the board is seen from nearly the same direction in all images ({:.1f} "
                    "degrees between the two that differ "
                    "most, {} are needed): tilt it",
                    tilt, kLeastTilt));
  return result;
}

}  // namespace fastball::vision_tracker
