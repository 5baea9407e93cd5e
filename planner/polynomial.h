#pragma once

#include "model/swing.h"

namespace fastball::planner {

/// The quintic that goes from `a` at time 0 to `b` at time T > 0 [s], with speeds and
/// accelerations, at time t; before and after it goes on.
model::BaseValue quinticAt(const model::BaseValue& a,
                           const model::BaseValue& b,
                           double T,
                           double t);

/// The quartic that leads `from` at time 0 to rest at time T > 0 [s] (speed a cubic, end angle free), at time t; rest after T.
model::BaseValue brakeAt(const model::BaseValue& from, double T, double t);

}  // namespace fastball::planner
