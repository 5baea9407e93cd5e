#include "vision_tracker/ball_detector.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace fastball::vision_tracker {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr int kStride = 2;  // the search looks at every other pixel of every other row
constexpr std::size_t kMostBlobs = 4;

/// A connected piece of foreground.
struct Blob {
  Eigen::Vector2d centre;  ///< [px]
  double area = 0;         ///< [px^2]
  double roundness = 0;    ///< 0 for a disc: how far area and box are from a disc's
};

/// Foreground of a part of the image, one pixel for kStride x kStride; CV_8U.
cv::Mat foreground(const cv::Mat& image, const cv::Mat& mean, double threshold, int stride) {
  const int limit = static_cast<int>(std::lround(threshold * Background::kScale));
  cv::Mat mask(image.rows / stride, image.cols / stride, CV_8U);
  const int cols = mask.cols;
  for (int v = 0; v < mask.rows; ++v) {
    const auto* grey = image.ptr<uint8_t>(v * stride);
    const auto* still = mean.ptr<int16_t>(v * stride);
    auto* out = mask.ptr<uint8_t>(v);
    for (int u = 0; u < cols; ++u, grey += stride, still += stride) {
      const int difference = *grey * Background::kScale - *still;
      out[u] = difference > limit || difference < -limit ? 255 : 0;
    }
  }
  return mask;
}

std::vector<Blob> blobsOf(const cv::Mat& mask, int stride, double least_area, double most_area) {
  std::vector<Blob> blobs;
  // Most of the image stands still: label what lies around the foreground only.
  const cv::Rect around = cv::boundingRect(mask);
  if (around.empty())
    return blobs;
  cv::Mat labels, stats, centres;
  const int count =
      cv::connectedComponentsWithStats(mask(around), labels, stats, centres, 4, CV_16U);
  for (int i = 1; i < count; ++i) {
    const double pixels = stats.at<int>(i, cv::CC_STAT_AREA);
    const double width = stats.at<int>(i, cv::CC_STAT_WIDTH),
                 height = stats.at<int>(i, cv::CC_STAT_HEIGHT);
    Blob blob;
    blob.area = pixels * stride * stride;
    const double fill = pixels / (width * height);
    blob.roundness = std::abs(std::log(fill / (kPi / 4))) + std::abs(std::log(width / height));
    if (blob.area < least_area || blob.area > most_area || blob.roundness > 0.7)
      continue;
    blob.centre =
        Eigen::Vector2d(around.x + centres.at<double>(i, 0), around.y + centres.at<double>(i, 1)) *
        stride;
    blobs.push_back(blob);
  }
  std::stable_sort(blobs.begin(), blobs.end(),
                   [](const Blob& a, const Blob& b) { return a.roundness < b.roundness; });
  if (blobs.size() > kMostBlobs)
    blobs.resize(kMostBlobs);
  return blobs;
}

/// A thing whose grey values say nothing: a shadow or a pattern may hide a third of it.
BallFit uneven(const Blob& blob) {
  constexpr double kHidden = 0.2;  // of the radius, standard deviation
  BallFit fit;
  fit.centre = blob.centre;
  fit.radius = std::sqrt(blob.area / kPi);
  const double sigma = kHidden * fit.radius + 0.3 * kStride;
  fit.cov = sigma * sigma * Eigen::Matrix2d::Identity();
  fit.radius_variance = sigma * sigma;
  fit.converged = true;
  return fit;
}

double threshold(double noise) {
  return std::max(9.0, 5 * noise);
}

}  // namespace

BallDetector::BallDetector(const model::Camera& camera,
                           double exposure,
                           const DetectorOptions& options)
    : camera_(camera), exposure_(exposure), options_(options) {}

cv::Rect BallDetector::area(const Eigen::Vector3d& p_WBall) const {
  constexpr int kBorder = 6;  // [px]
  if (camera_.toCamera(p_WBall).z() < 2 * options_.ball_radius)
    return {};
  const Outline outline = sphereOutline(camera_, p_WBall, options_.ball_radius);
  if (!outline.centre.allFinite() || outline.centre.cwiseAbs().maxCoeff() > 1e5)
    return {};
  const Eigen::Vector2d reach = outline.shape.diagonal().cwiseSqrt();
  const cv::Point low(static_cast<int>(outline.centre.x() - reach.x()) - kBorder,
                      static_cast<int>(outline.centre.y() - reach.y()) - kBorder);
  const cv::Point high(static_cast<int>(outline.centre.x() + reach.x()) + kBorder + 1,
                       static_cast<int>(outline.centre.y() + reach.y()) + kBorder + 1);
  return cv::Rect(low, high) & cv::Rect(0, 0, camera_.width, camera_.height);
}

bool BallDetector::hasBrightness(const BallFit& fit, const cv::Mat& image) const {
  if (options_.darkest <= 0 && options_.brightest >= 255)
    return true;
  const double half = fit.radius / 2;
  const cv::Rect middle = cv::Rect(cv::Point(static_cast<int>(fit.centre.x() - half),
                                             static_cast<int>(fit.centre.y() - half)),
                                   cv::Point(static_cast<int>(fit.centre.x() + half) + 1,
                                             static_cast<int>(fit.centre.y() + half) + 1)) &
                          cv::Rect(0, 0, image.cols, image.rows);
  if (middle.empty())
    return false;
  const double mean = cv::mean(image(middle))[0];
  return mean >= options_.darkest && mean <= options_.brightest;
}

BallFit BallDetector::accepted(BallFit fit,
                               const cv::Mat& image,
                               double expected_radius,
                               double tolerance,
                               double noise) const {
  // Shading that no cubic can follow leaves a residual that grows with the contrast; clutter leaves a larger one.
  const bool round = fit.residual < 2.5 * noise + 0.08 * fit.contrast;
  const bool bright = fit.contrast > threshold(noise);
  const bool sized = std::abs(fit.radius - expected_radius) < tolerance;
  fit.converged = fit.converged && round && bright && sized && hasBrightness(fit, image);
  fit.cov += options_.noise_floor * options_.noise_floor * Eigen::Matrix2d::Identity();
  fit.radius_variance += options_.noise_floor * options_.noise_floor;
  return fit;
}

std::vector<BallFit> BallDetector::search(const cv::Mat& image,
                                          const Background& background) const {
  const double noise = background.noise(image);
  const double least = camera_.fx * options_.ball_radius / options_.farthest;
  const double most = camera_.fx * options_.ball_radius / options_.nearest;
  const std::vector<Blob> blobs =
      blobsOf(foreground(image, background.mean(), threshold(noise), kStride), kStride,
              0.5 * kPi * least * least, 1.6 * kPi * most * most);
  std::vector<BallFit> found;
  for (const Blob& blob : blobs) {
    const double radius = std::min(most, std::max(least, std::sqrt(blob.area / kPi)));
    // The shape of the outline of a ball that lies in that direction at the depth that its size says.
    const Eigen::Vector2d direction = camera_.undistort(blob.centre);
    const double depth = camera_.fx * options_.ball_radius / radius;
    const Eigen::Vector3d p_W =
        camera_.R_CW.transpose() *
        (depth * Eigen::Vector3d(direction.x(), direction.y(), 1) - camera_.p_CW);
    BallGuess guess;
    guess.outline = sphereOutline(camera_, p_W, options_.ball_radius);
    guess.radius_sigma = 0.3 * radius;
    const BallFit fit = accepted(fitBall(image, background.mean(), guess, options_.blur, noise),
                                 image, (least + most) / 2, (most - least) / 2 + 1, noise);
    if (fit.converged && (fit.centre - blob.centre).norm() < 0.5 * radius + kStride)
      found.push_back(fit);
    else if (options_.keep_uneven)
      found.push_back(uneven(blob));
  }
  return found;
}

BallFit BallDetector::at(const cv::Mat& image,
                         const Background& background,
                         const Eigen::Vector3d& p_WBall,
                         const Eigen::Vector3d& v_WBall,
                         double uncertainty) const {
  const cv::Rect inside = area(p_WBall);
  if (inside.empty())
    return {};
  const double noise = background.noise(image);
  BallGuess guess;
  guess.outline = sphereOutline(camera_, p_WBall, options_.ball_radius);
  const double radius = guess.outline.meanRadius();
  guess.radius_sigma = 0.03 * radius;
  Eigen::Matrix<double, 2, 3> projection;
  camera_.project(p_WBall, &projection);
  guess.motion = projection * v_WBall * exposure_;
  const auto fitted = [&] {
    return accepted(fitBall(image, background.mean(), guess, options_.blur, noise), image, radius,
                    0.12 * radius, noise);
  };
  BallFit fit = fitted();
  if (fit.converged && (fit.centre - guess.outline.centre).norm() < uncertainty)
    return fit;
  // Not where it was expected: begin once more at the foreground around.
  const int more = static_cast<int>(std::ceil(uncertainty));
  const cv::Rect around = cv::Rect(inside.x - more, inside.y - more, inside.width + 2 * more,
                                   inside.height + 2 * more) &
                          cv::Rect(0, 0, image.cols, image.rows);
  const std::vector<Blob> blobs =
      blobsOf(foreground(image(around), background.mean()(around), threshold(noise), 1), 1,
              0.5 * kPi * radius * radius, 1.8 * kPi * radius * radius);
  if (blobs.empty())
    return {};
  const Eigen::Vector2d expected = guess.outline.centre;
  guess.outline.centre = blobs.front().centre + Eigen::Vector2d(around.x, around.y);
  fit = fitted();
  fit.converged = fit.converged && (fit.centre - expected).norm() < uncertainty;
  return fit;
}

}  // namespace fastball::vision_tracker
