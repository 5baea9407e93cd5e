#include "vision_tracker/ring_finder.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <map>
#include <opencv2/imgproc.hpp>

#include "vision_tracker/background.h"
#include "vision_tracker/ring_template.h"

namespace fastball::vision_tracker {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr int kSegments = 96;  // of the ring's image, for its template
constexpr int kProbes = 48;    // along the ring, for the search
constexpr int kSectors = 8;    // within one the ring is brighter than what is beside it, or darker
constexpr double kSpacing = 2.0;        // [px], between pieces
constexpr double kHalfPiece = 1.25;     // [px], along the ring
constexpr double kFarthestShift = 2.0;  // [px], of a piece
constexpr double kLeastContrast = 3.0;  // [grey levels]
constexpr double kGreyDoubt =
    0.3;  // [grey levels], of the averaged image at least: rounding and JPEG

std::vector<Eigen::Vector2d> imagesOf(const model::Camera& camera, const Ring& ring, int count) {
  std::vector<Eigen::Vector2d> images;
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector3d p_W = ring.point(2 * kPi * i / count);
    if (camera.toCamera(p_W).z() < 0.1)
      return {};
    images.push_back(camera.project(p_W));
  }
  return images;
}

/// Unit vector across the ring's image at its i-th point.
Eigen::Vector2d acrossAt(const std::vector<Eigen::Vector2d>& images, std::size_t i) {
  const std::size_t n = images.size();
  const Eigen::Vector2d along = images[(i + 1) % n] - images[(i + n - 1) % n];
  const double length = along.norm();
  return length > 1e-9 ? Eigen::Vector2d(along.y() / length, -along.x() / length)
                       : Eigen::Vector2d(1, 0);
}

/// Points of the ring's image about kSpacing apart and unit vectors across it; among them those two at the ends of its
/// long axis: where the ring is seen from its edge, only these say where it is along the line that it looks like.
std::vector<std::pair<std::size_t, Eigen::Vector2d>> placesAlong(
    const std::vector<Eigen::Vector2d>& images) {
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  for (const Eigen::Vector2d& p : images)
    mean += p / static_cast<double>(images.size());
  const auto farthest =
      std::max_element(images.begin(), images.end(), [&](const auto& a, const auto& b) {
        return (a - mean).squaredNorm() < (b - mean).squaredNorm();
      });
  const auto first = static_cast<std::size_t>(farthest - images.begin());
  std::vector<std::pair<std::size_t, Eigen::Vector2d>> places;
  const std::size_t half = images.size() / 2;
  for (const std::size_t start : {first, first + half}) {
    double since = kSpacing;
    for (std::size_t k = 0; k < half; ++k) {
      const std::size_t i = (start + k) % images.size();
      if (since >= kSpacing) {
        places.emplace_back(i, k == 0 ? (images[i] - mean).normalized() : acrossAt(images, i));
        since = 0;
      }
      since += (images[(i + 1) % images.size()] - images[i]).norm();
    }
  }
  return places;
}

}  // namespace

/// Where to look.
struct RingFinder::Piece {
  Eigen::Vector2d middle, across;
  std::vector<cv::Point> pixels;  ///< of the area
  cv::Mat1i* counts = nullptr;    ///< how many pieces look at a pixel
};

RingFinder::RingFinder(const model::Camera& camera,
                       const cv::Mat& still,
                       const Ring& nominal,
                       double tube,
                       double blur,
                       double reach)
    : camera_(camera), blur_(blur) {
  const std::vector<Eigen::Vector2d> images = imagesOf(camera, nominal, kSegments);
  if (images.empty())
    return;
  width_ = camera.fx * tube / camera.toCamera(nominal.p_W).z();
  Eigen::Vector2d low = images.front(), high = images.front();
  for (const Eigen::Vector2d& p : images) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  if (!(low.minCoeff() > -1e5 && high.maxCoeff() < 1e5))
    return;
  const double border = width_ / 2 + 4;
  const cv::Rect whole(0, 0, still.cols, still.rows);
  const auto around = [&](double margin) {
    return cv::Rect(
        cv::Point(static_cast<int>(low.x() - margin), static_cast<int>(low.y() - margin)),
        cv::Point(static_cast<int>(high.x() + margin) + 2,
                  static_cast<int>(high.y() + margin) + 2));
  };
  if ((around(border) & whole) != around(border))
    return;
  area_ = around(border + reach) & whole;
  still(area_).convertTo(grey_, CV_32F, 1.0 / Background::kScale);
  cv::Mat smooth;
  const double scale = std::max(1.0, width_ / 2);
  cv::GaussianBlur(grey_, smooth, {}, scale, scale, cv::BORDER_REPLICATE);
  cv::Sobel(smooth, across_, CV_32F, 2, 0, 3, 0.25);
  cv::Sobel(smooth, mixed_, CV_32F, 1, 1, 3, 0.25);
  cv::Sobel(smooth, down_, CV_32F, 0, 2, 3, 0.25);
}

cv::Mat1f RingFinder::search(const Ring& ring, int reach) const {
  struct Probe {
    int u, v, sector;
    float uu, uv, vv;
  };
  const std::vector<Eigen::Vector2d> images = imagesOf(camera_, ring, kProbes);
  std::vector<Probe> probes;
  for (std::size_t i = 0; i < images.size(); ++i) {
    const Eigen::Vector2d n = acrossAt(images, i);
    probes.push_back({static_cast<int>(std::lround(images[i].x())) - area_.x,
                      static_cast<int>(std::lround(images[i].y())) - area_.y,
                      static_cast<int>(i) * kSectors / kProbes, static_cast<float>(n.x() * n.x()),
                      static_cast<float>(2 * n.x() * n.y()), static_cast<float>(n.y() * n.y())});
  }
  cv::Mat1f scores(2 * reach + 1, 2 * reach + 1);
  for (int dv = -reach; dv <= reach; ++dv) {
    for (int du = -reach; du <= reach; ++du) {
      float sums[kSectors] = {};
      for (const Probe& p : probes) {
        const int u = std::clamp(p.u + du, 0, area_.width - 1);
        const int v = std::clamp(p.v + dv, 0, area_.height - 1);
        sums[p.sector] += p.uu * across_.ptr<float>(v)[u] + p.uv * mixed_.ptr<float>(v)[u] +
                          p.vv * down_.ptr<float>(v)[u];
      }
      float score = 0;
      for (const float sum : sums)
        score += std::abs(sum);
      scores(dv + reach, du + reach) = score / kProbes;
    }
  }
  return scores;
}

// The grey values of a piece are those of the wall (a level and a slope across), of the tube, and of the tube moved a little
// across: linear in all four.
std::optional<RingPoint> RingFinder::look(const Piece& piece, const RingTemplate& made) const {
  const std::size_t count = piece.pixels.size();
  if (count < 12)
    return std::nullopt;
  Eigen::Matrix4d normal = Eigen::Matrix4d::Zero();
  Eigen::Vector4d right = Eigen::Vector4d::Zero();
  double squares = 0, multiplicity = 0, weight = 0, most = 0;
  std::map<int, std::pair<double, double>> angles;  // of each segment: weight, weighted angle
  for (const cv::Point& pixel : piece.pixels) {
    const double moved = -(static_cast<double>(made.right(pixel)) * piece.across.x() +
                           static_cast<double>(made.down(pixel)) * piece.across.y());
    const double s = piece.across.dot(Eigen::Vector2d(pixel.x, pixel.y) - piece.middle);
    const Eigen::Vector4d row(1, s, static_cast<double>(made.share(pixel)), moved);
    const auto grey = static_cast<double>(grey_.at<float>(pixel));
    normal += row * row.transpose();
    right += grey * row;
    squares += grey * grey;
    const double w = moved * moved;
    most = std::max(most, row[2]);
    weight += w;
    multiplicity += w * (*piece.counts)(pixel);
    const auto angle = static_cast<double>(made.angle(pixel));
    auto& [sum, moment] = angles[static_cast<int>(angle * kSegments / (2 * kPi))];
    sum += w;
    moment += w * angle;
  }
  const Eigen::Matrix4d inverse = normal.inverse();
  const Eigen::Vector4d fit = inverse * right;
  if (!fit.allFinite() || !(weight > 1e-9))
    return std::nullopt;
  const double rest = std::max(0.0, squares - fit.dot(right)) / (static_cast<double>(count) - 4) +
                      kGreyDoubt * kGreyDoubt;
  const double contrast = std::abs(fit[2]);
  RingPoint point;
  const double shift = fit[3] / fit[2];
  if (contrast * most < kLeastContrast || contrast < 5 * std::sqrt(rest * inverse(2, 2)) ||
      !(std::abs(shift) < kFarthestShift))
    return std::nullopt;
  point.across = piece.across;
  point.place = shift;
  point.variance = rest * inverse(3, 3) / (contrast * contrast) * multiplicity / weight;
  for (const auto& [segment, sums] : angles)
    if (sums.first > 1e-4 * weight)
      point.angles.emplace_back(sums.second / sums.first, sums.first / weight);
  return point;
}

std::vector<RingPoint> RingFinder::points(const Ring& ring,
                                          const Eigen::Vector2d& shift,
                                          int camera_index,
                                          int* looked) const {
  *looked = 0;
  std::vector<Eigen::Vector2d> images = imagesOf(camera_, ring, kSegments);
  if (images.empty())
    return {};
  for (Eigen::Vector2d& p : images)
    p += shift;
  const RingTemplate made = ringTemplate(images, area_, width_, blur_, kFarthestShift);
  const Eigen::Vector2d origin(area_.x, area_.y);
  const double reach = width_ / 2 + 2 * blur_ + kFarthestShift;
  cv::Mat1i counts(area_.size(), 0);
  std::vector<Piece> pieces;
  for (const auto& [i, across_piece] : placesAlong(images)) {
    Piece piece{images[i] - origin, across_piece, {}, &counts};
    const double around = reach + kHalfPiece;
    for (int v = static_cast<int>(piece.middle.y() - around); v <= piece.middle.y() + around; ++v) {
      for (int u = static_cast<int>(piece.middle.x() - around); u <= piece.middle.x() + around;
           ++u) {
        const Eigen::Vector2d from = Eigen::Vector2d(u, v) - piece.middle;
        const double across = piece.across.dot(from);
        const double along = piece.across.x() * from.y() - piece.across.y() * from.x();
        if (u < 0 || v < 0 || u >= area_.width || v >= area_.height || std::abs(across) > reach ||
            std::abs(along) > kHalfPiece)
          continue;
        piece.pixels.emplace_back(u, v);
        ++counts(v, u);
      }
    }
    pieces.push_back(std::move(piece));
  }
  *looked = static_cast<int>(pieces.size());
  std::vector<RingPoint> points;
  for (const Piece& piece : pieces) {
    std::optional<RingPoint> point = look(piece, made);
    if (!point)
      continue;
    point->camera = camera_index;
    // The mean image of the angles by the camera itself, as the fit of the pose computes it.
    point->place += point->across.dot(shift);
    for (const auto& [angle, share] : point->angles)
      point->place += share * point->across.dot(camera_.project(ring.point(angle)));
    points.push_back(*point);
  }
  return points;
}

}  // namespace fastball::vision_tracker
