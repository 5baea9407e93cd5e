#include "vision_tracker/size_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "model/ball_flight.h"
#include "vision_tracker/sphere_outline.h"

namespace fastball::vision_tracker {
namespace {

constexpr int64_t kEarliestUs = 333'000;  // before the landing
constexpr std::size_t kLeast = 8;

}  // namespace

void SizeCheck::add(int camera, int64_t utime, const BallFit& fit) {
  seen_.push_back({utime, camera, fit.radius});
}

std::optional<double> SizeCheck::excess(const LandingEstimate& landing,
                                        const std::vector<model::Camera>& cameras,
                                        const FlightPrior& prior) const {
  std::vector<std::vector<double>> ratios(cameras.size());
  for (const Seen& seen : seen_) {
    if (seen.utime >= landing.utime || seen.utime < landing.utime - kEarliestUs)
      continue;
    const double time = static_cast<double>(seen.utime - landing.utime) * 1e-6;
    // So near the landing, drag by the prior is good to a thousandth of the distance.
    const model::BallState ball = model::fly(landing.state, time, prior.drag, prior.gravity);
    const auto index = static_cast<std::size_t>(seen.camera);
    if (cameras[index].toCamera(ball.p_WBall).z() > prior.ball_radius)
      ratios[index].push_back(
          seen.radius /
          sphereOutline(cameras[index], ball.p_WBall, prior.ball_radius).meanRadius());
  }
  std::optional<double> worst;
  for (std::vector<double>& of_camera : ratios) {
    if (of_camera.size() < kLeast)
      continue;
    const auto middle = of_camera.begin() + static_cast<std::ptrdiff_t>(of_camera.size() / 2);
    std::nth_element(of_camera.begin(), middle, of_camera.end());
    if (!worst || std::abs(*middle - 1) > std::abs(*worst))
      worst = *middle - 1;
  }
  return worst;
}

std::string SizeCheck::fault(const LandingEstimate& landing,
                             const std::vector<model::Camera>& cameras,
                             const FlightPrior& prior) const {
  const auto off = excess(landing, cameras, prior);
  if (!off || std::abs(*off) < kTolerance)
    return "";
  return fmt::format(
      "the ball looks {:.0f} % {} than one of {} m radius at its distance, so a calibration or the "
      "radius is wrong",
      100 * std::abs(*off), *off > 0 ? "larger" : "smaller", prior.ball_radius);
}

}  // namespace fastball::vision_tracker
