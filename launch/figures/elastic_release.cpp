#include "launch/figures/elastic_release.h"

#include <algorithm>
#include <stdexcept>

namespace fastball::launch {
namespace {

constexpr double kPush = 50;  // [m/s^2]

model::RollingTask task() {
  model::RollingTask task;
  task.t_end = 0.15;
  return task;
}

}  // namespace

Unloading unloading(const model::BallParameters& ball, double rate) {
  if (!(rate > 0))
    throw std::invalid_argument("a load that does not fall never lets the ball go");
  Unloading result{ball, {}, {}, rate};
  result.swing.acceleration = kPush;
  result.swing.fade_time = ball.mass * kPush / rate;
  return result;
}

model::ElasticMotion elasticRelease(const Unloading& unloading, double youngs_modulus) {
  model::BallParameters ball = unloading.ball;
  ball.youngs_modulus = youngs_modulus;
  const model::ElasticStart start =
      model::settledStart(ball, unloading.fingers, unloading.swing, task());
  return model::elasticOnFingers(ball, unloading.fingers, unloading.swing, start, task());
}

model::RollingMotion rigidRelease(const Unloading& unloading) {
  return model::rollOnFingers(unloading.ball, unloading.fingers, unloading.swing, task());
}

double recovery(const model::ElasticMotion& motion) {
  double fastest = 0;
  for (const model::ElasticSample& sample : motion.elastic) {
    if (sample.t <= motion.t_release)
      fastest = std::max(fastest, sample.v_FBall.y());
  }
  return fastest;
}

}  // namespace fastball::launch
