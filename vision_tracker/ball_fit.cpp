#include "vision_tracker/ball_fit.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "vision_tracker/background.h"
#include "vision_tracker/blurred_sphere.h"

namespace fastball::vision_tracker {
namespace {

constexpr int kCubic = 10;  // coefficients of a cubic in two variables
constexpr int kLamp = 3;    // direction and strength of a lamp that shines on a matt sphere
constexpr int kShading = kCubic + kLamp;
constexpr int kParameters = 4 + kShading;  // centre, radius, blur, shading
constexpr double kRim = 3.0;               // [px], how far outside of the outline pixels are used
constexpr double kLargestStep = 1.5;       // [px]
constexpr double kSmallestStep = 5e-3;     // [px], a fraction of the noise
constexpr double kBlurSigma = 0.3;         // how well the blur is known, of itself
constexpr int kSteps = 20;

// The cubic is for what is not as on a matt sphere: so small are its coefficients, of themselves.
constexpr double kUneven = 2.0;        // [grey levels]
constexpr double kUnevenShare = 0.05;  // of the contrast, beside that

using Parameters = Eigen::Matrix<double, kParameters, 1>;
using Normal = Eigen::Matrix<double, kParameters, kParameters>;
/// With one zero behind, for vector instructions.
constexpr int kPadded = kParameters + kParameters % 2;
using PaddedParameters = Eigen::Matrix<double, kPadded, 1>;
using PaddedNormal = Eigen::Matrix<double, kPadded, kPadded>;
using Monomials = Eigen::Matrix<double, kCubic, 1>;

/// A pixel near the ball, with what does not change from step to step.
struct Pixel {
  Eigen::Vector2d place;  ///< [px]
  double grey = 0;        ///< [grey levels]
  double background = 0;  ///< [grey levels]
  double inside = 0;      ///< [px], distance from the first outline, positive within
  Monomials monomials;    ///< of its place in the first disc
};

Monomials monomialsOf(const Eigen::Vector2d& w) {
  const double x = w.x(), y = w.y();
  Monomials m;
  m << 1, x, y, x * x, x * y, y * y, x * x * x, x * x * y, x * y * y, y * y * y;
  return m;
}

std::vector<Pixel> pixelsNear(const cv::Mat& image,
                              const cv::Mat& background,
                              const Outline& outline,
                              const Eigen::Matrix2d& unit_inverse) {
  const double radius = outline.meanRadius();
  const Eigen::Vector2d reach =
      outline.shape.diagonal().cwiseSqrt() + Eigen::Vector2d(kRim + 1, kRim + 1);
  const Eigen::Vector2d low = outline.centre - reach, high = outline.centre + reach;
  std::vector<Pixel> pixels;
  if (!(low.minCoeff() >= 0 && high.x() < image.cols && high.y() < image.rows))
    return pixels;
  pixels.reserve(static_cast<std::size_t>(4 * reach.prod()) + 16);
  for (int v = static_cast<int>(low.y()); v <= static_cast<int>(high.y()); ++v) {
    for (int u = static_cast<int>(low.x()); u <= static_cast<int>(high.x()); ++u) {
      const Eigen::Vector2d offset = Eigen::Vector2d(u, v) - outline.centre;
      const Edge edge = edgeAt(offset, radius, unit_inverse);
      if (edge.inside < -kRim - 0.5)
        continue;
      pixels.push_back({{u, v},
                        static_cast<double>(image.at<uint8_t>(v, u)),
                        static_cast<double>(background.at<int16_t>(v, u)) / Background::kScale,
                        edge.inside,
                        monomialsOf(edge.w)});
    }
  }
  return pixels;
}

/// Adds row row^T: the lower triangle, and what little lies above it in panels of six columns.
void addSquare(const PaddedParameters& row, PaddedNormal& sum) {
  constexpr int kPanel = 6;
  static_assert(kPadded == 3 * kPanel, "three panels");
  sum.leftCols<kPanel>().noalias() += row * row.head<kPanel>().transpose();
  sum.bottomRows<2 * kPanel>().middleCols<kPanel>(kPanel).noalias() +=
      row.tail<2 * kPanel>() * row.segment<kPanel>(kPanel).transpose();
  sum.bottomRightCorner<kPanel, kPanel>().noalias() +=
      row.tail<kPanel>() * row.tail<kPanel>().transpose();
}

/// The normal equations of one step.
struct Equations {
  Normal information = Normal::Zero();  ///< lower triangle
  Parameters gradient = Parameters::Zero();
  double square_sum = 0;  ///< of the residuals
  double cost = 0;        ///< that, and what was known before
  double contrast_sum = 0, inside_count = 0;
};

class Fit {
 public:
  Fit(const std::vector<Pixel>& pixels,
      const BallGuess& guess,
      const Eigen::Matrix2d& unit_inverse,
      double blur)
      : pixels_(pixels), guess_(guess), unit_inverse_(unit_inverse), blur_(blur) {
    x_.setZero();
    x_.head<2>() = guess.outline.centre;
    x_[2] = guess.outline.meanRadius();
    x_[3] = blur;
  }

  /// One step of Levenberg and Marquardt; false if it leads nowhere. `noise` weighs what was known before against the pixels.
  bool step(double noise) {
    Equations e = equations(noise);
    if (e.cost > cost_) {
      // Too far: back, and shorter next time.
      x_ = before_;
      e = best_;
      damping_ *= 10;
    } else {
      damping_ = std::max(damping_ / 10, 1e-6);
      before_ = x_;
      cost_ = e.cost;
      best_ = e;
    }
    Normal damped = e.information;
    damped.diagonal() *= 1 + damping_;
    Parameters change = damped.ldlt().solve(e.gradient);
    if (!change.allFinite())
      return false;
    const double length = change.head<3>().norm();
    if (length > kLargestStep)
      change *= kLargestStep / length;
    moved_ = change.head<3>().norm();
    x_ += change;
    x_[3] = std::min(std::max(x_[3], 0.3 * blur_), 3 * blur_);
    return x_[2] > 1 && damping_ < 1e6;
  }

  double moved() const { return moved_; }
  /// The equations before the last step, which was a small one.
  const Equations& best() const { return best_; }
  const Parameters& parameters() const { return x_; }

  Equations equations(double noise) const {
    static const BlurTable table;
    Equations e;
    PaddedNormal squares = PaddedNormal::Zero();
    for (const Pixel& pixel : pixels_) {
      const Edge edge = edgeAt(pixel.place - x_.head<2>(), x_[2], unit_inverse_);
      // Motion widens the blur across the parts of the outline that face it: a box has a variance of 1/12.
      const double smear = edge.outward.dot(guess_.motion);
      const double sigma = std::sqrt(x_[3] * x_[3] + smear * smear / 12);
      const double s = edge.inside / sigma;
      const BlurredEdge at_edge = table.at(s);
      const double share = at_edge.share, slope = at_edge.density / sigma;
      const Eigen::Vector3d lamp = x_.tail<kLamp>();
      const BlurredNormal blurred = blurredNormal(edge, s, sigma, at_edge);
      const bool lit = blurred.normal.dot(lamp) > 0;
      const double ground = pixel.monomials.dot(x_.segment<kCubic>(4)) - pixel.background;
      const double ball = share * ground + (lit ? blurred.normal.dot(lamp) : 0.0);
      const double residual = pixel.grey - pixel.background - ball;
      e.square_sum += residual * residual;
      if (s > 0) {
        e.contrast_sum += std::abs(ball) / share;
        e.inside_count += 1;
      }
      if (share == 0)
        continue;
      PaddedParameters row;
      row.head<2>() = slope * ground * edge.outward;
      row[2] = slope * ground * edge.per_radius;
      row[3] = -slope * s * ground * x_[3] / sigma;
      row.segment<kCubic>(4) = share * pixel.monomials;
      if (lit) {
        row.head<3>() += blurred.normal_x.transpose() * lamp;
        row[3] += blurred.normal_sigma.dot(lamp) * x_[3] / sigma;
        row.segment<kLamp>(4 + kCubic) = blurred.normal;
      } else {
        row.segment<kLamp>(4 + kCubic).setZero();
      }
      row[kPadded - 1] = 0;
      addSquare(row, squares);
      e.gradient += residual * row.head<kParameters>();
    }
    e.information = squares.topLeftCorner<kParameters, kParameters>();
    addKnown(noise, e);
    return e;
  }

  /// The shading alone, for the first step: a lamp for the brighter half of the disc as guessed, on an even ground.
  void startShading() {
    std::vector<double> greys;
    double differences = 0;
    for (const Pixel& pixel : pixels_) {
      if (pixel.inside > 1) {
        greys.push_back(pixel.grey);
        differences += std::abs(pixel.grey - pixel.background);
      }
    }
    if (greys.empty())
      return;
    contrast_ = differences / static_cast<double>(greys.size());
    const auto middle = greys.begin() + static_cast<std::ptrdiff_t>(greys.size() / 2);
    std::nth_element(greys.begin(), middle, greys.end());
    Eigen::Matrix4d information = 1e-2 * Eigen::Matrix4d::Identity();
    Eigen::Vector4d gradient = Eigen::Vector4d::Zero();
    for (const Pixel& pixel : pixels_) {
      if (pixel.inside <= 1 || pixel.grey < *middle)
        continue;
      const Eigen::Vector2d w = pixel.monomials.segment<2>(1);
      const Eigen::Vector4d row(1, w.x(), w.y(), std::sqrt(std::max(0.0, 1 - w.squaredNorm())));
      information += row * row.transpose();
      gradient += pixel.grey * row;
    }
    const Eigen::Vector4d ground_and_lamp = information.ldlt().solve(gradient);
    x_[4] = ground_and_lamp[0];
    x_.tail<kLamp>() = ground_and_lamp.tail<kLamp>();
  }

 private:
  /// What was known before of radius, blur and shading, and a breath of damping for what the pixels do not show.
  void addKnown(double noise, Equations& e) const {
    const double weight = noise * noise / (guess_.radius_sigma * guess_.radius_sigma);
    e.information(2, 2) += weight;
    e.gradient[2] += weight * (guess_.outline.meanRadius() - x_[2]);
    const double blur_weight = noise * noise / (kBlurSigma * kBlurSigma * blur_ * blur_);
    e.information(3, 3) += blur_weight;
    e.gradient[3] += blur_weight * (blur_ - x_[3]);
    const double shading_weight = std::pow(noise / (kUneven + kUnevenShare * contrast_), 2);
    const auto uneven = x_.segment<kCubic - 1>(5);
    e.information.diagonal().segment<kCubic - 1>(5).array() += shading_weight;
    e.gradient.segment<kCubic - 1>(5) -= shading_weight * uneven;
    e.information.diagonal().array() += 1e-6;
    e.cost = e.square_sum + weight * std::pow(guess_.outline.meanRadius() - x_[2], 2) +
             blur_weight * std::pow(blur_ - x_[3], 2) + shading_weight * uneven.squaredNorm();
  }

  const std::vector<Pixel>& pixels_;
  const BallGuess& guess_;
  Eigen::Matrix2d unit_inverse_;
  double blur_;
  Parameters x_, before_;
  Equations best_;
  double cost_ = std::numeric_limits<double>::infinity();
  double contrast_ = 0;  ///< [grey levels], at the guess
  double damping_ = 1e-3;
  double moved_ = 0;
};

}  // namespace

BallFit fitBall(const cv::Mat& image,
                const cv::Mat& background,
                const BallGuess& guess,
                double blur,
                double noise) {
  BallFit result;
  const double radius = guess.outline.meanRadius();
  if (!(radius > 2 && guess.outline.centre.allFinite()))
    return result;
  // shape = L L^T; the inverse of L, times the mean radius, makes a unit circle of the outline over its mean radius.
  const Eigen::Matrix2d lower = guess.outline.shape.llt().matrixL();
  const Eigen::Matrix2d unit_inverse = radius * lower.inverse();
  const std::vector<Pixel> pixels = pixelsNear(image, background, guess.outline, unit_inverse);
  if (pixels.size() < std::size_t{2} * kParameters)
    return result;
  Fit fit(pixels, guess, unit_inverse, blur);
  fit.startShading();
  for (int i = 0; i < kSteps && !result.converged; ++i) {
    if (!fit.step(noise))
      return result;
    result.converged = fit.moved() < kSmallestStep;
  }
  result.centre = fit.parameters().head<2>();
  result.radius = fit.parameters()[2];
  const Equations& e = fit.best();
  const auto count = static_cast<double>(pixels.size());
  result.residual = std::sqrt(e.square_sum / count);
  result.contrast = e.contrast_sum / std::max(1.0, e.inside_count);
  const double variance = std::max(noise * noise, e.square_sum / (count - kParameters));
  const Eigen::Matrix3d cov =
      variance * e.information.ldlt().solve(Normal::Identity()).topLeftCorner<3, 3>();
  result.cov = cov.topLeftCorner<2, 2>();
  result.radius_variance = cov(2, 2);
  result.converged = result.converged && result.cov.allFinite() && result.cov(0, 0) > 0;
  return result;
}

}  // namespace fastball::vision_tracker
