#pragma once

#include "bench/row.h"

namespace fastball::bench {

/// How well a flight is fitted to centres made of formulas: against the Cramer-Rao bound (vision.crb_ratio), with
/// centres lost and others wrong (vision.crb_ratio_dirty), inside its stated ellipse (vision.consistency), with
/// images missing (vision.degraded_ratio).
Row cleanBound();
Row dirtyBound();
Row consistency();
Row degraded();

}  // namespace fastball::bench
