#include "model/thumb_opening.h"

#include <algorithm>

namespace fastball::model {

ThumbOpening::Drive ThumbOpening::step(int64_t utime, double q, double qd) {
  const double speed = std::max(-qd, 0.0);
  const double way = q - open_angle_;
  if (!guided_ && (speed >= switch_speed_ || way <= speed * speed / (2 * deceleration_))) {
    guided_ = true;
    guide_utime_ = utime;
    q_guide_ = q;
    speed_ = std::max(speed, 1.0);  // [rad/s]: a thumb that is stuck near its end still gets there
  }
  if (!guided_) {
    return {q, qd, -torque_max_, false};
  }
  return guide(static_cast<double>(utime - guide_utime_) / 1e6);
}

/// Constant speed, then constant deceleration to the open angle; from beyond it, at the open angle at once.
ThumbOpening::Drive ThumbOpening::guide(double t) const {
  const double way = q_guide_ - open_angle_;
  if (way <= 0) {
    return {open_angle_, 0, 0, true};
  }
  const double deceleration = std::max(deceleration_, speed_ * speed_ / (2 * way));
  const double brake_time = speed_ / deceleration;
  const double t_brake = std::max(way / speed_ - brake_time / 2, 0.0);
  if (t <= t_brake) {
    return {q_guide_ - speed_ * t, -speed_, 0, true};
  }
  const double left = std::max(t_brake + brake_time - t, 0.0);
  return {open_angle_ + deceleration * left * left / 2, -deceleration * left, 0, true};
}

}  // namespace fastball::model
