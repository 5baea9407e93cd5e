#include "vision_tracker/tracked_target.h"

#include "vision_tracker/ring_landing.h"
#include "vision_tracker/ring_measurement.h"

namespace fastball::vision_tracker {

TrackedTarget::TrackedTarget(const FlightPrior& prior, const RingPrior& ring, double blur)
    : prior_(prior), ring_prior_(ring), blur_(blur) {}

void TrackedTarget::give(const model::Target& target) {
  given_ = target;
  known_ = target;
  ring_.reset();
  note_.clear();
}

void TrackedTarget::measure(const std::vector<Eye>& eyes) {
  std::vector<const cv::Mat*> still;
  std::vector<model::Camera> cameras;
  for (const Eye& eye : eyes) {
    still.push_back(&eye.background().mean());
    cameras.push_back(eye.setup().camera);
  }
  const Ring nominal{given_.p_WTarget, given_.n_WTarget, given_.radius + ring_prior_.tube / 2};
  const RingMeasurement measured = measureRing(still, cameras, nominal, ring_prior_, blur_);
  ring_ = measured.estimate ? *measured.estimate : unseenRing(nominal, ring_prior_, cameras.size());
  known_ = ring_->ring.target(given_.radius);
  if (!measured.estimate)
    note_ = "the target was not measured but taken as given: " + measured.why_not;
}

std::optional<LandingEstimate> TrackedTarget::landing(const FlightEstimate& flight) const {
  if (ring_)
    return landingOf(flight, *ring_, given_.radius, prior_, ring_prior_);
  return landingOf(flight, known_, prior_.gravity);
}

}  // namespace fastball::vision_tracker
