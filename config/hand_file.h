#pragma once

#include "config/strict_yaml.h"
#include "model/ball_parameters.h"
#include "model/hand_parameters.h"

namespace fastball::config {

/// config/ball.yaml.
/// @throw ConfigError also for a ball so soft that the hand's grip crushes it.
model::BallParameters readBall(Section file);

/// config/hand.yaml; `ball` becomes a part of the payload.
model::HandParameters readHand(Section file, const model::BallParameters& ball);

}  // namespace fastball::config
