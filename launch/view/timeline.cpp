#include "launch/view/timeline.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "config/image_channel.h"
#include "messaging/command_trailer.h"
#include "messaging/message_type.h"
#include "messaging/validation.h"

namespace fastball::view {
namespace {

constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();
/// [us] A lost HAND_STATE does not make the hand vanish.
constexpr int64_t kHandStays = 20'000;
const std::string kCameraPrefix = "CAMERA_";

template <class T>
bool decode(const void* data, std::size_t size, T& message) {
  return messaging::decodeWithoutTrailer(messaging::messageType<T>(), &message, data, size) &&
         !messaging::fault(message);
}

template <std::size_t n>
void put(Sample& sample, int where, const double (&values)[n]) {
  for (std::size_t i = 0; i < n; ++i)
    sample.values.at(static_cast<std::size_t>(where) + i) = static_cast<float>(values[i]);
}

}  // namespace

Timeline::Timeline(const config::Experiment& experiment, double floor, TimelineLimits limits)
    : experiment_(experiment),
      figure_(experiment, floor),
      limits_(limits),
      arm_phase_(kUnknown),
      hand_phase_(kUnknown),
      samples_(limits.samples),
      heartbeats_(limits.heartbeats),
      track_(limits.track_points) {
  know(messaging::kArmState, &Timeline::hear);
  know(messaging::kHandState, &Timeline::hear);
  know(messaging::kArmCommand, &Timeline::hear);
  know(messaging::kHandCommand, &Timeline::hear);
  know(messaging::kControllerStatus, &Timeline::hear);
  know(messaging::kEstop, &Timeline::hear);
  know(messaging::kPlanRequest, &Timeline::hear);
  know(messaging::kSwingPlan, &Timeline::hear);
  know(messaging::kThrowStart, &Timeline::hear);
  know(messaging::kRelease, &Timeline::hear);
  know(messaging::kBallTrack, &Timeline::hear);
  know(messaging::kLanding, &Timeline::hear);
  know(messaging::kHeartbeat, &Timeline::hear);
  know(messaging::kLoggerStatus, &Timeline::hear);
}

template <class T>
void Timeline::know(const messaging::Channel<T>& channel, void (Timeline::*member)(const T&)) {
  hearers_[channel.name] = [this, member](const void* data, std::size_t size) {
    T message{};
    if (!decode(data, size, message))
      return false;
    (this->*member)(message);
    return true;
  };
}

std::string Timeline::channels() const {
  std::string names = "(" + kCameraPrefix + ".*";
  for (const auto& [name, hearer] : hearers_)
    names += "|" + name;
  return names + ")";
}

void Timeline::take(const std::string& channel,
                    const void* data,
                    std::size_t size,
                    int64_t utime,
                    int64_t log_offset) {
  const auto hearer = hearers_.find(channel);
  const bool image = config::isImageChannel(channel);
  if (hearer == hearers_.end() && !image)
    return;
  utime_ = utime;
  log_offset_ = log_offset;
  axis_.receive(utime);
  const bool valid = image ? hearImage(channel, data, size) : hearer->second(data, size);
  Count& count = counts_[channel];
  ++(valid ? count.taken : count.invalid);
  count.newest_utime = utime;
}

int64_t Timeline::taken(const std::string& channel) const {
  const auto count = counts_.find(channel);
  return count == counts_.end() ? 0 : count->second.taken;
}

bool Timeline::beginSample(int64_t scene_id, int64_t utime) {
  const int64_t scenes_before = axis_.scenes();
  axis_.state(scene_id, utime);
  const bool new_scene = axis_.scenes() != scenes_before;
  if (!new_scene && utime < unfinished_.utime)
    return false;
  if (new_scene || utime > unfinished_.utime) {
    endSample();
    unfinished_ = {axis_.at(utime), utime, {}, {}};
  }
  if (new_scene) {
    last_hand_.reset();
    ViewedThrow* viewed = &throwOf(scene_id);
    if (viewed->offset)
      viewed = &newThrow(scene_id);
    viewed->offset = axis_.offset();
    viewed->t_scene = axis_.at(utime);
    changed(*viewed);
  }
  return true;
}

void Timeline::endSample() {
  if (!unfinished_.arm && !unfinished_.hand)
    return;
  if (unfinished_count_++ % limits_.keep_every != 0)
    return;
  if (!unfinished_.hand && last_hand_ && unfinished_.utime - last_hand_->utime < kHandStays)
    unfinished_.hand = last_hand_;
  Sample sample;
  sample.t = unfinished_.t;
  sample.values.fill(kUnknown);
  std::optional<model::Vector4> q_arm;
  std::optional<model::HandVector> q_hand;
  if (unfinished_.arm) {
    q_arm = Eigen::Map<const model::Vector4>(unfinished_.arm->q);
    put(sample, kSpeed, unfinished_.arm->qd);
    put(sample, kTorque, unfinished_.arm->tau);
    put(sample, kAngle, unfinished_.arm->q);
  }
  if (unfinished_.hand) {
    const hand_state_t& hand = *unfinished_.hand;
    q_hand = Eigen::Map<const model::HandVector>(hand.q);
    put(sample, kNormal, hand.f_normal);
    for (std::size_t i = 0; i < model::kFingers; ++i)
      sample.values.at(kTangential + i) =
          static_cast<float>(std::hypot(hand.f_tangential[i][0], hand.f_tangential[i][1]));
  }
  sample.values[kArmPhase] = arm_phase_;
  sample.values[kHandPhase] = hand_phase_;
  std::size_t at = kPoints;
  for (const Eigen::Vector3f& p : figure_.points(q_arm, q_hand)) {
    for (const float coordinate : p)
      sample.values.at(at++) = coordinate;
  }
  samples_.push(sample);
}

void Timeline::hear(const arm_state_t& state) {
  if (beginSample(state.scene_id, state.utime))
    unfinished_.arm = state;
}

void Timeline::hear(const hand_state_t& state) {
  if (!beginSample(state.scene_id, state.utime))
    return;
  unfinished_.hand = state;
  last_hand_ = state;
}

void Timeline::hear(const heartbeat_t& heartbeat) {
  heartbeats_.push({now(), utime_, heartbeat});
}

bool Timeline::hearImage(const std::string& channel, const void* data, std::size_t size) {
  const auto image = std::make_shared<image_t>();
  if (!decode(data, size, *image))
    return false;
  Kept<Picture>& kept = pictures_.try_emplace(channel, limits_.pictures).first->second;
  Picture picture;
  picture.t = axis_.scenes() > 0 ? std::min(axis_.at(image->utime), now()) : now();
  picture.log_offset = log_offset_;
  if (log_offset_ < 0)
    picture.image = image;
  kept.push(picture);
  std::size_t& bytes = picture_bytes_[channel];
  bytes += picture.image ? image->data.size() : 0;
  while (bytes > limits_.picture_bytes) {
    bytes -= kept.at(kept.first())->image->data.size();
    kept.dropFirst();
  }
  return true;
}

}  // namespace fastball::view
