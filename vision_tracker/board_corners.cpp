#include "vision_tracker/board_corners.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <opencv2/aruco/charuco.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

namespace fastball::vision_tracker {
namespace {

cv::Ptr<cv::aruco::CharucoBoard> boardOf(const BoardShape& shape) {
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

cv::Rect_<float> boxOf(const std::vector<cv::Point3f>& places) {
  const auto x = std::minmax_element(places.begin(), places.end(),
                                     [](const auto& a, const auto& b) { return a.x < b.x; });
  const auto y = std::minmax_element(places.begin(), places.end(),
                                     [](const auto& a, const auto& b) { return a.y < b.y; });
  return {x.first->x, y.first->y, x.second->x - x.first->x, y.second->y - y.first->y};
}

constexpr int kLeastWindow = 2, kMostWindow = 5;  // [px], half a side

/// `a` without what is not in `b`.
BoardCorners common(const BoardCorners& a, const BoardCorners& b) {
  BoardCorners kept;
  for (std::size_t i = 0; i < a.ids.size(); ++i) {
    if (std::find(b.ids.begin(), b.ids.end(), a.ids[i]) == b.ids.end())
      continue;
    kept.ids.push_back(a.ids[i]);
    kept.pixels.push_back(a.pixels[i]);
    kept.places.push_back(a.places[i]);
  }
  return kept;
}

/// Finds the saddle points again, each in a window as large as there is no marker in.
void refine(const cv::Mat& grey, const cv::aruco::CharucoBoard& board, BoardCorners& corners) {
  const float gap = (board.getSquareLength() - board.getMarkerLength()) / 2;
  const std::vector<cv::Point2f> rough = corners.pixels;
  for (std::size_t i = 0; i < rough.size(); ++i) {
    double scale = 1e9;  // [px/m], in the direction in which the board is shortened most
    for (std::size_t j = 0; j < rough.size(); ++j)
      if (j != i)
        scale = std::min(
            scale, cv::norm(rough[i] - rough[j]) / cv::norm(corners.places[i] - corners.places[j]));
    const int half = std::clamp(static_cast<int>(gap * scale), kLeastWindow, kMostWindow);
    std::vector<cv::Point2f> corner = {rough[i]};
    cv::cornerSubPix(grey, corner, {half, half}, {-1, -1},
                     {cv::TermCriteria::EPS | cv::TermCriteria::COUNT, 40, 1e-3});
    corners.pixels[i] = corner.front();
  }
}

}  // namespace

bool BoardCorners::isEnough() const {
  if (places.size() < kLeast)
    return false;
  // All on one row or column say nothing about the other direction.
  const cv::Rect_<float> box = boxOf(places);
  return box.width > 0 && box.height > 0;
}

struct BoardFinder::Board {
  cv::Ptr<cv::aruco::CharucoBoard> board;
};

BoardFinder::BoardFinder(const BoardShape& shape)
    : board_(std::make_unique<Board>(Board{boardOf(shape)})) {}

BoardFinder::~BoardFinder() = default;

BoardCorners BoardFinder::find(const cv::Mat& grey) const {
  const cv::Ptr<cv::aruco::CharucoBoard>& board = board_->board;
  BoardCorners corners;
  std::vector<std::vector<cv::Point2f>> markers;
  std::vector<int> ids;
  cv::aruco::detectMarkers(grey, board->dictionary, markers, ids);
  if (ids.empty())
    return corners;
  cv::aruco::interpolateCornersCharuco(markers, ids, grey, board, corners.pixels, corners.ids);
  if (corners.pixels.empty())
    return corners;
  for (const int id : corners.ids)
    corners.places.push_back(board->chessboardCorners[static_cast<std::size_t>(id)]);
  refine(grey, *board, corners);
  return corners;
}

void keepCommon(BoardCorners& a, BoardCorners& b) {
  // Both are in the order of their ids.
  a = common(a, b);
  b = common(b, a);
}

cv::Mat drawBoard(const BoardShape& shape, int pixels) {
  cv::Mat image;
  boardOf(shape)->draw({shape.columns * pixels, shape.rows * pixels}, image, 0, 1);
  return image;
}

}  // namespace fastball::vision_tracker
