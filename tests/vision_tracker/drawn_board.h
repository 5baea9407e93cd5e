#pragma once

#include <Eigen/Geometry>
#include <opencv2/imgproc.hpp>

#include "sim_bullet/camera_background.h"
#include "vision_tracker/board_corners.h"

namespace fastball::testing {

/// A ChArUco board drawn through a camera whose lens is known.
class DrawnBoard {
 public:
  explicit DrawnBoard(const vision_tracker::BoardShape& shape)
      : shape_(shape), board_(vision_tracker::drawBoard(shape, kSquarePixels)) {}

  /// What picture() needs of a camera: directions of four points in each pixel, or corners would move by what lies between pixels.
  static cv::Mat raysOf(model::Camera camera) {
    camera.width *= 2;
    camera.height *= 2;
    camera.fx *= 2;
    camera.fy *= 2;
    camera.cx = 2 * camera.cx + 0.5;
    camera.cy = 2 * camera.cy + 0.5;
    return sim_bullet::rayMap(camera);
  }

  /// CV_8U. @param R_CB, p_CB [m] pose of the board in the camera's frame
  cv::Mat picture(const cv::Mat& rays,
                  const Eigen::Matrix3d& R_CB,
                  const Eigen::Vector3d& p_CB) const {
    const Eigen::Vector3d n = R_CB.col(2);
    const Eigen::Matrix3d R_BC = R_CB.transpose() / shape_.square;
    cv::Mat2f map(rays.size());
    for (int v = 0; v < map.rows; ++v) {
      for (int u = 0; u < map.cols; ++u) {
        const auto& r = rays.at<cv::Vec2f>(v, u);
        const Eigen::Vector3d d(r[0], r[1], 1);
        const Eigen::Vector3d on_board = R_BC * (n.dot(p_CB) / n.dot(d) * d - p_CB);
        map(v, u) = {static_cast<float>(on_board.x() * kSquarePixels - 0.5),
                     static_cast<float>(on_board.y() * kSquarePixels - 0.5)};
      }
    }
    cv::Mat fine, image;
    cv::remap(board_, fine, map, cv::noArray(), cv::INTER_LINEAR, cv::BORDER_CONSTANT, 200);
    cv::resize(fine, image, rays.size() / 2, 0, 0, cv::INTER_AREA);
    cv::GaussianBlur(image, image, {}, 0.6);
    cv::Mat noise(image.size(), CV_16S), sum;
    cv::theRNG().state = 7;
    cv::randn(noise, 0, 2);
    cv::add(image, noise, sum, cv::noArray(), CV_8U);
    return sum;
  }

  /// The origin of a board whose middle is at `middle`.
  Eigen::Vector3d origin(const Eigen::Matrix3d& R, const Eigen::Vector3d& middle) const {
    return middle - R * Eigen::Vector3d(shape_.columns * shape_.square / 2,
                                        shape_.rows * shape_.square / 2, 0);
  }

 private:
  static constexpr int kSquarePixels = 60;
  vision_tracker::BoardShape shape_;
  cv::Mat board_;
};

}  // namespace fastball::testing
