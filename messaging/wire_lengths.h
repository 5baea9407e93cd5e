#pragma once

#include "lcmtypes/fastball_types.h"

/// LCM's generated decoders believe the lengths they read: a hostile one makes them allocate
/// gigabytes or read past the end. So the lengths are compared with the bytes that came before a
/// decoder sees them.
namespace fastball::messaging {

/// True if `size` bytes are exactly what an encoded T takes, by its own length fields. Says nothing
/// about the values.
template <class T>
bool lengthsFit(const void* /*data*/, int size) {
  static const int fixed_size = T{}.getEncodedSize();
  return size == fixed_size;
}

template <>
bool lengthsFit<ball_observation_t>(const void* data, int size);
template <>
bool lengthsFit<camera_info_t>(const void* data, int size);
template <>
bool lengthsFit<clock_probe_t>(const void* data, int size);
template <>
bool lengthsFit<controller_status_t>(const void* data, int size);
template <>
bool lengthsFit<estop_t>(const void* data, int size);
template <>
bool lengthsFit<heartbeat_t>(const void* data, int size);
template <>
bool lengthsFit<image_t>(const void* data, int size);
template <>
bool lengthsFit<landing_t>(const void* data, int size);
template <>
bool lengthsFit<logger_status_t>(const void* data, int size);
template <>
bool lengthsFit<plan_request_t>(const void* data, int size);
template <>
bool lengthsFit<sim_truth_t>(const void* data, int size);
template <>
bool lengthsFit<swing_plan_t>(const void* data, int size);

}  // namespace fastball::messaging
