#include "launch/verdicts.h"

namespace fastball::launch {

Verdicts::Verdicts(const ExperimentNode& experiment,
                   Judge& judge,
                   double target_radius,
                   Progress& progress)
    : experiment_(experiment), judge_(judge), target_radius_(target_radius), progress_(progress) {}

void Verdicts::update() {
  while (!complete()) {
    const Throw& seen = experiment_.throws()[throws_.size()];
    const Truth truth = judge_.of(seen.scene_id);
    if (!truth.finished)
      return;
    throws_.push_back(judge(seen, truth, target_radius_));
    progress_.line(throwLine(throws_.back()));
  }
}

}  // namespace fastball::launch
