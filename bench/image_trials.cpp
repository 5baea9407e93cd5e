#include "bench/image_trials.h"

#include <Eigen/LU>
#include <chrono>
#include <ctime>
#include <opencv2/imgcodecs.hpp>

#include "bench/synthetic_throw.h"
#include "vision_tracker/sphere_outline.h"

namespace fastball::bench {
namespace {

constexpr double kOutOfHand = 0.03;   // [s] after the release no finger covers the ball
constexpr int64_t kEarly = 96000;     // [us] after the release: the next image is 100 ms after it
constexpr double kBeforeRing = 0.07;  // [m] before the plane the ring may cover it

/// Processor time [s] of this thread: what other programs do on the machine does not count.
double workedSeconds() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// The ball in free flight, nothing before it.
bool isFree(const SyntheticThrow& made,
            const config::Experiment& experiment,
            int64_t utime,
            model::BallState& ball) {
  const double time = static_cast<double>(utime - made.release_utime) * 1e-6;
  if (time < kOutOfHand || utime > made.landing_utime)
    return false;
  ball = model::fly(made.release, time, made.drag, experiment.arm.gravity);
  return experiment.target.distance(ball.p_WBall) > kBeforeRing;
}

}  // namespace

ImageTrial imageTrial(const sim_bullet::CameraRigOptions& cameras,
                      const config::Experiment& experiment,
                      const vision_tracker::TrackerOptions& options,
                      int seed) {
  const SyntheticThrow made = makeThrow(experiment, seed);
  sim_bullet::CameraRig rig(cameras, experiment.arm, experiment.hand, experiment.ball.radius);
  vision_tracker::ThrowTracker tracker(options);
  for (std::size_t i = 0; i < rig.cameras().size(); ++i) {
    const sim_bullet::RigCamera& c = rig.cameras()[i];
    tracker.setCamera(static_cast<int>(i), {c.camera, c.rate, c.exposure});
  }
  tracker.begin(experiment.target);
  ImageTrial trial;
  cv::Mat decoded;
  for (const sim_bullet::RenderedImage& image : renderThrow(rig, experiment, made, seed)) {
    const auto start = std::chrono::steady_clock::now();
    const double worked = workedSeconds();
    vision_tracker::Sighting sighting;
    // As the process does: after the landing no image is decoded.
    if (tracker.state() != vision_tracker::ThrowTracker::State::kLanded) {
      cv::imdecode(image.jpeg, cv::IMREAD_GRAYSCALE, &decoded);
      sighting = tracker.add(image.camera, image.utime, decoded);
    }
    trial.image_seconds.push_back(workedSeconds() - worked);
    if (const auto landing = tracker.takeLanding()) {
      trial.report = *landing;
      trial.landing_seconds =
          std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    }
    const auto track = tracker.takeTrack();
    if (track && !trial.early_error && track->utime > made.release_utime + kEarly)
      trial.early_error = (track->landing.landing - made.landing.landing).norm();
    model::BallState ball;
    if (!isFree(made, experiment, image.utime, ball))
      continue;
    ++trial.expected;
    if (!sighting.found)
      continue;
    const vision_tracker::Outline truth =
        vision_tracker::sphereOutline(rig.cameras()[static_cast<std::size_t>(image.camera)].camera,
                                      ball.p_WBall, experiment.ball.radius);
    trial.centres.push_back({image.camera, image.utime, sighting.fit.centre - truth.centre,
                             sighting.fit.cov, sighting.fit.radius - truth.meanRadius()});
  }
  tracker.end();
  if (const auto landing = tracker.takeLanding())
    trial.report = *landing;
  trial.duration = static_cast<double>(made.end_utime - made.start_utime) * 1e-6;
  trial.landing_error = trial.report.landing.landing - made.landing.landing;
  if (trial.report.measured)
    trial.normalised =
        trial.landing_error.dot(trial.report.landing.cov.inverse() * trial.landing_error);
  return trial;
}

}  // namespace fastball::bench
