// Calibration from boards drawn through a known camera.
#include "vision_tracker/board_calibration.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

#include "tests/vision_tracker/drawn_board.h"

namespace fastball::vision_tracker {
namespace {

using ::testing::HasSubstr;

class BoardCalibrations : public ::testing::Test {
 protected:
  BoardCalibrations() {
    truth_.width = 640;
    truth_.height = 480;
    truth_.fx = 760;
    truth_.fy = 755;
    truth_.cx = 325;
    truth_.cy = 236;
    truth_.distortion << -0.12, 0.05, 0.0005, -0.0005, 0;
    rays_ = ::fastball::testing::DrawnBoard::raysOf(truth_);
  }

  /// The board turned by `tilt` [rad] about `axis`, its middle at `middle` [m] before the camera.
  cv::Mat picture(double tilt, const Eigen::Vector3d& axis, const Eigen::Vector3d& middle) const {
    const Eigen::Matrix3d R = Eigen::AngleAxisd(tilt, axis.normalized()).toRotationMatrix();
    return board_.picture(rays_, R, board_.origin(R, middle));
  }

  std::vector<BoardImage> goodImages() const {
    std::vector<BoardImage> images;
    for (int i = 0; i < 12; ++i) {
      const Eigen::Vector3d axis(std::cos(1.3 * i), std::sin(1.3 * i), 0.3);
      const Eigen::Vector3d middle(0.09 * (i % 3 - 1), 0.06 * (i / 3 % 3 - 1), 0.5 + 0.02 * i);
      images.push_back({"view" + std::to_string(i), picture(0.5, axis, middle)});
    }
    return images;
  }
  std::string refusal(const std::vector<BoardImage>& images) const {
    try {
      calibrateFromBoard(images, shape_);
    } catch (const std::invalid_argument& e) {
      return e.what();
    }
    return "accepted";
  }

  BoardShape shape_{8, 6, 0.04, 0.03, "5X5_100"};
  model::Camera truth_;
  ::fastball::testing::DrawnBoard board_{shape_};
  cv::Mat rays_;
};

TEST_F(BoardCalibrations, FindsTheCameraThatTookTheImages) {
  const BoardCalibration found = calibrateFromBoard(goodImages(), shape_);
  EXPECT_LT(found.rms, 0.1);
  EXPECT_NEAR(found.camera.fx, truth_.fx, 2.0);
  EXPECT_NEAR(found.camera.fy, truth_.fy, 2.0);
  EXPECT_NEAR(found.camera.cx, truth_.cx, 1.0);
  EXPECT_NEAR(found.camera.cy, truth_.cy, 1.0);
  // What counts is where points come to lie, not the coefficients one by one.
  for (const double x : {-0.3, 0.0, 0.3})
    for (const double y : {-0.2, 0.0, 0.2})
      EXPECT_LT((found.camera.distort({x, y}) - truth_.distort({x, y})).norm(), 1.5);
  EXPECT_LT(found.focal_sigma, 1.0);
  EXPECT_EQ(found.picture.size(), cv::Size(640, 480));
  EXPECT_TRUE(found.views[0].used);
}

TEST_F(BoardCalibrations, RefusesTooFewViews) {
  std::vector<BoardImage> images = goodImages();
  for (std::size_t i = 5; i < images.size(); ++i)
    images[i].grey = cv::Mat(480, 640, CV_8U, cv::Scalar(100));
  EXPECT_THAT(refusal(images), HasSubstr("only 5 of 12 images show"));
  EXPECT_THAT(refusal({}), HasSubstr("only 0 of 0 images"));
}

TEST_F(BoardCalibrations, RefusesABoardThatIsNeverTilted) {
  std::vector<BoardImage> images;
  for (int i = 0; i < 9; ++i)
    images.push_back({"flat", picture(0.02 * i, {0, 0, 1},
                                      {0.1 * (i % 3 - 1), 0.07 * (i / 3 - 1), 0.45 + 0.02 * i})});
  EXPECT_THAT(refusal(images), HasSubstr("nearly the same direction"));
}

TEST_F(BoardCalibrations, RefusesABoardThatStaysInOnePlace) {
  std::vector<BoardImage> images;
  for (int i = 0; i < 9; ++i)
    images.push_back(
        {"small", picture(0.4, {std::cos(1.0 * i), std::sin(1.0 * i), 0}, {0, 0, 1.0})});
  EXPECT_THAT(refusal(images), HasSubstr("% of the image"));
}

TEST_F(BoardCalibrations, RefusesImagesOfTwoSizesAndBoardsThatCannotBe) {
  std::vector<BoardImage> images = goodImages();
  images[3].grey = images[3].grey(cv::Rect(0, 0, 320, 240));
  EXPECT_THAT(refusal(images), HasSubstr("view3: has 320 x 240 pixels, but view0 has 640 x 480"));
  shape_.marker = 0.05;
  EXPECT_THAT(refusal(images), HasSubstr("a marker of 0.05 m does not fit"));
  shape_.dictionary = "9X9";
  EXPECT_THAT(refusal(images), HasSubstr("'9X9' is no dictionary"));
}

}  // namespace
}  // namespace fastball::vision_tracker
