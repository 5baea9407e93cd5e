#pragma once

#include <memory>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

namespace fastball::vision_tracker {

/// A ChArUco board: a chessboard with an ArUco marker in every white square.
struct BoardShape {
  int columns = 0, rows = 0;  ///< squares
  double square = 0;          ///< [m], side of a square
  double marker = 0;          ///< [m], side of a marker, less than `square`
  std::string dictionary;     ///< 4X4_50, 4X4_250, 5X5_100, 5X5_250, 6X6_250 or 7X7_250
};

/// The chessboard's inner corners in one image.
struct BoardCorners {
  std::vector<int> ids;             ///< ascending; of the same length as the two below
  std::vector<cv::Point2f> pixels;  ///< [px]
  /// [m], on the board: x right, y down from the outer corner of its first square, z 0.
  std::vector<cv::Point3f> places;

  /// Enough to say how the board lies: at least eight, not all in one row or column.
  bool isEnough() const;
  static constexpr std::size_t kLeast = 8;  // six would do without noise
};

/// Finds the corners of a board in images.
class BoardFinder {
 public:
  /// @throw std::invalid_argument if the board cannot be: sizes, or too few markers in the
  ///   dictionary
  explicit BoardFinder(const BoardShape& shape);
  ~BoardFinder();
  /// @param grey CV_8U @return no corners if no board is seen
  BoardCorners find(const cv::Mat& grey) const;

 private:
  struct Board;
  std::unique_ptr<Board> board_;
};

/// What two images of the board have in common: `a`'s corners that are in `b` too, and the other way round, in one order.
void keepCommon(BoardCorners& a, BoardCorners& b);

/// The board as an image, CV_8U, `pixels` for each square, to print or to test with.
/// @throw std::invalid_argument if the board cannot be
cv::Mat drawBoard(const BoardShape& shape, int pixels);

}  // namespace fastball::vision_tracker
