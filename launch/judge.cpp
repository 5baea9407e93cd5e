#include "launch/judge.h"

namespace fastball::launch {

namespace {

void add(const sim_truth_t& event, Truth& truth) {
  switch (event.event) {
    case sim_truth_t::RELEASED:
      if (truth.release_utime)
        break;  // A ball that was touched again leaves a second time.
      truth.release_utime = event.utime;
      truth.release_speed = Eigen::Map<const Eigen::Vector3d>(event.v_WBall).norm();
      break;
    case sim_truth_t::TOUCHED:
      if (truth.touched.empty())
        truth.touched = event.note;
      break;
    case sim_truth_t::LANDED:
      if (!truth.landing)
        truth.landing = Eigen::Vector2d(event.landing[0], event.landing[1]);
      break;
    default:
      break;
  }
}

}  // namespace

Judge::Judge(messaging::Endpoint& endpoint) {
  endpoint.subscribe<sim_truth_t>(messaging::kSimTruth, [this](const sim_truth_t& message) {
    if (message.event != sim_truth_t::SAMPLE)
      events_[message.scene_id].emplace(message.event_index, message);
  });
}

Truth Judge::of(int64_t scene_id) const {
  Truth truth;
  const auto events = events_.find(scene_id);
  if (events == events_.end())
    return truth;
  for (const auto& [index, event] : events->second)
    add(event, truth);
  const auto& [last_index, last] = *events->second.rbegin();
  truth.finished = last.event == sim_truth_t::FINISHED &&
                   static_cast<std::size_t>(last_index) == events->second.size();
  return truth;
}

}  // namespace fastball::launch
