#include "messaging/wire_lengths.h"

#include <cstdint>

namespace fastball::messaging {
namespace {

/// Walks over an encoded message field by field; once a length does not fit, it never does again.
class Walk {
 public:
  Walk(const void* data, int size) : next_(static_cast<const uint8_t*>(data)), left_(size) {
    skip(sizeof(int64_t));  // the type's fingerprint
  }

  Walk& skip(int64_t bytes) {
    fits_ = fits_ && bytes >= 0 && bytes <= left_;
    if (fits_) {
      next_ += bytes;
      left_ -= bytes;
    }
    return *this;
  }

  /// An int32, most significant byte first; -1 if there is none.
  int64_t count() {
    const uint8_t* p = next_;
    skip(4);
    if (!fits_)
      return -1;
    return static_cast<int32_t>(uint32_t{p[0]} << 24 | uint32_t{p[1]} << 16 | uint32_t{p[2]} << 8 |
                                p[3]);
  }

  /// A string: its length with the final zero, then as many bytes.
  Walk& string() {
    const int64_t length = count();
    fits_ = fits_ && length >= 1;
    return skip(length);
  }

  Walk& strings(int64_t n) {
    fits_ = fits_ && n >= 0;
    for (int64_t i = 0; fits_ && i < n; ++i)
      string();
    return *this;
  }

  bool end() const { return fits_ && left_ == 0; }

 private:
  const uint8_t* next_;
  int64_t left_;
  bool fits_ = true;
};

constexpr int64_t kInt64 = 8;
constexpr int64_t kInt32 = 4;
constexpr int64_t kInt8 = 1;
constexpr int64_t kDouble = 8;

}  // namespace

template <>
bool lengthsFit<ball_observation_t>(const void* data, int size) {
  return Walk(data, size).skip(3 * kInt64).string().skip(kInt64 + kInt8 + 6 * kDouble).end();
}

template <>
bool lengthsFit<camera_info_t>(const void* data, int size) {
  const int64_t numbers = 2 * kInt32 + (9 + 5 + 9 + 3 + 2) * kDouble;
  return Walk(data, size).skip(2 * kInt64).string().skip(numbers).end();
}

template <>
bool lengthsFit<controller_status_t>(const void* data, int size) {
  return Walk(data, size).skip(4 * kInt64 + kInt8 + 12 * kDouble + 2 * kInt64).string().end();
}

template <>
bool lengthsFit<estop_t>(const void* data, int size) {
  return Walk(data, size).skip(2 * kInt64).string().end();
}

template <>
bool lengthsFit<clock_probe_t>(const void* data, int size) {
  return Walk(data, size)
      .skip(2 * kInt64)
      .strings(2)
      .skip(kInt32)
      .strings(1)
      .skip(kInt32 + 2 * kInt64)
      .end();
}

template <>
bool lengthsFit<heartbeat_t>(const void* data, int size) {
  return Walk(data, size)
      .skip(2 * kInt64)
      .strings(2)
      .skip(kInt32)
      .strings(3)
      .skip(4 * kInt64 + 2 * kDouble)
      .end();
}

template <>
bool lengthsFit<image_t>(const void* data, int size) {
  Walk walk(data, size);
  walk.skip(2 * kInt64 + 4 * kInt32);
  const int64_t bytes = walk.count();
  return walk.skip(bytes).end();
}

template <>
bool lengthsFit<landing_t>(const void* data, int size) {
  return Walk(data, size).skip(3 * kInt64 + kInt8 + 8 * kDouble + kInt32 + kDouble).string().end();
}

template <>
bool lengthsFit<logger_status_t>(const void* data, int size) {
  return Walk(data, size).skip(2 * kInt64).string().skip(3 * kInt64).string().end();
}

template <>
bool lengthsFit<plan_request_t>(const void* data, int size) {
  return Walk(data, size).skip(4 * kInt64).string().skip(17 * kDouble).end();
}

template <>
bool lengthsFit<sim_truth_t>(const void* data, int size) {
  return Walk(data, size).skip(3 * kInt64 + kInt8 + kInt32 + 15 * kDouble).string().end();
}

template <>
bool lengthsFit<swing_plan_t>(const void* data, int size) {
  Walk walk(data, size);
  walk.skip(3 * kInt64).string().skip(kInt8).string().skip(21 * kDouble);
  const int64_t n_parameters = walk.count();
  walk.strings(n_parameters).skip(n_parameters * kDouble).skip(kDouble);
  const int64_t n_samples = walk.count();
  return walk.skip(n_samples * 12 * kDouble).end();
}

}  // namespace fastball::messaging
