#pragma once

#include "planner/swing_problem.h"

namespace fastball::bench {

/// The plain way to optimise a swing, as a peer: every limit at every sample is a constraint, all derivatives are
/// forward differences, NLopt's SLSQP as it is.
/// @param samples evenly over swing and follow-through.
planner::SwingSolution optimiseDensely(const planner::SwingTask& task,
                                       const planner::SwingVector& start,
                                       int elbow_sign,
                                       int samples,
                                       int max_evaluations);

}  // namespace fastball::bench
