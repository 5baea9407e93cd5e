#pragma once

#include "model/swing.h"

namespace fastball::planner {

/// The quartic that leads a joint from a motion to rest (its speed is a cubic, the angle of rest is free), with its derivatives:
/// it is linear in the motion it begins with.
struct RestQuartic {
  model::BaseValue value;     ///< at time t
  model::BaseValue by_speed;  ///< derivative by the speed at time 0; that by the angle is (1, 0, 0)
  model::BaseValue by_acceleration;
  model::BaseValue by_duration;
};

/// @param from motion at time 0. @param T duration [s], positive. @param t [s], at least 0; at rest after T.
RestQuartic restQuartic(const model::BaseValue& from, double T, double t);

}  // namespace fastball::planner
