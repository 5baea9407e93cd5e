#include "vision_tracker/board_collector.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace fastball::vision_tracker {
namespace {

constexpr double kStill = 1.0;  // [px], that corners may move from look to look
constexpr double kNew = 0.04;   // of the image's diagonal, that corners have moved since any view

/// [px], mean distance of the corners that both have; infinite if these are too few.
double distance(BoardCorners a, BoardCorners b) {
  keepCommon(a, b);
  if (a.ids.size() < BoardCorners::kLeast)
    return std::numeric_limits<double>::infinity();
  double sum = 0;
  for (std::size_t i = 0; i < a.ids.size(); ++i)
    sum += cv::norm(a.pixels[i] - b.pixels[i]);
  return sum / static_cast<double>(a.ids.size());
}

}  // namespace

BoardCollector::BoardCollector(const BoardShape& shape, const std::vector<std::string>& cameras)
    : finder_(shape), eyes_(cameras.size()) {
  for (const std::string& name : cameras)
    images_.push_back({name, {}});
}

bool BoardCollector::isStill(const Eye& eye) {
  return eye.now.isEnough() && distance(eye.now, eye.before) < kStill;
}

bool BoardCollector::isNew(const Eye& eye) {
  const double least = kNew * std::hypot(eye.size.width, eye.size.height);
  return std::all_of(eye.taken.begin(), eye.taken.end(),
                     [&](const BoardCorners& taken) { return distance(eye.now, taken) > least; });
}

bool BoardCollector::look(const std::vector<cv::Mat>& greys) {
  bool is_new = false;
  for (std::size_t i = 0; i < eyes_.size(); ++i) {
    Eye& eye = eyes_[i];
    eye.before = eye.now;
    eye.now = greys[i].empty() ? BoardCorners{} : finder_.find(greys[i]);
    eye.size = greys[i].size();
    is_new = is_new || (isStill(eye) && isNew(eye));
  }
  if (!is_new)
    return false;
  const std::string name = fmt::format("view{:03}.png", ++views_);
  for (std::size_t i = 0; i < eyes_.size(); ++i) {
    if (!isStill(eyes_[i]))
      continue;
    eyes_[i].taken.push_back(eyes_[i].now);
    images_[i].images.push_back({name, greys[i].clone()});
  }
  return true;
}

std::vector<std::size_t> BoardCollector::corners() const {
  std::vector<std::size_t> counts;
  for (const Eye& eye : eyes_)
    counts.push_back(eye.now.ids.size());
  return counts;
}

std::size_t BoardCollector::fewestViews() const {
  std::size_t fewest = images_.front().images.size();
  for (const CameraImages& camera : images_)
    fewest = std::min(fewest, camera.images.size());
  return fewest;
}

}  // namespace fastball::vision_tracker
