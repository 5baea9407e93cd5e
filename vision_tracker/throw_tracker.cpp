#include "vision_tracker/throw_tracker.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "vision_tracker/flight_fit.h"

namespace fastball::vision_tracker {
namespace {

constexpr double kClear = 1.2;  // ball radii before the target plane; nearer it may touch the ring
constexpr int kSureTrack = 40;  // observations that no arm imitates
constexpr int kLeastForLanding = 16;     // observations
constexpr int kMostMisses = 15;          // times
constexpr std::size_t kWayInterval = 8;  // observations, between two looks at it

}  // namespace

ThrowTracker::ThrowTracker(const TrackerOptions& options)
    : options_(options),
      target_(options.prior, options.ring, options.detector.blur),
      finder_(options.prior.ball_radius, options.prior.gravity, options.prior.clock_sigma) {
  cv::setNumThreads(0);  // the images are small and the other processes need the cores
}

void ThrowTracker::setCamera(int index, const CameraSetup& setup) {
  const auto i = static_cast<std::size_t>(index);
  if (i > eyes_.size())
    throw std::invalid_argument("cameras must be set one after another from 0");
  if (i < eyes_.size() && sameCamera(eyes_[i].setup(), setup))
    return;
  const Eye eye(setup, options_.detector);
  if (i == eyes_.size()) {
    eyes_.push_back(eye);
    cameras_.push_back(setup.camera);
  } else {
    eyes_[i] = eye;
    cameras_[i] = setup.camera;
  }
  begin(target_.given());
}

void ThrowTracker::begin(const model::Target& target) {
  target_.give(target);
  state_ = State::kWaiting;
  finder_.reset();
  for (Eye& eye : eyes_)
    eye.reset();
  moment_.clear();
  moment_utime_ = 0;
  seen_ = 0;
  known_ = 0;
  observations_.clear();
  followed_.reset();
  predicted_.reset();
  misses_ = 0;
  images_ = 0;
  lost_.clear();
  track_report_.reset();
  landing_report_.reset();
}

double ThrowTracker::distanceAt(int64_t utime, int camera) const {
  return target_.distance(expectedAt(utime, camera).p_WBall);
}

model::BallState ThrowTracker::expectedAt(int64_t utime, int camera) const {
  const FlightEstimate& flight = followed_->flight;
  const double duration = flight.sinceStart(utime, camera) - seconds(flight.utime, latest_utime_);
  return flight.onward(latest_, duration, options_.prior.gravity);
}

void ThrowTracker::takeFlight(const FreeFlight& followed) {
  followed_ = followed;
  latest_utime_ = observations_.back().utime;
  latest_ = followed.flight.at(latest_utime_, options_.prior.gravity);
  predicted_ = target_.landing(followed.flight);
}

void ThrowTracker::expectWay() {
  constexpr int kPieces = 8;
  const double left = predicted_ ? seconds(latest_utime_, predicted_->utime) : 0;
  std::vector<Eigen::Vector3d> places_W;
  for (int k = 0; k <= kPieces && left > 0; ++k)
    places_W.push_back(
        followed_->flight.onward(latest_, left * k / kPieces, options_.prior.gravity).p_WBall);
  for (Eye& eye : eyes_)
    eye.expectWay(places_W);
}

Sighting ThrowTracker::add(int camera, int64_t utime, const cv::Mat& image) {
  if (state_ == State::kLanded)
    return {};
  ++images_;
  if (seen_ != 0 && utime - moment_utime_ > kSameMoment) {
    closeMoment();
    if (state_ == State::kLanded)
      return {};
  }
  if (seen_ == 0) {
    moment_.clear();
    moment_utime_ = utime;
    known_ = observations_.size();
  }
  Sighting sighting;
  Eye& eye = eyes_[static_cast<std::size_t>(camera)];
  cv::Rect leave;
  if (eye.hasLearned()) {
    sighting = followed_ ? followIn(camera, utime, image) : searchIn(camera, utime, image);
    if (followed_)
      leave = eye.detector().area(expectedAt(utime, camera).p_WBall);
  }
  eye.learn(image, leave, followed_.has_value());
  seen_ |= 1U << camera;
  if (seen_ == (1U << eyes_.size()) - 1)
    closeMoment();
  return sighting;
}

Sighting ThrowTracker::searchIn(int camera, int64_t utime, const cv::Mat& image) {
  const Eye& eye = eyes_[static_cast<std::size_t>(camera)];
  moment_.push_back({camera, utime, eye.detector().search(image, eye.background())});
  const std::vector<BallFit>& fits = moment_.back().fits;
  return fits.empty() ? Sighting{} : Sighting{true, fits.front(), false, fits};
}

Sighting ThrowTracker::followIn(int camera, int64_t utime, const cv::Mat& image) {
  const Eye& eye = eyes_[static_cast<std::size_t>(camera)];
  const model::BallState expected = expectedAt(utime, camera);
  // A young track predicts badly, and so does one that has missed the ball.
  const double uncertainty = (followed_->flight.used < 24 ? 8.0 : 4.0) + 2.0 * misses_;
  const BallFit fit =
      eye.detector().at(image, eye.background(), expected.p_WBall, expected.v_WBall, uncertainty);
  if (!fit.converged)
    return {false, {}, true, {}};
  // Near the plane the ring may touch the ball: seen, but no longer a part of the free flight.
  if (target_.distance(expected.p_WBall) > kClear * options_.prior.ball_radius)
    observe(utime, camera, fit, expected.p_WBall);
  return {true, fit, true, {fit}};
}

void ThrowTracker::observe(int64_t utime,
                           int camera,
                           const BallFit& fit,
                           const Eigen::Vector3d& p_WBall) {
  const Eye& eye = eyes_[static_cast<std::size_t>(camera)];
  observations_.push_back(eye.observation(utime, camera, fit, p_WBall, options_.prior.ball_radius));
}

void ThrowTracker::closeMoment() {
  seen_ = 0;
  if (!followed_) {
    if (const auto found = finder_.add(moment_, cameras_))
      startTrack(*found);
    return;
  }
  if (observations_.size() > known_) {
    misses_ = 0;
    updateTrack();
  } else {
    ++misses_;
  }
  if (followed_ && passed(moment_utime_))
    land();
  else if (followed_ && misses_ > std::min(kMostMisses, 3 + followed_->flight.used / 8))
    loseTrack();
}

bool ThrowTracker::passed(int64_t utime) const {
  const auto period = static_cast<int64_t>(1e6 / eyes_.front().setup().rate);
  return predicted_ && utime >= predicted_->utime + period;
}

void ThrowTracker::startTrack(const FlightFinder::Found& found) {
  observations_.clear();
  for (const SpatialPoint& point : found.points)
    for (const PointView& view : point.views)
      observe(view.utime, view.camera, view.fit, point.p_W);
  // Free-running cameras see one after the other.
  std::stable_sort(observations_.begin(), observations_.end(),
                   [](const Observation& a, const Observation& b) { return a.utime < b.utime; });
  const auto flight =
      fitFlight(observations_, 0, cameras_, options_.prior, found.state, found.utime);
  misses_ = 0;
  if (!flight || !landingOf(*flight, target_.given(), options_.prior.gravity)) {
    observations_.clear();  // nothing that flies, or something that flies elsewhere
    return;
  }
  for (Eye& eye : eyes_)
    eye.expectWay({});
  if (options_.measure_target && !target_.wasSought())
    target_.measure(eyes_);
  takeFlight({*flight});
  state_ = State::kTracking;
  finder_.reset();
}

void ThrowTracker::updateTrack() {
  const auto followed = followFreeFlight(observations_, cameras_, options_.prior, *followed_);
  if (!followed)
    return;
  takeFlight(*followed);
  // The prediction of a young track may lead anywhere.
  if (followed_->flight.used >= kSureTrack &&
      (observations_.size() % kWayInterval == 0 || !eyes_.front().knowsWay()))
    expectWay();
  if (!predicted_)
    return;
  TrackReport report;
  report.utime = observations_.back().utime;
  report.observations = followed_->flight.used;
  report.state = latest_;
  report.drag = followed_->flight.drag;
  report.landing = *predicted_;
  report.clock = followed_->flight.clock;
  report.clock_sigma = followed_->flight.clock_sigma;
  track_report_ = report;
}

void ThrowTracker::loseTrack() {
  const int64_t last = observations_.back().utime;
  const bool sure = followed_->flight.used >= kSureTrack;
  const double gap = predicted_ ? static_cast<double>(predicted_->utime - last) * 1e-6 : 1e9;
  if (sure && gap <= options_.longest_gap)
    return;  // it is nearly there, and the flight says the rest
  lost_ = fmt::format("the ball was lost {:.3f} m before the target plane",
                      distanceAt(last, observations_.back().camera));
  if (sure) {
    giveUp(lost_);
    return;
  }
  // Too short to be sure that it was the ball: look for another.
  followed_.reset();
  predicted_.reset();
  observations_.clear();
  finder_.reset();
  misses_ = 0;
  state_ = State::kWaiting;
}

void ThrowTracker::land() {
  // The track's own idea of the distance was younger than the flight is now: choose the clear observations again.
  const auto end =
      std::remove_if(observations_.begin(), observations_.end(), [&](const Observation& o) {
        return distanceAt(o.utime, o.camera) <= kClear * options_.prior.ball_radius;
      });
  observations_.erase(end, observations_.end());
  const auto flight = fitFreeFlight(observations_, cameras_, options_.prior,
                                    followed_->flight.start, followed_->flight.utime, nullptr);
  const auto landing = flight ? target_.landing(*flight) : std::nullopt;
  if (!landing || flight->used < kLeastForLanding) {
    giveUp(fmt::format("only {} observations agree with a flight, {} are needed",
                       flight ? flight->used : 0, kLeastForLanding));
    return;
  }
  const double gap = static_cast<double>(landing->utime - observations_.back().utime) * 1e-6;
  if (gap > options_.longest_gap) {
    giveUp(
        fmt::format("the ball was last seen {:.3f} s before it crossed the target plane, at most "
                    "{} s are allowed",
                    gap, options_.longest_gap));
    return;
  }
  followed_ = FreeFlight{*flight};
  predicted_ = landing;
  landing_report_ =
      LandingReport{true,          target_.note(),     *landing, flight->used, flight->residual_px,
                    flight->clock, flight->clock_sigma};
  state_ = State::kLanded;
}

void ThrowTracker::giveUp(const std::string& why) {
  landing_report_ = LandingReport{};
  landing_report_->message = "not measured: " + why;
  state_ = State::kLanded;
}

void ThrowTracker::end() {
  if (state_ == State::kLanded)
    return;
  if (seen_ != 0)
    closeMoment();
  if (state_ == State::kLanded)
    return;
  if (images_ == 0)
    giveUp("no image came");
  else if (followed_)
    giveUp(fmt::format("the images ended when the ball was {:.3f} m before the target plane",
                       distanceAt(observations_.back().utime, observations_.back().camera)));
  else
    giveUp(lost_.empty()
               ? fmt::format("nothing that flies like the ball is in the {} images", images_)
               : lost_);
}

std::optional<TrackReport> ThrowTracker::takeTrack() {
  return std::exchange(track_report_, std::nullopt);
}

std::optional<LandingReport> ThrowTracker::takeLanding() {
  return std::exchange(landing_report_, std::nullopt);
}

}  // namespace fastball::vision_tracker
