#include "sim_bullet/command_watch.h"

#include <fmt/format.h>

namespace fastball::sim_bullet {
namespace {

/// A sender answers every state once, and once more if the network doubles it; some answers may be under way.
constexpr int64_t kAnswersPerState = 2;
constexpr int64_t kAnswersUnderWay = 8;

bool isPowerOfTwo(int64_t n) {
  return (n & (n - 1)) == 0;
}

}  // namespace

void CommandWatch::beginScene(int64_t scene_id) {
  scene_before_ = scene_;
  scene_ = scene_id;
  newest_tick_ = -1;
  any_ = false;
  states_ = refused_ = 0;
  first_fault_.clear();
  sentence_.clear();
}

void CommandWatch::stateSaid(int64_t tick) {
  newest_tick_ = tick;
  ++states_;
}

void CommandWatch::take(const Stamp& stamp) {
  if (stamp.scene_id == scene_ && (!any_ || stamp.seq > last_.seq)) {
    any_ = true;
    last_ = stamp;
    last_words_ = words_;
    states_ = 0;
  }
}

std::string CommandWatch::faultOf(const Stamp& stamp) const {
  if (scene_ == 0)
    return fmt::format("answers scene {} before any has begun", stamp.scene_id);
  if (stamp.scene_id != scene_) {
    const bool late = stamp.scene_id == scene_before_ && scene_before_ != 0;
    return late ? "" : fmt::format("answers scene {} in scene {}", stamp.scene_id, scene_);
  }
  if (stamp.tick > newest_tick_)
    return fmt::format("answers tick {}, the newest state is of tick {}", stamp.tick, newest_tick_);
  if (!any_)
    return "";
  if (stamp.tick == last_.tick && words_ != last_words_)
    return fmt::format("differs from the one before about tick {}", stamp.tick);
  if ((stamp.tick > last_.tick && stamp.seq <= last_.seq) ||
      (stamp.tick < last_.tick && stamp.seq > last_.seq)) {
    return fmt::format("has seq {} at tick {}, the sender before was at seq {} at tick {}",
                       stamp.seq, stamp.tick, last_.seq, last_.tick);
  }
  if (stamp.seq - last_.seq > kAnswersPerState * states_ + kAnswersUnderWay) {
    return fmt::format("has seq {} after {} with {} states between", stamp.seq, last_.seq, states_);
  }
  return "";
}

void CommandWatch::refuse(const std::string& fault, const std::string& sender) {
  if (++refused_ == 1)
    first_fault_ = sender.empty() ? " " + fault : fmt::format(", of {}, {}", sender, fault);
  if (isPowerOfTwo(refused_)) {
    sentence_ = fmt::format("refused {} {}{} of a second sender; the first{}", refused_, channel_,
                            refused_ == 1 ? "" : "s", first_fault_);
  }
}

}  // namespace fastball::sim_bullet
