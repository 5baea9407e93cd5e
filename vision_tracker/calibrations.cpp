#include "vision_tracker/calibrations.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <spdlog/spdlog.h>

#include <algorithm>

#include "messaging/validation.h"
#include "vision_tracker/camera_message.h"

namespace fastball::vision_tracker {

Calibrations::Calibrations(const std::vector<std::string>& names)
    : names_(names), setups_(names.size()) {}

Calibrations::News Calibrations::take(const camera_info_t& message, std::string& fault) {
  fault.clear();
  const auto name = std::find(names_.begin(), names_.end(), message.channel);
  if (name == names_.end()) {
    takeStranger(message.channel);
    return News::kNone;
  }
  if (const std::string why = cameraFault(message); !why.empty()) {
    fault = fmt::format("CAMERA_INFO of {} is no calibration: {}", message.channel, why);
    return News::kNone;
  }
  const CameraSetup setup = cameraSetup(message);
  std::optional<CameraSetup>& known = setups_[static_cast<std::size_t>(name - names_.begin())];
  if (known && sameCamera(*known, setup))
    return News::kNone;
  const bool changed = known.has_value();
  known = setup;
  return changed ? News::kChanged : News::kFirst;
}

void Calibrations::takeStranger(const std::string& channel) {
  ++strangers_;
  if (!stranger_.empty())
    return;
  stranger_ = messaging::shortened(fmt::format(
      "CAMERA_INFO of {} is of none of tracker.cameras, {}", channel, fmt::join(names_, ", ")));
  spdlog::warn("{}", stranger_);
}

bool Calibrations::complete() const {
  return std::all_of(setups_.begin(), setups_.end(), [](const auto& setup) { return !!setup; });
}

std::string Calibrations::missing() const {
  std::vector<std::string> missing;
  for (std::size_t camera = 0; camera < names_.size(); ++camera)
    if (!setups_[camera])
      missing.push_back(names_[camera]);
  return fmt::format("{}", fmt::join(missing, " and "));
}

std::vector<model::Camera> Calibrations::cameras() const {
  std::vector<model::Camera> cameras;
  for (const auto& setup : setups_)
    cameras.push_back(setup->camera);
  return cameras;
}

}  // namespace fastball::vision_tracker
