#pragma once

#include "lcmtypes/fastball_types.h"
#include "vision_tracker/throw_tracker.h"

namespace fastball::vision_tracker {

/// What the tracker found, as messages; whose throw and which image it was is for the caller to fill in.
ball_observation_t observationMessage(const Sighting& sighting);
ball_track_t trackMessage(const TrackReport& report);
landing_t landingMessage(const LandingReport& report);

}  // namespace fastball::vision_tracker
