#include "vision_tracker/ring_template.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace fastball::vision_tracker {
namespace {

constexpr double kPi = 3.14159265358979323846;

/// For the pixels about one of `count` segments of the ring's image, whether it is the nearest.
void markNearest(const Eigen::Vector2d& a,
                 const Eigen::Vector2d& along,
                 double band,
                 std::size_t segment,
                 std::size_t count,
                 RingTemplate& made) {
  const double length = std::max(along.squaredNorm(), 1e-12);
  const Eigen::Vector2d low = a.cwiseMin(a + along), high = a.cwiseMax(a + along);
  const int v_end = std::min(made.share.rows - 1, static_cast<int>(high.y() + band));
  const int u_end = std::min(made.share.cols - 1, static_cast<int>(high.x() + band));
  for (int v = std::max(0, static_cast<int>(low.y() - band)); v <= v_end; ++v) {
    for (int u = std::max(0, static_cast<int>(low.x() - band)); u <= u_end; ++u) {
      const Eigen::Vector2d from = Eigen::Vector2d(u, v) - a;
      const double share = std::clamp(from.dot(along) / length, 0.0, 1.0);
      const double distance = (from - share * along).norm();
      if (distance >= static_cast<double>(made.distance(v, u)))
        continue;
      made.distance(v, u) = static_cast<float>(distance);
      made.angle(v, u) = static_cast<float>(2 * kPi * (static_cast<double>(segment) + share) /
                                            static_cast<double>(count));
    }
  }
}

/// The tube and its slopes in the part of the area that it can reach, drawn and blurred in finer
/// pixels.
/// @param origin [px] of the area
void drawTube(const std::vector<Eigen::Vector2d>& images,
              const Eigen::Vector2d& origin,
              const cv::Rect& part,
              double width,
              double blur,
              RingTemplate& made) {
  constexpr int kFiner = 4;
  constexpr int kShift = 4;  // OpenCV's fixed point
  std::vector<cv::Point> outline;
  for (const Eigen::Vector2d& p : images) {
    // A fine pixel's centre lies at a whole number too.
    const Eigen::Vector2d fine = (p - origin - Eigen::Vector2d(part.x, part.y)) * kFiner +
                                 Eigen::Vector2d::Constant((kFiner - 1) / 2.0);
    outline.emplace_back(static_cast<int>(std::lround(fine.x() * (1 << kShift))),
                         static_cast<int>(std::lround(fine.y() * (1 << kShift))));
  }
  cv::Mat drawn = cv::Mat::zeros(part.size() * kFiner, CV_8U);
  cv::polylines(drawn, outline, true, cv::Scalar(255),
                std::max(1, static_cast<int>(std::lround(width * kFiner))), cv::LINE_AA, kShift);
  cv::Mat fine, slope, result;
  drawn.convertTo(fine, CV_32F, 1.0 / 255);
  cv::GaussianBlur(fine, fine, {}, blur * kFiner, blur * kFiner);
  cv::resize(fine, result, part.size(), 0, 0, cv::INTER_AREA);
  result.copyTo(made.share(part));
  cv::Sobel(fine, slope, CV_32F, 1, 0, 1, 0.5 * kFiner);
  cv::resize(slope, result, part.size(), 0, 0, cv::INTER_AREA);
  result.copyTo(made.right(part));
  cv::Sobel(fine, slope, CV_32F, 0, 1, 1, 0.5 * kFiner);
  cv::resize(slope, result, part.size(), 0, 0, cv::INTER_AREA);
  result.copyTo(made.down(part));
}

}  // namespace

RingTemplate ringTemplate(const std::vector<Eigen::Vector2d>& images,
                          const cv::Rect& area,
                          double width,
                          double blur,
                          double reach) {
  const double band = width / 2 + 4 * blur + reach + 2;
  RingTemplate made{cv::Mat1f(area.size(), 0.0F), cv::Mat1f(area.size(), 0.0F),
                    cv::Mat1f(area.size(), 0.0F), cv::Mat1f(area.size(), 0.0F),
                    cv::Mat1f(area.size(), 1e6F)};
  const Eigen::Vector2d origin(area.x, area.y);
  Eigen::Vector2d low = images.front() - origin, high = low;
  for (std::size_t i = 0; i < images.size(); ++i) {
    const Eigen::Vector2d a = images[i] - origin;
    low = low.cwiseMin(a);
    high = high.cwiseMax(a);
    markNearest(a, images[(i + 1) % images.size()] - images[i], band, i, images.size(), made);
  }
  const cv::Rect part =
      cv::Rect(
          cv::Point(static_cast<int>(low.x() - band) - 1, static_cast<int>(low.y() - band) - 1),
          cv::Point(static_cast<int>(high.x() + band) + 2, static_cast<int>(high.y() + band) + 2)) &
      cv::Rect({0, 0}, area.size());
  if (!part.empty())
    drawTube(images, origin, part, width, blur, made);
  return made;
}

}  // namespace fastball::vision_tracker
