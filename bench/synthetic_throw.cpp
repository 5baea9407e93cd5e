#include "bench/synthetic_throw.h"

#include <Eigen/Geometry>
#include <Eigen/QR>
#include <cmath>
#include <random>

#include "model/arm.h"
#include "model/hand.h"

namespace fastball::bench {
namespace {

constexpr double kSwing = 0.09;  // [s], how long the swing lasts before and after the release

/// Velocity that takes the ball from p_WBall to `aim` on the target in about `duration`.
Eigen::Vector3d velocityFor(const Eigen::Vector3d& p_WBall,
                            const Eigen::Vector2d& aim,
                            double duration,
                            const model::Target& target,
                            double drag,
                            double gravity) {
  const Eigen::Vector3d goal =
      target.p_WTarget + aim.x() * target.rightAxis() + aim.y() * target.upAxis();
  Eigen::Vector3d v_WBall =
      (goal - p_WBall) / duration + Eigen::Vector3d(0, 0, gravity * duration / 2);
  for (int i = 0; i < 10; ++i) {
    const model::BallState end = model::fly({p_WBall, v_WBall}, duration, drag, gravity);
    v_WBall += (goal - end.p_WBall) / duration;
  }
  return v_WBall;
}

/// Uniform numbers, the same on every machine.
class Random {
 public:
  explicit Random(int seed) : generator_(static_cast<unsigned>(seed)) {}
  double operator()(double low, double high) {
    return low + (high - low) * static_cast<double>(generator_()) / 4294967296.0;
  }

 private:
  std::mt19937 generator_;
};

/// Release, drag and landing.
SyntheticThrow drawFlight(const config::Experiment& experiment,
                          Random& uniform,
                          std::optional<double> drag,
                          Eigen::Vector4d& q_release) {
  const model::Arm arm(experiment.arm);
  const double gravity = experiment.arm.gravity;
  SyntheticThrow made;
  made.drag = experiment.ball.dragPerMetre() * uniform(0.8, 1.2);
  if (drag)
    made.drag = *drag;
  q_release =
      Eigen::Vector4d(uniform(-0.4, 0.4), uniform(0.8, 1.1), uniform(-0.3, 0.3), uniform(0.2, 0.5));
  made.release.p_WBall = arm.p_WPoint(q_release, experiment.hand.p_HBall);
  const Eigen::Vector2d aim(uniform(-0.09, 0.09), uniform(-0.09, 0.09));
  made.release.v_WBall = velocityFor(made.release.p_WBall, aim, uniform(0.45, 0.6),
                                     experiment.target, made.drag, gravity);
  made.landing = *model::land(made.release, experiment.target, made.drag, gravity);
  return made;
}

}  // namespace

SyntheticThrow makeFlight(const config::Experiment& experiment,
                          int seed,
                          std::optional<double> drag) {
  Random uniform(seed);
  Eigen::Vector4d q_release;
  return drawFlight(experiment, uniform, drag, q_release);
}

SyntheticThrow makeThrow(const config::Experiment& experiment, int seed, int64_t scene_utime) {
  Random uniform(seed);
  const model::Arm arm(experiment.arm);
  const model::Hand hand(experiment.hand);
  Eigen::Vector4d q_release;
  SyntheticThrow made = drawFlight(experiment, uniform, {}, q_release);
  const double gravity = experiment.arm.gravity;
  const Eigen::Vector4d qd_release = arm.pointJacobian(q_release, experiment.hand.p_HBall)
                                         .completeOrthogonalDecomposition()
                                         .solve(made.release.v_WBall);
  made.start_utime = scene_utime;
  made.release_utime = scene_utime + 100000 + static_cast<int64_t>(uniform(0, 5000));
  made.landing_utime = made.release_utime + std::llround(made.landing.time * 1e6);
  made.end_utime = made.landing_utime + 60000;
  const model::HandVector closed =
      hand.posture(0, 0,
                   {experiment.ball.radius + 0.01, experiment.ball.radius + 0.01,
                    experiment.ball.radius + 0.01});
  for (int64_t utime = made.start_utime - 2000; utime <= made.end_utime + 2000; utime += 1000) {
    const double t = static_cast<double>(utime - made.release_utime) * 1e-6;
    sim_bullet::SceneSnapshot s;
    s.utime = utime;
    s.q_arm = q_release + qd_release * kSwing * std::tanh(t / kSwing);
    s.q_hand = closed;
    const double opened = std::min(1.0, std::max(0.0, t / 0.04));
    s.q_hand[model::kProximalThumb] -= 0.8 * opened;
    if (t < 0) {
      s.p_WBall = arm.p_WPoint(s.q_arm, experiment.hand.p_HBall);
      s.R_WBall = arm.X_WT(s.q_arm).linear();
    } else {
      s.p_WBall = model::fly(made.release, t, made.drag, gravity).p_WBall;
      s.R_WBall = Eigen::AngleAxisd(8 * t, Eigen::Vector3d::UnitY()) * arm.X_WT(q_release).linear();
    }
    made.snapshots.push_back(s);
  }
  return made;
}

std::vector<sim_bullet::RenderedImage> renderThrow(sim_bullet::CameraRig& rig,
                                                   const config::Experiment& experiment,
                                                   const SyntheticThrow& synthetic,
                                                   int64_t seed) {
  rig.begin(1, seed, synthetic.start_utime, synthetic.end_utime, experiment.target);
  std::vector<sim_bullet::RenderedImage> images;
  sim_bullet::RenderedImage image;
  for (const sim_bullet::SceneSnapshot& snapshot : synthetic.snapshots) {
    rig.add(snapshot);
    while (rig.nextImage(image))
      images.push_back(image);
  }
  rig.flush();
  while (rig.nextImage(image))
    images.push_back(image);
  return images;
}

}  // namespace fastball::bench
