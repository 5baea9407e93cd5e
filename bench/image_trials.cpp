#include "bench/image_trials.h"

#include <Eigen/LU>
#include <algorithm>
#include <chrono>
#include <ctime>
#include <opencv2/imgcodecs.hpp>
#include <random>

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

/// What the tracker saw in an image against the truth.
void judge(const DrawnThrow& drawn,
           const config::Experiment& experiment,
           std::size_t index,
           const vision_tracker::Sighting& sighting,
           ImageTrial& trial) {
  constexpr double kRight = 3.0;  // [px], nearer than that it is the ball that was found
  const sim_bullet::RenderedImage& image = drawn.images[index];
  ++trial.images;
  const vision_tracker::Outline truth = trueOutline(drawn, experiment.ball.radius, image);
  const auto right = [&](const vision_tracker::BallFit& fit) {
    return (fit.centre - truth.centre).norm() < kRight;
  };
  if (sighting.tracked && sighting.found && !right(sighting.fit))
    ++trial.wrong;
  model::BallState ball;
  if (!isFree(drawn.made, experiment, image.utime, ball) ||
      (!drawn.covered.empty() && drawn.covered[index]))
    return;
  ++trial.expected;
  for (const vision_tracker::BallFit& fit : sighting.candidates) {
    if (!right(fit))
      continue;
    ++trial.detected;
    trial.centres.push_back({image.camera, image.utime, fit.centre - truth.centre, fit.cov,
                             fit.radius - truth.meanRadius()});
    break;
  }
}

}  // namespace

vision_tracker::Outline trueOutline(const DrawnThrow& drawn,
                                    double radius,
                                    const sim_bullet::RenderedImage& image) {
  const std::vector<sim_bullet::SceneSnapshot>& all = drawn.made.snapshots;
  const auto after = std::lower_bound(
      all.begin() + 1, all.end() - 1, image.utime,
      [](const sim_bullet::SceneSnapshot& s, int64_t utime) { return s.utime < utime; });
  const double share = static_cast<double>(image.utime - (after - 1)->utime) /
                       static_cast<double>(after->utime - (after - 1)->utime);
  const Eigen::Vector3d p_WBall =
      (after - 1)->p_WBall + share * (after->p_WBall - (after - 1)->p_WBall);
  return vision_tracker::sphereOutline(drawn.cameras[static_cast<std::size_t>(image.camera)].camera,
                                       p_WBall, radius);
}

DrawnThrow drawThrow(const sim_bullet::CameraRigOptions& cameras,
                     const config::Experiment& experiment,
                     int seed) {
  sim_bullet::CameraRig rig(cameras, experiment.arm, experiment.hand, experiment.ball.radius);
  DrawnThrow drawn;
  drawn.made = makeThrow(experiment, seed);
  drawn.cameras = rig.cameras();
  drawn.images = renderThrow(rig, experiment, drawn.made, seed);
  return drawn;
}

Knowledge wrongKnowledge(const DrawnThrow& drawn,
                         const model::Target& target,
                         const vision_tracker::CalibrationSigma& calibration,
                         double position,
                         double tilt,
                         int seed) {
  std::mt19937 random(static_cast<unsigned>(seed));
  std::normal_distribution<double> normal;
  Knowledge knowledge{drawn.cameras, target};
  const vision_tracker::CameraConstants sigma =
      vision_tracker::constantVariances(0, calibration).cwiseSqrt();
  for (sim_bullet::RigCamera& c : knowledge.cameras) {
    vision_tracker::CameraConstants error;
    for (int i = 0; i < vision_tracker::kCameraConstants; ++i)
      error[i] = sigma[i] * normal(random);
    c.camera = vision_tracker::displaced(c.camera, error);
  }
  Eigen::Vector3d turn;
  for (int i = 0; i < 3; ++i) {
    knowledge.target.p_WTarget[i] += position * normal(random);
    turn[i] = tilt * normal(random);
  }
  knowledge.target.n_WTarget = (target.n_WTarget + turn.cross(target.n_WTarget)).normalized();
  return knowledge;
}

ImageTrial imageTrial(const DrawnThrow& drawn,
                      const config::Experiment& experiment,
                      const vision_tracker::TrackerOptions& options,
                      const Knowledge& knowledge) {
  const SyntheticThrow& made = drawn.made;
  vision_tracker::ThrowTracker tracker(options);
  for (std::size_t i = 0; i < knowledge.cameras.size(); ++i) {
    const sim_bullet::RigCamera& c = knowledge.cameras[i];
    tracker.setCamera(static_cast<int>(i), {c.camera, c.rate, c.exposure});
  }
  tracker.begin(knowledge.target);
  ImageTrial trial;
  cv::Mat decoded;
  for (const sim_bullet::RenderedImage& image : drawn.images) {
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
    judge(drawn, experiment, static_cast<std::size_t>(&image - drawn.images.data()), sighting,
          trial);
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
