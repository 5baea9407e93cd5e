#include "launch/judge.h"

namespace fastball::launch {

Judge::Judge(messaging::Endpoint& endpoint) {
  endpoint.subscribe<sim_truth_t>(messaging::kSimTruth,
                                  [this](const sim_truth_t& message) { hear(message); });
}

void Judge::hear(const sim_truth_t& message) {
  Truth& truth = truths_[message.scene_id];
  switch (message.event) {
    case sim_truth_t::RELEASED:
      if (truth.release_utime)
        break;  // A ball that was touched again leaves a second time.
      truth.release_utime = message.utime;
      truth.release_speed = Eigen::Map<const Eigen::Vector3d>(message.v_WBall).norm();
      break;
    case sim_truth_t::TOUCHED:
      if (truth.touched.empty())
        truth.touched = message.note;
      break;
    case sim_truth_t::LANDED:
      if (!truth.landing)
        truth.landing = Eigen::Vector2d(message.landing[0], message.landing[1]);
      break;
    case sim_truth_t::FINISHED:
      truth.finished = true;
      break;
    default:
      break;
  }
}

}  // namespace fastball::launch
