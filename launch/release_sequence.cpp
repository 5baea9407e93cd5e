#include "launch/release_sequence.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "launch/track_flight.h"
#include "model/arm.h"

namespace fastball::launch {
namespace {

using Eigen::Vector3d;

double seconds(int64_t us) {
  return 1e-6 * static_cast<double>(us);
}

double distance(const model::Segment& segment, const Vector3d& p) {
  const Vector3d along = segment.p_end - segment.p_start;
  const double share = std::clamp((p - segment.p_start).dot(along) / along.squaredNorm(), 0.0, 1.0);
  return (p - segment.p_start - share * along).norm();
}

double distanceFromPalm(const model::HandParameters& hand, const Vector3d& p_H) {
  const double radial = std::hypot(p_H.x(), p_H.y());
  return std::hypot(std::max(0.0, radial - hand.palm_radius), p_H.z() - hand.palm_distance);
}

/// Builds the ticks one by one.
class Poses {
 public:
  Poses(const ThrowRecord& record, const config::Experiment& experiment)
      : record_(record),
        experiment_(experiment),
        arm_(experiment.arm, experiment.hand.payload),
        hand_(experiment.hand) {}

  HandAndBall at(const arm_state_t& arm, const hand_state_t& hand) const {
    HandAndBall tick;
    tick.t = seconds(arm.utime - record_.departed->utime);
    tick.q = Eigen::Map<const model::HandVector>(hand.q);
    tick.X_WH = arm_.X_WT(Eigen::Map<const Eigen::Vector4d>(arm.q)) *
                hand_.X_TH(tick.q[model::kWristRoll], tick.q[model::kWristFlexion]);
    tick.p_WBall = tick.t < 0 ? tick.X_WH * experiment_.hand.p_HBall : flying(arm.utime).p_WBall;
    for (const model::Finger finger : {model::kFingerA, model::kThumb, model::kFingerB})
      place(finger, tick);
    tick.palm_gap = distanceFromPalm(experiment_.hand, tick.X_WH.inverse() * tick.p_WBall) -
                    experiment_.ball.radius;
    return tick;
  }
  model::BallState flying(int64_t utime) const {
    // The last fit has seen the whole flight.
    return flightAt(record_.track.back(), utime, experiment_.arm.gravity);
  }

 private:
  void place(model::Finger finger, HandAndBall& tick) const {
    double nearest = INFINITY;
    const auto phalanges_H = hand_.phalanges(finger, tick.q);
    for (std::size_t i = 0; i < phalanges_H.size(); ++i) {
      const model::Segment axis{tick.X_WH * phalanges_H[i].p_start,
                                tick.X_WH * phalanges_H[i].p_end};
      tick.phalanges[finger][i] = axis;
      nearest = std::min(nearest, distance(axis, tick.p_WBall));
    }
    tick.gap[finger] = nearest - experiment_.hand.finger_radius - experiment_.ball.radius;
  }

  const ThrowRecord& record_;
  const config::Experiment& experiment_;
  model::Arm arm_;
  model::Hand hand_;
};

void requireMessages(const ThrowRecord& record) {
  const char* missing = !record.request        ? "PLAN_REQUEST"
                        : !record.plan         ? "SWING_PLAN"
                        : !record.start        ? "THROW_START"
                        : !record.commanded    ? "RELEASE of the command to let go"
                        : !record.departed     ? "RELEASE of the ball's departure"
                        : record.arm.empty()   ? "ARM_STATE"
                        : record.hand.empty()  ? "HAND_STATE"
                        : record.track.empty() ? "BALL_TRACK"
                                               : nullptr;
  if (missing)
    throw std::runtime_error(fmt::format("the log has no {}", missing));
}

}  // namespace

const HandAndBall& ReleaseSequence::at(double t) const {
  return *std::min_element(ticks.begin(), ticks.end(),
                           [t](const HandAndBall& a, const HandAndBall& b) {
                             return std::abs(a.t - t) < std::abs(b.t - t);
                           });
}

Opening openingAt(const ReleaseSequence& sequence, double t, const Vector3d& p_HBall) {
  const HandAndBall &tick = sequence.at(t), &command = sequence.at(sequence.t_command);
  Opening opening;
  opening.way_out = (tick.p_WBall - tick.X_WH * p_HBall).norm();
  opening.gap = INFINITY;
  for (const model::Finger finger : {model::kFingerA, model::kThumb, model::kFingerB}) {
    const int joint = model::Hand::proximalJoint(finger);
    opening.closed[finger] = tick.q[joint] - command.q[joint];
    if (tick.gap[finger] < opening.gap) {
      opening.gap = tick.gap[finger];
      opening.nearest = finger;
    }
  }
  return opening;
}

double smallestGap(const ReleaseSequence& sequence, double t_first, double t_last) {
  double smallest = INFINITY;
  for (const HandAndBall& tick : sequence.ticks) {
    if (tick.t >= t_first && tick.t <= t_last)
      smallest = std::min({smallest, tick.gap[0], tick.gap[1], tick.gap[2], tick.palm_gap});
  }
  return smallest;
}

ReleaseSequence releaseSequence(const ThrowRecord& record, const config::Experiment& experiment) {
  requireMessages(record);
  const Poses poses(record, experiment);
  const int64_t departure = record.departed->utime;
  ReleaseSequence sequence;
  sequence.t_command = seconds(record.commanded->utime - departure);
  auto hand = record.hand.begin();
  for (const arm_state_t& arm : record.arm) {
    hand = std::find_if(hand, record.hand.end(), [&](const auto& h) { return h.tick >= arm.tick; });
    if (hand == record.hand.end())
      break;
    if (hand->tick == arm.tick)
      sequence.ticks.push_back(poses.at(arm, *hand));
  }
  if (sequence.ticks.empty())
    throw std::runtime_error("the log has no tick with both ARM_STATE and HAND_STATE");
  sequence.t_swing = std::max(seconds(record.start->start_utime - departure) + record.plan->t_swing,
                              sequence.ticks.front().t);
  sequence.t_landing =
      std::min(seconds(record.track.back().landing_utime - departure), sequence.ticks.back().t);
  const model::BallState departing = poses.flying(departure);
  const HandAndBall& hand_then = sequence.at(0);
  sequence.v_WBall = departing.v_WBall;
  // The departure may lie between two ticks, in which the hand goes on with its ball.
  sequence.step_H =
      hand_then.X_WH.inverse() * (departing.p_WBall + hand_then.t * departing.v_WBall) -
      experiment.hand.p_HBall;
  return sequence;
}

}  // namespace fastball::launch
