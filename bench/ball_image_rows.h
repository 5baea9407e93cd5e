#pragma once

#include "bench/row.h"

namespace fastball::bench {

/// How well the centre of a ball is found in an image, for the worst kind of ball: vision.centre_bias_px and vision.centre_rms_px.
Row centreBias();
Row centreRms();

}  // namespace fastball::bench
