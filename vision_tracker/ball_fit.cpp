#include "vision_tracker/ball_fit.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "vision_tracker/background.h"

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
using Monomials = Eigen::Matrix<double, kCubic, 1>;

/// A pixel near the ball, with what does not change from step to step.
struct Pixel {
  Eigen::Vector2d place;  ///< [px]
  double grey = 0;        ///< [grey levels]
  double background = 0;  ///< [grey levels]
  Monomials monomials;    ///< of its place in the first disc
};

Monomials monomialsOf(const Eigen::Vector2d& w) {
  const double x = w.x(), y = w.y();
  Monomials m;
  m << 1, x, y, x * x, x * y, y * y, x * x * x, x * x * y, x * y * y, y * y * y;
  return m;
}

/// Where a pixel is relative to the outline.
struct Edge {
  double inside = 0;        ///< [px], distance from the outline, positive within
  Eigen::Vector2d outward;  ///< unit normal of the outline
  double per_radius = 1;    ///< d inside / d radius
  double slope =
      0;  ///< [1/px], how fast the distance from the middle, 1 at the outline, grows outwards
  Eigen::Vector2d w;                ///< the place in a disc of radius 1
  Eigen::Matrix<double, 2, 3> w_x;  ///< d w / d (centre, radius)
};

/// `unit_inverse` maps the outline divided by its mean radius onto the unit circle.
Edge edgeAt(const Eigen::Vector2d& offset, double radius, const Eigen::Matrix2d& unit_inverse) {
  Edge edge;
  const Eigen::Vector2d w = unit_inverse * offset / radius;
  const double rho = w.norm();
  edge.w = w;
  edge.w_x << -unit_inverse / radius, -w / radius;
  if (rho < 0.05) {
    edge.inside = radius;
    edge.outward = Eigen::Vector2d::UnitX();
    edge.slope = 1 / radius;
    return edge;
  }
  const Eigen::Vector2d gradient = unit_inverse.transpose() * w / (rho * radius);
  edge.slope = gradient.norm();
  edge.inside = (1 - rho) / edge.slope;
  edge.outward = gradient / edge.slope;
  edge.per_radius = rho / (radius * edge.slope);
  return edge;
}

/// The blurred root g(s) = E sqrt(max(0, s + z)) of a standard normal z, and its derivative.
class BlurredRoot {
 public:
  BlurredRoot() {
    for (int i = 0; i <= kEntries; ++i) {
      // With s + z = y^2 the integrand is smooth.
      constexpr double kDy = 0.01;
      const double s = kLowest + i * kSpacing;
      for (double y = kDy; y < 4.5; y += kDy) {
        const double z = y * y - s;
        const double density = 0.3989422804014327 * std::exp(-0.5 * z * z) * 2 * y * kDy;
        value_[i] += density * y;
        slope_[i] += density * y * z;
      }
    }
  }
  double at(double s, double& slope) const {
    if (s >= kHighest) {
      const double root = std::sqrt(s);
      slope = 0.5 / root;
      return root * (1 - 1 / (8 * s * s));
    }
    if (s <= kLowest) {
      slope = 0;
      return 0;
    }
    // Cubic between two entries, by their values and slopes.
    const double place = (s - kLowest) / kSpacing;
    const int i = std::min(static_cast<int>(place), kEntries - 1);
    const double t = place - i, rest = 1 - t;
    slope = rest * slope_[i] + t * slope_[i + 1];
    return rest * rest * (1 + 2 * t) * value_[i] + t * t * (3 - 2 * t) * value_[i + 1] +
           kSpacing * t * rest * (rest * slope_[i] - t * slope_[i + 1]);
  }

 private:
  static constexpr int kEntries = 120;
  static constexpr double kLowest = -5, kHighest = 7, kSpacing = 0.1;
  double value_[kEntries + 1] = {}, slope_[kEntries + 1] = {};
};

/// The normal of a sphere (two axes of the disc, and towards the camera), zero outside of it, as it looks through a blur. At the
/// limb it turns away from the camera within a pixel: without the blur the dark side would be drawn in.
struct BlurredNormal {
  Eigen::Vector3d normal;
  Eigen::Matrix3d normal_x;      ///< d normal / d (centre, radius)
  Eigen::Vector3d normal_sigma;  ///< [1/px], d normal / d sigma
};

/// @param s distance inside of the outline over the blur's `sigma` [px]; share and density: normal distribution's at s
BlurredNormal blurredNormal(const Edge& edge,
                            double s,
                            double sigma,
                            double share,
                            double density) {
  static const BlurredRoot root;
  const Eigen::RowVector3d inside_x(edge.outward.x(), edge.outward.y(), edge.per_radius);
  const Eigen::Vector2d outwards = -edge.w_x.leftCols<2>() * edge.outward;  // d w / d distance
  const double rho = std::max(0.0, 1 - edge.inside * edge.slope);
  // sqrt(1 - rho^2) = sqrt(1 + rho) sqrt(slope sigma) sqrt(s)
  double root_s = 0;
  const double stretch = std::sqrt((1 + rho) * edge.slope * sigma);
  const double facing = stretch * root.at(s, root_s);
  BlurredNormal n;
  n.normal << share * edge.w - sigma * density * outwards, facing;
  n.normal_x.topRows<2>() =
      density / sigma * (edge.w + s * sigma * outwards) * inside_x + share * edge.w_x;
  n.normal_x.row(2) = (stretch * root_s / sigma - facing * edge.slope / (2 * (1 + rho))) * inside_x;
  n.normal_sigma << -density * s / sigma * edge.w - density * (1 + s * s) * outwards,
      facing / (2 * sigma) - stretch * root_s * s / sigma;
  return n;
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
      if (edgeAt(offset, radius, unit_inverse).inside < -kRim - 0.5)
        continue;
      pixels.push_back({{u, v},
                        static_cast<double>(image.at<uint8_t>(v, u)),
                        static_cast<double>(background.at<int16_t>(v, u)) / Background::kScale,
                        monomialsOf(unit_inverse * offset / radius)});
    }
  }
  return pixels;
}

/// The normal equations of one step.
struct Equations {
  Normal information = Normal::Zero();
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
  const Parameters& parameters() const { return x_; }

  Equations equations(double noise) const {
    Equations e;
    for (const Pixel& pixel : pixels_) {
      const Edge edge = edgeAt(pixel.place - x_.head<2>(), x_[2], unit_inverse_);
      // Motion widens the blur across the parts of the outline that face it: a box has a variance of 1/12.
      const double smear = edge.outward.dot(guess_.motion);
      const double sigma = std::sqrt(x_[3] * x_[3] + smear * smear / 12);
      const double s = edge.inside / sigma;
      const double share = s > 5 ? 1 : s < -5 ? 0 : 0.5 * std::erfc(-s * 0.70710678118654752);
      const double density = std::abs(s) > 5 ? 0 : 0.3989422804014327 * std::exp(-0.5 * s * s);
      const Eigen::Vector3d lamp = x_.tail<kLamp>();
      const BlurredNormal blurred = blurredNormal(edge, s, sigma, share, density);
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
      Parameters row;
      row.head<2>() = density / sigma * ground * edge.outward;
      row[2] = density / sigma * ground * edge.per_radius;
      row[3] = -density / sigma * s * ground * x_[3] / sigma;
      row.segment<kCubic>(4) = share * pixel.monomials;
      if (lit) {
        row.head<3>() += blurred.normal_x.transpose() * lamp;
        row[3] += blurred.normal_sigma.dot(lamp) * x_[3] / sigma;
        row.tail<kLamp>() = blurred.normal;
      } else {
        row.tail<kLamp>().setZero();
      }
      e.information.noalias() += row * row.transpose();
      e.gradient += residual * row;
    }
    // What was known before of radius, blur and shading, and a breath of damping for what the pixels do not show.
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
    return e;
  }

  /// The shading alone, for the first step: a lamp for the brighter half of the disc as guessed, on an even ground.
  void startShading() {
    std::vector<double> greys;
    double differences = 0;
    for (const Pixel& pixel : pixels_) {
      if (edgeAt(pixel.place - x_.head<2>(), x_[2], unit_inverse_).inside > 1) {
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
      const Edge edge = edgeAt(pixel.place - x_.head<2>(), x_[2], unit_inverse_);
      if (edge.inside <= 1 || pixel.grey < *middle)
        continue;
      const double facing = std::sqrt(std::max(0.0, 1 - edge.w.squaredNorm()));
      const Eigen::Vector4d row(1, edge.w.x(), edge.w.y(), facing);
      information += row * row.transpose();
      gradient += pixel.grey * row;
    }
    const Eigen::Vector4d ground_and_lamp = information.ldlt().solve(gradient);
    x_[4] = ground_and_lamp[0];
    x_.tail<kLamp>() = ground_and_lamp.tail<kLamp>();
  }

 private:
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
  const Equations e = fit.equations(noise);
  const auto count = static_cast<double>(pixels.size());
  result.residual = std::sqrt(e.square_sum / count);
  result.contrast = e.contrast_sum / std::max(1.0, e.inside_count);
  const double variance = std::max(noise * noise, e.square_sum / (count - kParameters));
  result.cov = variance * e.information.ldlt().solve(Normal::Identity()).topLeftCorner<2, 2>();
  result.converged = result.converged && result.cov.allFinite() && result.cov(0, 0) > 0;
  return result;
}

}  // namespace fastball::vision_tracker
