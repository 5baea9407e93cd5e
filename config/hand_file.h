#pragma once

#include "config/strict_yaml.h"
#include "model/ball_parameters.h"
#include "model/hand_parameters.h"

namespace fastball::config {

/// config/ball.yaml.
/// @throw ConfigError also for a ball so soft that the hand's grip crushes it.
model::BallParameters readBall(Section file);

/// config/hand.yaml; `ball` becomes a part of the payload.
/// @throw ConfigError also if palm and fingers have another mass than the whole hand, or the ball
/// would lie in the palm.
model::HandParameters readHand(Section file, const model::BallParameters& ball);

}  // namespace fastball::config
