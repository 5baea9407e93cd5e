#include "vision_tracker/ring_measurement.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "vision_tracker/ring_finder.h"

namespace fastball::vision_tracker {
namespace {

constexpr int kFarthestSearch = 40;           // [px]
constexpr double kLeastSeen = 0.4;            // share of the pieces
constexpr double kLargestDisagreement = 4.0;  // [px], between a camera's ring and that of all

/// Where a small movement of the ring's centre moves its image.
Eigen::Matrix<double, 2, 3> movementOf(const model::Camera& camera, const Ring& ring) {
  Eigen::Matrix<double, 2, 3> jacobian;
  camera.project(ring.p_W, &jacobian);
  return jacobian;
}

/// From a place [px] of a table of scores, whose middle is 0, to the best place around.
Eigen::Vector2d bestNear(const cv::Mat1f& scores, const Eigen::Vector2d& place) {
  constexpr int kAround = 2;
  const int middle = scores.rows / 2;
  const cv::Point centre(middle + static_cast<int>(std::lround(place.x())),
                         middle + static_cast<int>(std::lround(place.y())));
  const cv::Rect area =
      cv::Rect(centre.x - kAround, centre.y - kAround, 2 * kAround + 1, 2 * kAround + 1) &
      cv::Rect({0, 0}, scores.size());
  if (area.empty())
    return Eigen::Vector2d::Zero();
  cv::Point best;
  cv::minMaxLoc(scores(area), nullptr, nullptr, nullptr, &best);
  return Eigen::Vector2d(area.x + best.x - middle, area.y + best.y - middle) - place;
}

/// The ring's centre moved to where all cameras together see it best, by steps of about a pixel; its score. A camera that sees
/// the ring from its edge sees a line, and cannot say alone where along it the ring is.
double searchTogether(const std::vector<RingFinder>& finders,
                      const std::vector<model::Camera>& cameras,
                      double reach,
                      Ring& ring,
                      std::vector<Eigen::Vector2d>& shifts) {
  struct View {
    std::size_t camera;
    cv::Mat1f scores, around;
    Eigen::Matrix<double, 2, 3> movement;
  };
  std::vector<View> views;
  double step = reach;
  for (std::size_t c = 0; c < finders.size(); ++c) {
    if (!finders[c].inView())
      continue;
    const Eigen::Matrix<double, 2, 3> movement = movementOf(cameras[c], ring);
    const int pixels = static_cast<int>(std::ceil(reach * movement.norm() / std::sqrt(2.0))) + 1;
    View view{c, finders[c].search(ring, std::min(pixels, kFarthestSearch)), {}, movement};
    // A calibration that is a little wrong leaves a pixel between the cameras.
    cv::dilate(view.scores, view.around, cv::Mat::ones(3, 3, CV_8U));
    step = std::min(step, 1 / view.movement.norm() * std::sqrt(2.0));
    views.push_back(view);
  }
  const int steps = static_cast<int>(reach / step);
  Eigen::Vector3d best_move = Eigen::Vector3d::Zero();
  double best = -1;
  for (int x = -steps; x <= steps; ++x) {
    for (int y = -steps; y <= steps; ++y) {
      for (int z = -steps; z <= steps; ++z) {
        const Eigen::Vector3d move = step * Eigen::Vector3d(x, y, z);
        double score = 0;
        for (const View& view : views) {
          const Eigen::Vector2d at = view.movement * move;
          const int middle = view.scores.rows / 2;
          const int u = middle + static_cast<int>(std::lround(at.x()));
          const int v = middle + static_cast<int>(std::lround(at.y()));
          if (u >= 0 && v >= 0 && u < view.around.cols && v < view.around.rows)
            score += static_cast<double>(view.around(v, u));
        }
        // Of equals the nearest: they come from the dilation.
        score -= 1e-6 * move.norm();
        if (score > best) {
          best = score;
          best_move = move;
        }
      }
    }
  }
  for (const View& view : views)
    shifts[view.camera] = bestNear(view.scores, view.movement * best_move);
  ring.p_W += best_move;
  return best;
}

/// The same for rings turned a little each way, of which it takes the best.
void searchTurned(const std::vector<RingFinder>& finders,
                  const std::vector<model::Camera>& cameras,
                  double reach,
                  double turn,
                  Ring& ring,
                  std::vector<Eigen::Vector2d>& shifts) {
  const Ring start = ring;
  double best = -1;
  for (const double about_right : {0.0, -turn, turn}) {
    for (const double about_up : {0.0, -turn, turn}) {
      Eigen::Matrix<double, 6, 1> change = Eigen::Matrix<double, 6, 1>::Zero();
      change[3] = about_right;
      change[4] = about_up;
      Ring turned = start.moved(change);
      std::vector<Eigen::Vector2d> found(cameras.size(), Eigen::Vector2d::Zero());
      const double score = searchTogether(finders, cameras, reach, turned, found);
      if (score > best) {
        best = score;
        shifts = found;
        ring = turned;
      }
    }
  }
}

/// Fits the ring to what all cameras see of it, looks again where it lies now, and so on.
class RingRefinement {
 public:
  RingRefinement(const std::vector<RingFinder>& finders,
                 const std::vector<model::Camera>& cameras,
                 const Ring& nominal,
                 const RingPrior& prior)
      : finders_(finders),
        cameras_(cameras),
        nominal_(nominal),
        prior_(prior),
        ring_(nominal),
        shifts_(cameras.size(), Eigen::Vector2d::Zero()) {}

  void searchCoarsely() {
    constexpr double kNear = 0.02;  // [m], what the first search leaves
    searchTurned(finders_, cameras_, 3 * prior_.position, 2 * prior_.tilt, ring_, shifts_);
    for (const double part : {1.0, 0.5})
      searchTurned(finders_, cameras_, part * kNear, part * prior_.tilt, ring_, shifts_);
  }

  RingMeasurement refine() {
    constexpr int kRounds = 8;
    constexpr double kSettled = 1e-5;  // [m]
    RingMeasurement result;
    for (int round = 0; round < kRounds; ++round) {
      const bool first = round < kFirstRounds;
      std::vector<RingPoint> points;
      result.why_not = collect(!first, points);
      if (!result.why_not.empty())
        return result;
      estimate_ = fitRing(points, cameras_, nominal_, prior_, ring_);
      if (!estimate_) {
        result.why_not = fmt::format("{} places do not lie on one ring of {:.3f} m radius",
                                     points.size(), nominal_.radius);
        return result;
      }
      const double moved = move(first ? 1.0 : 0.5);
      if (!first && moved < kSettled)
        break;
    }
    result.why_not = doubt();
    if (result.why_not.empty())
      result.estimate = estimate_;
    return result;
  }

 private:
  static constexpr int kFirstRounds = 2;

  /// What the cameras see of the ring. @param strict every camera must see it @return why not, or empty
  std::string collect(bool strict, std::vector<RingPoint>& points) const {
    int looked_at = 0, seen = 0;
    for (std::size_t c = 0; c < finders_.size(); ++c) {
      if (!finders_[c].inView())
        continue;
      int looked = 0;
      const std::vector<RingPoint> found =
          finders_[c].points(ring_, shifts_[c], static_cast<int>(c), &looked);
      looked_at += looked;
      seen += static_cast<int>(found.size());
      if (static_cast<double>(found.size()) >= kLeastSeen * looked) {
        points.insert(points.end(), found.begin(), found.end());
      } else if (strict) {
        // What one camera takes for a ring may be a joint in the wall.
        return fmt::format("camera {} sees the ring at only {} of {} places", c, found.size(),
                           looked);
      }
    }
    return points.empty() ? fmt::format("the ring is seen at only {} of {} places", seen, looked_at)
                          : "";
  }

  /// Takes a part of the step to the estimate; half-way after the first rounds: what is seen at the ends of a ring seen from its
  /// edge depends on where one looks. @return [m], the whole step
  double move(double part) {
    const double moved = (estimate_->ring.p_W - ring_.p_W).norm();
    ring_ = ring_.moved(part * between(ring_, estimate_->ring));
    for (std::size_t c = 0; c < shifts_.size(); ++c)
      shifts_[c] += part * (estimate_->shifts[c] - shifts_[c]);
    return moved;
  }

  /// Why the estimate is not to be believed, or empty.
  std::string doubt() const {
    for (const Eigen::Vector2d& shift : estimate_->shifts)
      if (shift.norm() > kLargestDisagreement)
        return fmt::format("the cameras disagree by {:.1f} px about where the ring is",
                           shift.norm());
    const double off = (estimate_->ring.p_W - nominal_.p_W).norm();
    if (off > 4 * prior_.position)
      return fmt::format(
          "the ring seen is {:.3f} m from the one configured, at most {} m are allowed", off,
          4 * prior_.position);
    return "";
  }

  const std::vector<RingFinder>& finders_;
  const std::vector<model::Camera>& cameras_;
  const Ring& nominal_;
  const RingPrior& prior_;
  Ring ring_;
  std::vector<Eigen::Vector2d> shifts_;  ///< [px], of each camera's image of the ring
  std::optional<RingEstimate> estimate_;
};

}  // namespace

RingMeasurement measureRing(const std::vector<const cv::Mat*>& still,
                            const std::vector<model::Camera>& cameras,
                            const Ring& nominal,
                            const RingPrior& prior,
                            double blur) {
  std::vector<RingFinder> finders;
  bool any = false;
  for (std::size_t c = 0; c < cameras.size(); ++c) {
    const double depth = std::max(0.1, cameras[c].toCamera(nominal.p_W).z());
    const double reach =
        std::min<double>(kFarthestSearch, 3 * prior.position * cameras[c].fx / depth + 2);
    finders.emplace_back(cameras[c], *still[c], nominal, prior.tube, blur, reach);
    any = any || finders.back().inView();
  }
  if (!any)
    return {std::nullopt, "no camera has the whole ring in its image"};
  RingRefinement refinement(finders, cameras, nominal, prior);
  refinement.searchCoarsely();
  return refinement.refine();
}

}  // namespace fastball::vision_tracker
