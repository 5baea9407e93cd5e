#pragma once

#include "model/rolling_ball.h"

namespace fastball::launch {

/// Rolling by Eqs. (21) and (22) exactly as the paper prints them: 5/7, without the hand's angular acceleration in Eq. (21), with
/// wx'^2 where wx' wy' belongs in Eq. (22), without slip and without drag, until F'y is zero. The samples' friction is not known.
model::RollingMotion rollAsPrinted(const model::BallParameters& ball,
                                   const model::FingerPair& fingers,
                                   const model::HandPath& hand_at,
                                   const model::RollingTask& task);

}  // namespace fastball::launch
