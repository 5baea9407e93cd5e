#include "bench/vision_rows.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "bench/ball_image_rows.h"
#include "bench/clutter.h"
#include "bench/flight_rows.h"
#include "bench/image_trials.h"
#include "bench/vision_setup.h"

namespace fastball::bench {
namespace {

constexpr int kImageThrows = 150;  // the mean normalised error's standard error is then 0.16
constexpr double kMilli = 1e3;

/// Throws from drawn images to the landing.
struct ImageResult {
  double landing_rms = 0, nees = 0, early_rms = 0;
  double stated_rms = 0;                                 ///< [m], that the covariances say
  double image_p99 = 0, landing_p99 = 0, real_time = 0;  ///< [s], [s], 1
  int landed = 0;
};

double quantile(std::vector<double> values, double share) {
  const auto place = std::min(values.size() - 1,
                              static_cast<std::size_t>(share * static_cast<double>(values.size())));
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(place),
                   values.end());
  return values[place];
}

ImageResult measureImages() {
  VisionSetup setup;
  setup.rig.workers = 0;  // drawing does not disturb the clock
  ImageResult result;
  std::vector<double> image_seconds, landing_seconds;
  double squares = 0, early = 0, stated = 0, duration = 0;
  int predicted = 0;
  for (int i = 0; i < kImageThrows; ++i) {
    const DrawnThrow drawn = drawThrow(setup.rig, setup.experiment, 1000 + i);
    const ImageTrial trial = imageTrial(drawn, setup.experiment, setup.tracker,
                                        {drawn.cameras, setup.experiment.target});
    image_seconds.insert(image_seconds.end(), trial.image_seconds.begin(),
                         trial.image_seconds.end());
    duration += trial.duration;
    if (trial.early_error) {
      early += *trial.early_error * *trial.early_error;
      ++predicted;
    }
    if (!trial.report.measured)
      continue;
    ++result.landed;
    landing_seconds.push_back(trial.landing_seconds);
    squares += trial.landing_error.squaredNorm();
    stated += trial.report.landing.cov.trace();
    result.nees += trial.normalised;
  }
  if (result.landed == 0 || predicted == 0)
    throw std::runtime_error("the tracker measured none of the drawn throws");
  result.landing_rms = std::sqrt(squares / result.landed);
  result.stated_rms = std::sqrt(stated / result.landed);
  result.nees /= result.landed;
  result.early_rms = std::sqrt(early / predicted);
  result.image_p99 = quantile(image_seconds, 0.99);
  result.landing_p99 = quantile(landing_seconds, 0.99);
  result.real_time = duration / std::accumulate(image_seconds.begin(), image_seconds.end(), 0.0);
  return result;
}

const ImageResult& images() {
  static const ImageResult result = measureImages();
  return result;
}

std::string imageNote() {
  return fmt::format("{} of {} throws drawn by the simulator's cameras, JPEG in, true calibration",
                     images().landed, kImageThrows);
}

Row nees() {
  return {"vision.nees", images().nees, "1", "a covariance that is right", 2, imageNote()};
}

Row landing() {
  return {"vision.landing_mm",     images().landing_rms * kMilli, "mm",
          "stated by the tracker", images().stated_rms * kMilli,  imageNote()};
}

/// Landings with a wrong calibration, against the net as the cameras see it and against where it is in the world.
Row landingOnNet() {
  constexpr int kThrows = 40;
  constexpr int kCalibrations = 3;  // of each throw
  constexpr double kPosition =
      0.01;  // [m], per axis, error of the pose that is given where the net is measured
  constexpr double kTilt = 0.02;       // [rad]
  constexpr double kInside95 = 5.991;  // 95 % quantile of a chi-square of two dimensions
  VisionSetup setup;
  setup.tracker.prior.calibration = {0.5e-3, 1e-3, 1e-3};
  double squares[2] = {}, stated = 0;
  int landed[2] = {}, inside[2] = {};
  for (int i = 0; i < kThrows; ++i) {
    const DrawnThrow drawn = drawThrow(setup.rig, setup.experiment, 3000 + i);
    for (int k = 0; k < kCalibrations; ++k) {
      for (const int measured : {0, 1}) {
        if (measured == 0 && k > 0)
          continue;  // the peer costs as much time
        setup.tracker.measure_target = measured == 1;
        const Knowledge wrong =
            wrongKnowledge(drawn, setup.experiment.target, setup.tracker.prior.calibration,
                           measured * kPosition, measured * kTilt, kCalibrations * i + k);
        const ImageTrial trial = imageTrial(drawn, setup.experiment, setup.tracker, wrong);
        if (!trial.report.measured || !trial.report.message.empty())
          continue;
        ++landed[measured];
        squares[measured] += trial.landing_error.squaredNorm();
        inside[measured] += trial.normalised < kInside95 ? 1 : 0;
        stated += measured * trial.report.landing.cov.trace();
      }
    }
  }
  const auto rms = [&](int measured) {
    return std::sqrt(squares[measured] / std::max(1, landed[measured])) * kMilli;
  };
  return {"vision.landing_net_mm",
          rms(1),
          "mm",
          "the net not measured but known",
          rms(0),
          fmt::format(
              "{} of {} landings with a calibration wrong by 0.5 mrad, 1 mm, 0.1 % and a net {} mm "
              "off; states {:.2f} mm; {:.3f} inside the stated 95 % ellipse ({:.3f} of the peer's)",
              landed[1], kThrows * kCalibrations, kPosition * kMilli,
              std::sqrt(stated / std::max(1, landed[1])) * kMilli,
              static_cast<double>(inside[1]) / std::max(1, landed[1]),
              static_cast<double>(inside[0]) / std::max(1, landed[0]))};
}

Row early() {
  return {"vision.predict_100ms_mm",
          images().early_rms * kMilli,
          "mm",
          "whole flight",
          images().landing_rms * kMilli,
          imageNote() + "; predicted 100 ms after the release"};
}

/// Throws among clutter.
struct ClutterResult {
  int throws = 0, landed = 0, images = 0, wrong = 0, expected = 0, detected = 0;
};

ClutterResult measureClutter() {
  constexpr int kThrows = 60;
  const VisionSetup setup;
  const Clutter clutter(setup.rig, setup.experiment);
  ClutterResult result;
  for (int i = 0; i < kThrows; ++i) {
    DrawnThrow drawn = drawThrow(setup.rig, setup.experiment, 5000 + i);
    clutter.addTo(drawn, i);
    const ImageTrial trial = imageTrial(drawn, setup.experiment, setup.tracker,
                                        {drawn.cameras, setup.experiment.target});
    ++result.throws;
    result.landed += trial.report.measured ? 1 : 0;
    result.images += trial.images;
    result.wrong += trial.wrong;
    result.expected += trial.expected;
    result.detected += trial.detected;
  }
  return result;
}

const ClutterResult& cluttered() {
  static const ClutterResult result = measureClutter();
  return result;
}

std::string clutterNote() {
  return fmt::format(
      "{} of {} throws measured, with the moving arm, a flickering lamp and a second ball that "
      "swings, rolls, is carried "
      "or flies the other way",
      cluttered().landed, cluttered().throws);
}

Row detection() {
  return {"vision.detection_rate",
          static_cast<double>(cluttered().detected) / cluttered().expected,
          "1",
          "none",
          {},
          fmt::format("{} images with the ball in free flight and nothing before it; {}",
                      cluttered().expected, clutterNote())};
}

Row falseAlarms() {
  return {"vision.false_per_frame",
          static_cast<double>(cluttered().wrong) / cluttered().images,
          "1",
          "none",
          {},
          fmt::format("{} of {} images in which something else was tracked; {}", cluttered().wrong,
                      cluttered().images, clutterNote())};
}

Row imageTime() {
  return {"vision.frame_p99_ms",
          images().image_p99 * kMilli,
          "ms",
          "none",
          {},
          "one image of 640x480 decoded and tracked, fit of the flight included"};
}

Row realTime() {
  const VisionSetup setup;
  return {"vision.real_time_factor",
          images().real_time,
          "1",
          "as fast as the cameras",
          1,
          fmt::format("{} cameras at {} Hz, one core", setup.rig.cameras.size(),
                      setup.rig.cameras.front().rate)};
}

Row latency() {
  const VisionSetup setup;
  const double exposure = setup.rig.cameras.front().exposure;
  return {"vision.latency_ms",
          (images().landing_p99 + exposure / 2) * kMilli,
          "ms",
          "time between two images",
          kMilli / setup.rig.cameras.front().rate,
          "p99 from the middle of the last exposure to the landing, LCM's way not included"};
}

}  // namespace

std::vector<Benchmark> visionBenchmarks() {
  return {{"vision.crb_ratio", cleanBound},
          {"vision.crb_ratio_dirty", dirtyBound},
          {"vision.nees", nees},
          {"vision.centre_bias_px", centreBias},
          {"vision.centre_rms_px", centreRms},
          {"vision.landing_mm", landing},
          {"vision.landing_net_mm", landingOnNet},
          {"vision.consistency", consistency},
          {"vision.detection_rate", detection},
          {"vision.false_per_frame", falseAlarms},
          {"vision.degraded_ratio", degraded},
          {"vision.predict_100ms_mm", early},
          {"vision.frame_p99_ms", imageTime},
          {"vision.real_time_factor", realTime},
          {"vision.latency_ms", latency}};
}

}  // namespace fastball::bench
