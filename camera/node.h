#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "camera/image_source.h"
#include "messaging/node.h"
#include "model/camera.h"

namespace fastball::camera {

/// How a camera is published.
struct CameraOptions {
  std::string source;                        ///< device or file, for sentences
  std::string channel = "CAMERA_LEFT";       ///< of the images
  std::optional<model::Camera> calibration;  ///< without it there is no CAMERA_INFO
  cv::Size size;                             ///< [px] that the images must have; empty: any
  double rate = 0;                           ///< [Hz], 0: what the source tells
  double exposure = 0;                       ///< [s], for CAMERA_INFO
  bool gray = false;                         ///< images in grey
  int quality = 90;                          ///< of the JPEG, 1 to 100

  /// A video has no clock: its images are stamped start_utime + number / rate and said when that time comes. A device stamps its
  /// images itself, and they are said as they come.
  bool video = false;
  double speed =
      1;  ///< of the wall clock with which a video is said; the stamps stay what they are
  std::optional<int64_t>
      start_utime;          ///< [us]; default: the wall clock's time, or 0 with on_request
  bool on_request = false;  ///< a video begins with each new PLAN_REQUEST
};

/// A camera as a process: images as JPEG and CAMERA_INFO out (once a second, and before the first
/// image), and PLAN_REQUEST in if it waits for one. Its name is the channel in small letters; its
/// state is one of opening, waiting (for its time or a request), publishing, ended. step() throws
/// what the source threw; std::runtime_error if no image comes for five seconds, or one has another
/// size than the first, other pixels than SourceImage says, or does not fit a message;
/// std::invalid_argument if calibration or wanted size are not the images', the rate of a video or
/// of a calibrated camera is unknown, or there is no image at all.
std::unique_ptr<messaging::Node> makeNode(messaging::Endpoint& endpoint,
                                          const messaging::Clock& clock,
                                          const CameraOptions& options,
                                          const OpenSource& open);

}  // namespace fastball::camera
