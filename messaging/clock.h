#pragma once

#include <cstdint>

namespace fastball::messaging {

/// Wall time, injectable. Simulated time comes in messages, never from here.
class Clock {
 public:
  virtual ~Clock() = default;
  /// [us], never goes backwards; origin arbitrary.
  virtual int64_t monotonicUs() const = 0;
  /// [us] since 1970.
  virtual int64_t wallUs() const = 0;
};

class SystemClock : public Clock {
 public:
  int64_t monotonicUs() const override;
  int64_t wallUs() const override;
};

/// A clock that a test or the one-process experiment moves by hand.
class ManualClock : public Clock {
 public:
  int64_t monotonicUs() const override { return now_us_; }
  int64_t wallUs() const override { return now_us_; }
  void advanceUs(int64_t us) { now_us_ += us; }

 private:
  int64_t now_us_ = 0;
};

}  // namespace fastball::messaging
