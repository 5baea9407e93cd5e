#pragma once

#include <memory>

#include "messaging/node.h"
#include "messaging/process.h"

namespace fastball::vision_tracker {

/// The tracker as a process of the experiment: CAMERA_INFO, the images of the cameras in tracker.cameras and PLAN_REQUEST (for
/// the target) in; BALL_OBSERVATION for every image, BALL_TRACK and LANDING out. Before the first PLAN_REQUEST, and before all
/// these cameras' CAMERA_INFO, images are dropped. A throw keeps the calibrations that it began with: if one changes, it is not
/// measured. Its HEARTBEAT names the request as plan_id; its state is one of idle (no request yet),
/// waiting, tracking, landed.
/// @throw config::ConfigError
std::unique_ptr<messaging::Node> makeNode(messaging::Endpoint& endpoint,
                                          const messaging::Clock& clock,
                                          const messaging::ProcessOptions& options);

}  // namespace fastball::vision_tracker
