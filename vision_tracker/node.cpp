#include "vision_tracker/node.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <cmath>
#include <optional>
#include <stdexcept>

#include "config/experiment.h"
#include "messaging/image_channel.h"
#include "messaging/validation.h"
#include "vision_tracker/calibrations.h"
#include "vision_tracker/config.h"
#include "vision_tracker/image_order.h"
#include "vision_tracker/result_messages.h"
#include "vision_tracker/size_check.h"

namespace fastball::vision_tracker {
namespace {

// With these, no sum of times leaves its number type.
constexpr double kFarthest = 1000;  // [m], a target
constexpr int64_t kLatestUs = 1LL << 60;

class TrackerNode : public messaging::Node {
 public:
  TrackerNode(messaging::Endpoint& endpoint,
              const messaging::Clock& clock,
              const TrackerConfig& config)
      : endpoint_(endpoint),
        clock_(clock),
        names_(config.cameras),
        silence_us_(std::llround(config.silence * 1e6)),
        patience_us_(std::llround(config.longest_wait * 1e6)),
        prior_(config.tracker.prior),
        tracker_(config.tracker),
        order_(static_cast<int>(names_.size())),
        observations_(endpoint, messaging::kBallObservation),
        tracks_(endpoint, messaging::kBallTrack),
        landings_(endpoint, messaging::kLanding),
        calibrations_(names_),
        answers_(names_.size()) {
    endpoint.subscribe<camera_info_t>(messaging::kCameraInfo,
                                      [this](const camera_info_t& m) { takeInfo(m); });
    endpoint.subscribe<plan_request_t>(messaging::kPlanRequest,
                                       [this](const plan_request_t& m) { takeRequest(m); });
    endpoint.subscribe<scene_t>(messaging::kScene, [this](const scene_t& m) { takeScene(m); });
    for (std::size_t camera = 0; camera < names_.size(); ++camera)
      endpoint.subscribe<image_t>(messaging::imageChannel(names_[camera].c_str()),
                                  [this, camera](const image_t& m) { takeImage(camera, m); });
  }

  std::string name() const override { return "vision_tracker"; }

  void step() override {
    countMalformed();
    while (const auto image = order_.next()) {
      process(*image);
      last_image_us_ = clock_.monotonicUs();  // a backlog worked off is no silence
    }
    if (clock_.monotonicUs() >= wakeUs())
      endThrow();
  }

  int64_t wakeUs() const override {
    const bool on = request_id_ != 0 && images_ + refused_ > 0 && !over();
    return on ? last_image_us_ + silence_us_ : INT64_MAX;
  }

  messaging::NodeState state() const override {
    return {word(), notice_.empty() ? calibrations_.stranger() : notice_, request_id_};
  }

  void shutDown() override {
    if (calibrations_.strangers() > 0)
      spdlog::info("{}; {} such messages came", calibrations_.stranger(),
                   calibrations_.strangers());
  }

 private:
  bool over() const { return abandoned_ || tracker_.state() == ThrowTracker::State::kLanded; }

  const char* word() const {
    if (request_id_ == 0)
      return "idle";
    if (over())
      return "landed";
    return tracker_.state() == ThrowTracker::State::kTracking ? "tracking" : "waiting";
  }

  void takeInfo(const camera_info_t& m) {
    std::string fault;
    const Calibrations::News news = calibrations_.take(m, fault);
    if (notice_.empty())
      notice_ = fault;
    if (news == Calibrations::News::kNone)
      return;
    // What came by then was seen with another camera, or by it at another place.
    if (news == Calibrations::News::kChanged && images_ > 0 && !over())
      abandon(fmt::format("the calibration of {} changed during the throw", m.channel));
    if (images_ == 0)
      setCameras();
  }

  /// The calibrations hold for a whole throw.
  void setCameras() {
    if (!calibrations_.complete())
      return;
    for (std::size_t camera = 0; camera < names_.size(); ++camera)
      tracker_.setCamera(static_cast<int>(camera), calibrations_.of(camera));
  }

  void takeRequest(const plan_request_t& m) {
    if (m.request_id == request_id_)
      return;
    model::Target target;
    target.p_WTarget = Eigen::Map<const Eigen::Vector3d>(m.p_WTarget);
    target.n_WTarget = Eigen::Map<const Eigen::Vector3d>(m.n_WTarget).normalized();
    target.radius = m.target_radius;
    if (!(target.p_WTarget.norm() < kFarthest))
      throw std::invalid_argument(fmt::format("the target of request {} is {:.3g} m away",
                                              m.request_id, target.p_WTarget.norm()));
    if (request_id_ != 0 && images_ + refused_ > 0 && !over())
      endThrow();
    request_id_ = m.request_id;
    said_landing_.reset();
    images_ = 0;
    refused_ = 0;
    abandoned_ = false;
    malformed_ = malformed();
    notice_.clear();
    tracker_.begin(target);
    sizes_.reset();
    setCameras();
    order_.reset();
  }

  /// A scene that is said again after its landing: the LANDING was lost on the way.
  void takeScene(const scene_t& m) {
    if (said_landing_ && said_landing_->request_id == m.scene_id)
      landings_.publish(*said_landing_);
  }

  /// No image of the throw will come any more.
  void endThrow() {
    while (const auto image = order_.nextAnyway())
      process(*image);
    if (over())
      return;
    tracker_.end();
    sayLanding();
  }

  void takeImage(std::size_t camera, const image_t& m) {
    last_image_us_ = clock_.monotonicUs();
    if (request_id_ == 0 || !calibrations_.complete()) {
      complain(camera, m.seq,
               request_id_ == 0 ? "came before a PLAN_REQUEST"
                                : "came before CAMERA_INFO of " + calibrations_.missing());
      return;
    }
    if (m.utime > kLatestUs) {
      complain(camera, m.seq, fmt::format("has the time {} us, which is no time", m.utime));
      return;
    }
    switch (order_.push({static_cast<int>(camera), m.utime, m.seq, m.width, m.height, m.row_stride,
                         m.pixelformat == image_t::MJPEG, m.data})) {
      case ImageOrder::Verdict::kAccepted:
        if (++images_ == 1)
          first_utime_ = m.utime;
        break;
      case ImageOrder::Verdict::kRepeated:
        answerAgain(camera, m.utime);
        break;
      case ImageOrder::Verdict::kSameTime:
        complain(camera, m.seq, "has the time of the one before");
        break;
      case ImageOrder::Verdict::kBackwards:
        complain(camera, m.seq, fmt::format("of {} us came after a later one", m.utime));
        break;
    }
  }

  /// Whoever says an image again has not heard what was seen in it.
  void answerAgain(std::size_t camera, int64_t utime) {
    ball_observation_t& answer = answers_[camera];
    if (answer.request_id == request_id_ && answer.utime == utime)
      observations_.publish(answer);
  }

  /// Images whose message did not decode or broke its rule, ever.
  int64_t malformed() const {
    int64_t sum = 0;
    for (const std::string& name : names_)
      sum += endpoint_.counts().at(name).invalid;
    return sum;
  }

  /// They do not come to takeImage(), and are images of the throw all the same.
  void countMalformed() {
    const int64_t more = malformed() - malformed_;
    if (more == 0)
      return;
    malformed_ += more;
    refused_ += more;
    last_image_us_ = clock_.monotonicUs();
    if (notice_.empty())
      notice_ = "an image message was cut off, or of a pixel format other than GRAY and MJPEG";
  }

  /// The HEARTBEAT says the first fault of a throw, LANDING says how many there were.
  void complain(std::size_t camera, int64_t frame, const std::string& why) {
    ++refused_;
    if (notice_.empty())
      notice_ = fmt::format("{}: image {} {}", names_[camera], frame, why);
  }

  void process(const ReceivedImage& image) {
    const auto index = static_cast<std::size_t>(image.camera);
    Sighting sighting;
    if (!over()) {
      const model::Camera& camera = calibrations_.of(index).camera;
      const std::string fault = decode(image, {camera.width, camera.height}, decoded_);
      if (fault.empty())
        sighting = tracker_.add(image.camera, image.utime, decoded_);
      else
        complain(index, image.frame, fault);
      if (sighting.found)
        sizes_.add(image.camera, image.utime, sighting.fit);
    }
    sayObservation(image, sighting);
    sayTrack();
    sayLanding();
    if (!over() && image.utime - first_utime_ > patience_us_) {
      tracker_.end();
      sayLanding();
    }
  }

  void sayObservation(const ReceivedImage& image, const Sighting& sighting) {
    ball_observation_t m = observationMessage(sighting);
    m.utime = image.utime;
    m.request_id = request_id_;
    m.channel = names_[static_cast<std::size_t>(image.camera)];
    m.frame = image.frame;
    observations_.publish(m);
    answers_[static_cast<std::size_t>(image.camera)] = m;
  }

  void sayTrack() {
    const auto report = tracker_.takeTrack();
    if (!report)
      return;
    ball_track_t m = trackMessage(*report);
    m.request_id = request_id_;
    tracks_.publish(m);
  }

  /// Ends the throw without the tracker.
  void abandon(const std::string& why) {
    abandoned_ = true;
    LandingReport report;
    report.message = "not measured: " + why;
    sayLanding(report);
  }

  void sayLanding() {
    auto report = tracker_.takeLanding();
    if (!report)
      return;
    // A landing of a ball whose size is not that of its distance is none.
    const std::string fault =
        report->measured ? sizes_.fault(report->landing, calibrations_.cameras(), prior_) : "";
    if (!fault.empty()) {
      report.emplace();
      report->message = "not measured: " + fault;
    }
    sayLanding(*report);
  }

  void sayLanding(const LandingReport& report) {
    landing_t m = landingMessage(report);
    m.request_id = request_id_;
    if (refused_ > 0)
      m.message += fmt::format("{}{} images could not be used, the first: {}",
                               m.message.empty() ? "" : "; ", refused_, notice_);
    m.message = messaging::shortened(m.message);
    landings_.publish(m);
    said_landing_ = m;
  }

  messaging::Endpoint& endpoint_;
  const messaging::Clock& clock_;
  const std::vector<std::string> names_;  ///< channels of the cameras' images
  int64_t silence_us_, patience_us_;
  FlightPrior prior_;
  ThrowTracker tracker_;
  SizeCheck sizes_;
  ImageOrder order_;
  messaging::Publisher<ball_observation_t> observations_;
  messaging::Publisher<ball_track_t> tracks_;
  messaging::Publisher<landing_t> landings_;

  Calibrations calibrations_;
  cv::Mat decoded_;
  int64_t request_id_ = 0;
  bool abandoned_ = false;     ///< the throw
  int64_t images_ = 0;         ///< accepted, of the throw
  int64_t refused_ = 0;        ///< images, of the throw
  int64_t malformed_ = 0;      ///< of malformed(), counted already
  int64_t first_utime_ = 0;    ///< of the throw's first image
  int64_t last_image_us_ = 0;  ///< monotonic
  std::string notice_;
  std::vector<ball_observation_t> answers_;  ///< the newest to each camera
  std::optional<landing_t> said_landing_;
};

}  // namespace

std::unique_ptr<messaging::Node> makeNode(messaging::Endpoint& endpoint,
                                          const messaging::Clock& clock,
                                          const messaging::ProcessOptions& options) {
  return std::make_unique<TrackerNode>(endpoint, clock,
                                       readTracker(config::experimentPath(options.config)));
}

}  // namespace fastball::vision_tracker
