#include "bench/held_ball.h"

#include <algorithm>
#include <stdexcept>

namespace fastball::bench {
namespace {

constexpr double kGrip = 6;          // [N]
constexpr double kSettleTime = 0.2;  // [s], after the feeder has let go

}  // namespace

HeldBall::HeldBall()
    : experiment_(config::loadExperiment(config::defaultExperimentPath())),
      settings_(sim_bullet::loadSimulationSettings(config::defaultExperimentPath())),
      command_(graspCommand(experiment_, kGrip)),
      scene_(experiment_, settings_, {}, {{0, 1}, experiment_.q_rest, experiment_.target}) {
  while (static_cast<double>(scene_.tick()) * sim_bullet::kTick <
         settings_.feeder_release + kSettleTime)
    tick();
  const auto& forces = scene_.state().forces;
  if (std::any_of(forces.begin(), forces.end(), [](const auto& f) { return !(f.normal > 0); }))
    throw std::runtime_error("the ball that the hand should hold is not touched by all fingers");
}

}  // namespace fastball::bench
