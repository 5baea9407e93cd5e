#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "lcmtypes/fastball_types.h"
#include "vision_tracker/throw_tracker.h"

namespace fastball::vision_tracker {

/// The newest calibration of each of the tracker's cameras, from their CAMERA_INFOs.
class Calibrations {
 public:
  /// @param names channels of the cameras' images
  explicit Calibrations(const std::vector<std::string>& names);

  enum class News {
    kNone,     ///< of another camera, the same again, or not usable
    kFirst,    ///< this camera had none
    kChanged,  ///< this camera had another one
  };
  /// Takes in what a CAMERA_INFO says, if it is one of these cameras'.
  /// @param fault why it is no calibration, as a sentence; else empty
  News take(const camera_info_t& message, std::string& fault);

  /// Whether all cameras have one.
  bool complete() const;
  /// The cameras that have none: "CAMERA_LEFT and CAMERA_RIGHT".
  std::string missing() const;
  /// Of a camera that has one.
  const CameraSetup& of(std::size_t camera) const { return *setups_[camera]; }
  /// Of all cameras, which must be complete().
  std::vector<model::Camera> cameras() const;

  /// On the first CAMERA_INFO of a camera that is none of these, one sentence; empty: none came.
  const std::string& stranger() const { return stranger_; }
  /// How many such messages came.
  int64_t strangers() const { return strangers_; }

 private:
  void takeStranger(const std::string& channel);

  const std::vector<std::string> names_;
  std::vector<std::optional<CameraSetup>> setups_;
  int64_t strangers_ = 0;
  std::string stranger_;
};

}  // namespace fastball::vision_tracker
