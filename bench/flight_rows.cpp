#include "bench/flight_rows.h"

#include <fmt/format.h>

#include <algorithm>

#include "bench/flight_trials.h"
#include "bench/vision_setup.h"

namespace fastball::bench {
namespace {

constexpr int kFlights = 2000;   // the ratio's standard error is then 1.6 %
constexpr double kNoise = 0.03;  // [px], of a centre: what the drawn images show
constexpr double kMilli = 1e3;

FlightTrialResult fly(const VisionSetup& setup, const FlightTrialOptions& options) {
  std::vector<model::Camera> cameras;
  for (const sim_bullet::RigCamera& camera : setup.rig.cameras)
    cameras.push_back(camera.camera);
  return flightTrials(cameras, setup.rig.cameras.front().rate, setup.experiment, setup.tracker,
                      options);
}

Row boundRow(const std::string& id, double lost, double outliers, const std::string& note) {
  const VisionSetup setup;
  FlightTrialOptions options;
  options.throws = kFlights;
  options.sigma = kNoise;
  options.lost = lost;
  options.outliers = outliers;
  const FlightTrialResult whole = fly(setup, options);
  options.seen = 0.6;
  const FlightTrialResult part = fly(setup, options);
  const FlightTrialResult& worse = whole.ratio() > part.ratio() ? whole : part;
  return {
      id,
      worse.ratio(),
      "1",
      "landing error over the Cramer-Rao bound, the better of the two",
      std::min(whole.ratio(), part.ratio()),
      fmt::format(
          "{} throws, centres with {} px noise{}; whole flight {:.3f} mm, first 60 % {:.3f} mm; "
          "{} without a landing",
          2 * kFlights, kNoise, note, whole.rms * kMilli, part.rms * kMilli,
          whole.failures + part.failures)};
}

}  // namespace

Row cleanBound() {
  return boundRow("vision.crb_ratio", 0, 0, "");
}

Row dirtyBound() {
  return boundRow("vision.crb_ratio_dirty", 0.1, 0.05,
                  ", 10 % lost and 5 % outliers against the bound of all");
}

Row consistency() {
  VisionSetup setup;
  FlightTrialOptions options;
  options.throws = kFlights;
  options.sigma = kNoise;
  options.calibration = {0.5e-3, 1e-3, 1e-3};
  setup.tracker.prior.calibration = options.calibration;
  const FlightTrialResult result = fly(setup, options);
  return {"vision.consistency",
          result.inside,
          "1",
          "a covariance that is right",
          0.95,
          fmt::format("true landings inside the stated 95 % ellipse; calibration wrong by 0.5 "
                      "mrad, 1 mm, 0.1 %: "
                      "{:.2f} mm rms",
                      result.rms * kMilli)};
}

Row degraded() {
  const VisionSetup setup;
  FlightTrialOptions options;
  options.throws = kFlights;
  options.sigma = kNoise;
  const FlightTrialResult clean = fly(setup, options);
  options.lost = 0.2;
  const FlightTrialResult lost = fly(setup, options);
  options.lost = 0;
  options.hidden_from = 0.35;
  options.hidden_to = 0.65;
  const FlightTrialResult hidden = fly(setup, options);
  return {"vision.degraded_ratio",
          std::max(lost.rms, hidden.rms) / clean.rms,
          "1",
          "all images",
          1,
          fmt::format("20 % of the images lost {:.3f} mm, 30 % of the flight hidden {:.3f} mm; "
                      "NEES {:.2f}, {:.2f}",
                      lost.rms * kMilli, hidden.rms * kMilli, lost.nees, hidden.nees)};
}

}  // namespace fastball::bench
