#include "vision_tracker/board_calibration.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <opencv2/aruco/charuco.hpp>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

namespace fastball::vision_tracker {
namespace {

constexpr int kLeastViews = 8;
constexpr int kLeastCorners = 8;       // of a view: six would do without noise
constexpr double kLeastTilt = 15;      // [deg], between the two views that differ most
constexpr double kLeastCovered = 0.3;  // share of the image's cells with a corner in them
constexpr int kCells = 6;              // along each side of the image
constexpr double kStretch = 100;       // of the residuals in the picture

using Board = cv::Ptr<cv::aruco::CharucoBoard>;

Board boardOf(const BoardShape& shape) {
  static const std::map<std::string, int> kDictionaries = {
      {"4X4_50", cv::aruco::DICT_4X4_50},   {"4X4_250", cv::aruco::DICT_4X4_250},
      {"5X5_100", cv::aruco::DICT_5X5_100}, {"5X5_250", cv::aruco::DICT_5X5_250},
      {"6X6_250", cv::aruco::DICT_6X6_250}, {"7X7_250", cv::aruco::DICT_7X7_250}};
  const auto dictionary = kDictionaries.find(shape.dictionary);
  if (dictionary == kDictionaries.end())
    throw std::invalid_argument(fmt::format(
        "'{}' is no dictionary of markers; there are 4X4_50, 4X4_250, 5X5_100, 5X5_250, "
        "6X6_250 and 7X7_250",
        shape.dictionary));
  const cv::Ptr<cv::aruco::Dictionary> markers =
      cv::aruco::getPredefinedDictionary(dictionary->second);
  if (!(shape.columns >= 3 && shape.rows >= 3 &&
        shape.columns * shape.rows / 2 <= markers->bytesList.rows))
    throw std::invalid_argument(
        fmt::format("a board of {} x {} squares cannot be: it needs three squares each way, and "
                    "the dictionary {} has {} markers",
                    shape.columns, shape.rows, shape.dictionary, markers->bytesList.rows));
  if (!(shape.marker > 0 && shape.marker < shape.square))
    throw std::invalid_argument(
        fmt::format("a marker of {} m does not fit a square of {} m", shape.marker, shape.square));
  return cv::aruco::CharucoBoard::create(shape.columns, shape.rows,
                                         static_cast<float>(shape.square),
                                         static_cast<float>(shape.marker), markers);
}

/// The corners found in one image.
struct Corners {
  std::size_t image = 0;
  std::vector<int> ids;
  std::vector<cv::Point2f> pixels;
  std::vector<cv::Point3f> places;  ///< [m], on the board
};

Corners findCorners(const Board& board, const cv::Mat& grey) {
  Corners corners;
  std::vector<std::vector<cv::Point2f>> markers;
  std::vector<int> ids;
  cv::aruco::detectMarkers(grey, board->dictionary, markers, ids);
  if (ids.empty())
    return corners;
  cv::aruco::interpolateCornersCharuco(markers, ids, grey, board, corners.pixels, corners.ids);
  if (corners.pixels.empty())
    return corners;
  cv::cornerSubPix(grey, corners.pixels, {4, 4}, {-1, -1},
                   {cv::TermCriteria::EPS | cv::TermCriteria::COUNT, 40, 1e-3});
  for (const int id : corners.ids)
    corners.places.push_back(board->chessboardCorners[static_cast<std::size_t>(id)]);
  return corners;
}

/// All on one row or column say nothing about the other direction.
bool spread(const Corners& corners) {
  float low_x = 1e9F, high_x = -1e9F, low_y = 1e9F, high_y = -1e9F;
  for (const cv::Point3f& p : corners.places) {
    low_x = std::min(low_x, p.x);
    high_x = std::max(high_x, p.x);
    low_y = std::min(low_y, p.y);
    high_y = std::max(high_y, p.y);
  }
  return high_x > low_x && high_y > low_y;
}

double coveredShare(const std::vector<Corners>& views, const cv::Size& size) {
  std::vector<bool> cells(kCells * kCells, false);
  for (const Corners& view : views) {
    for (const cv::Point2f& p : view.pixels) {
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

void drawResiduals(const Corners& view,
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
void solve(const std::vector<Corners>& views, const cv::Size& size, BoardCalibration& result) {
  std::vector<std::vector<cv::Point3f>> places;
  std::vector<std::vector<cv::Point2f>> pixels;
  for (const Corners& view : views) {
    places.push_back(view.places);
    pixels.push_back(view.pixels);
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
  for (std::size_t i = 0; i < views.size(); ++i) {
    BoardView& view = result.views[views[i].image];
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
    drawResiduals(views[i], predicted, result.picture);
  }
}

}  // namespace

BoardCalibration calibrateFromBoard(const std::vector<BoardImage>& images,
                                    const BoardShape& shape) {
  const Board board = boardOf(shape);
  BoardCalibration result;
  std::vector<Corners> views;
  for (std::size_t i = 0; i < images.size(); ++i) {
    if (images[i].grey.size() != images[0].grey.size())
      throw std::invalid_argument(fmt::format(
          "{}: has {} x {} pixels, but {} has {} x {}", images[i].name, images[i].grey.cols,
          images[i].grey.rows, images[0].name, images[0].grey.cols, images[0].grey.rows));
    Corners corners = findCorners(board, images[i].grey);
    corners.image = i;
    BoardView view;
    view.name = images[i].name;
    view.corners = static_cast<int>(corners.ids.size());
    result.views.push_back(view);
    if (view.corners >= kLeastCorners && spread(corners))
      views.push_back(corners);
  }
  if (static_cast<int>(views.size()) < kLeastViews)
    throw std::invalid_argument(
        fmt::format("only {} of {} images show at least {} corners of the board, {} are needed",
                    views.size(), images.size(), kLeastCorners, kLeastViews));
  const cv::Size size = images[0].grey.size();
  const double covered = coveredShare(views, size);
  if (covered < kLeastCovered)
    throw std::invalid_argument(
        fmt::format("the corners of all images lie in {:.0f} % of the image, at least {:.0f} % are "
                    "needed: hold the board into its "
                    "corners too",
                    100 * covered, 100 * kLeastCovered));
  solve(views, size, result);
  const double tilt = largestTilt(result.views);
  if (!(tilt > kLeastTilt))
    throw std::invalid_argument(
        fmt::format("the board is seen from nearly the same direction in all images ({:.1f} "
                    "degrees between the two that differ "
                    "most, {} are needed): tilt it",
                    tilt, kLeastTilt));
  return result;
}

cv::Mat drawBoard(const BoardShape& shape, int pixels) {
  cv::Mat image;
  boardOf(shape)->draw({shape.columns * pixels, shape.rows * pixels}, image, 0, 1);
  return image;
}

}  // namespace fastball::vision_tracker
