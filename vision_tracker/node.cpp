#include "vision_tracker/node.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <array>
#include <cmath>

#include "config/experiment.h"
#include "messaging/validation.h"
#include "vision_tracker/config.h"
#include "vision_tracker/image_order.h"

namespace fastball::vision_tracker {
namespace {

constexpr int kCameras = 2;
const std::array<const messaging::Channel<image_t>*, kCameras> kImages = {&messaging::kCameraLeft,
                                                                          &messaging::kCameraRight};

void copyCovariance(const Eigen::Matrix2d& cov, double (&out)[3]) {
  out[0] = cov(0, 0);
  out[1] = cov(0, 1);
  out[2] = cov(1, 1);
}

void copyVector(const Eigen::Vector3d& v, double (&out)[3]) {
  Eigen::Map<Eigen::Vector3d>{out} = v;
}

/// Nothing if no camera can be like that.
std::optional<CameraSetup> cameraSetup(const camera_info_t& m) {
  using RowMajor = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
  CameraSetup setup;
  setup.rate = m.rate;
  setup.exposure = m.exposure;
  model::Camera& camera = setup.camera;
  camera.width = m.width;
  camera.height = m.height;
  camera.fx = m.K[0];
  camera.fy = m.K[4];
  camera.cx = m.K[2];
  camera.cy = m.K[5];
  camera.distortion = Eigen::Map<const Eigen::Matrix<double, 5, 1>>(m.D);
  camera.R_CW = Eigen::Map<const RowMajor>(m.R_CW);
  camera.p_CW = Eigen::Map<const Eigen::Vector3d>(m.p_CW);
  const bool rotation =
      (camera.R_CW * camera.R_CW.transpose() - Eigen::Matrix3d::Identity()).norm() < 1e-6 &&
      camera.R_CW.determinant() > 0;
  if (!(rotation && camera.fx > 0 && camera.fy > 0))
    return std::nullopt;
  return setup;
}

class TrackerNode : public messaging::Node {
 public:
  TrackerNode(messaging::Endpoint& endpoint,
              const messaging::Clock& clock,
              const TrackerConfig& config)
      : clock_(clock),
        silence_us_(std::llround(config.silence * 1e6)),
        tracker_(config.tracker),
        order_(kCameras),
        observations_(endpoint, messaging::kBallObservation),
        tracks_(endpoint, messaging::kBallTrack),
        landings_(endpoint, messaging::kLanding) {
    endpoint.subscribe<camera_info_t>(messaging::kCameraInfo,
                                      [this](const camera_info_t& m) { takeInfo(m); });
    endpoint.subscribe<plan_request_t>(messaging::kPlanRequest,
                                       [this](const plan_request_t& m) { takeRequest(m); });
    for (int camera = 0; camera < kCameras; ++camera)
      endpoint.subscribe<image_t>(*kImages[static_cast<std::size_t>(camera)],
                                  [this, camera](const image_t& m) { takeImage(camera, m); });
  }

  std::string name() const override { return "vision_tracker"; }

  void step() override {
    while (const auto image = order_.next()) {
      process(*image);
      last_image_us_ = clock_.monotonicUs();  // a backlog worked off is no silence
    }
    if (clock_.monotonicUs() < wakeUs())
      return;
    while (const auto image = order_.nextAnyway())
      process(*image);
    tracker_.end();
    sayLanding();
  }

  int64_t wakeUs() const override {
    const bool on =
        request_id_ != 0 && images_ > 0 && tracker_.state() != ThrowTracker::State::kLanded;
    return on ? last_image_us_ + silence_us_ : INT64_MAX;
  }

  messaging::NodeState state() const override { return {word(), notice_, request_id_}; }

 private:
  const char* word() const {
    if (request_id_ == 0)
      return "idle";
    switch (tracker_.state()) {
      case ThrowTracker::State::kTracking:
        return "tracking";
      case ThrowTracker::State::kLanded:
        return "landed";
      default:
        return "waiting";
    }
  }

  bool calibrated() const { return infos_[0] && infos_[1]; }

  void takeInfo(const camera_info_t& m) {
    for (std::size_t camera = 0; camera < kCameras; ++camera) {
      if (m.channel != kImages[camera]->name)
        continue;
      const std::optional<CameraSetup> setup = cameraSetup(m);
      if (!setup) {
        notice_ = fmt::format(
            "CAMERA_INFO of {} is no calibration: focal length {} px, or R_CW is no rotation",
            m.channel, m.K[0]);
        return;
      }
      infos_[camera] = setup;
    }
    if (!calibrated())
      return;
    for (int camera = 0; camera < kCameras; ++camera)
      tracker_.setCamera(camera, *infos_[static_cast<std::size_t>(camera)]);
  }

  void takeRequest(const plan_request_t& m) {
    if (m.request_id == request_id_)
      return;
    request_id_ = m.request_id;
    model::Target target;
    target.p_WTarget = Eigen::Map<const Eigen::Vector3d>(m.p_WTarget);
    target.n_WTarget = Eigen::Map<const Eigen::Vector3d>(m.n_WTarget).normalized();
    target.radius = m.target_radius;
    tracker_.begin(target);
    order_.reset();
    images_ = 0;
    refused_ = 0;
    notice_.clear();
  }

  void takeImage(int camera, const image_t& m) {
    last_image_us_ = clock_.monotonicUs();
    if (request_id_ == 0 || !calibrated()) {
      complain(camera, m.seq,
               request_id_ == 0 ? "came before a PLAN_REQUEST"
                                : "came before CAMERA_INFO of both cameras");
      return;
    }
    switch (order_.push({camera, m.utime, m.seq, m.width, m.height, m.row_stride,
                         m.pixelformat == image_t::MJPEG, m.data})) {
      case ImageOrder::Verdict::kAccepted:
        ++images_;
        break;
      case ImageOrder::Verdict::kRepeated:
        complain(camera, m.seq, "came twice");
        break;
      case ImageOrder::Verdict::kBackwards:
        complain(camera, m.seq, fmt::format("of {} us came after a later one", m.utime));
        break;
    }
  }

  /// The HEARTBEAT says the first fault of a throw, LANDING says how many there were.
  void complain(int camera, int64_t frame, const std::string& why) {
    ++refused_;
    if (notice_.empty())
      notice_ = fmt::format("{}: image {} {}", kImages[static_cast<std::size_t>(camera)]->name,
                            frame, why);
  }

  void process(const ReceivedImage& image) {
    const model::Camera& camera = infos_[static_cast<std::size_t>(image.camera)]->camera;
    Sighting sighting;
    if (tracker_.state() != ThrowTracker::State::kLanded) {
      const std::string fault = decode(image, {camera.width, camera.height}, decoded_);
      if (fault.empty())
        sighting = tracker_.add(image.camera, image.utime, decoded_);
      else
        complain(image.camera, image.frame, fault);
    }
    sayObservation(image, sighting);
    sayTrack();
    sayLanding();
  }

  void sayObservation(const ReceivedImage& image, const Sighting& sighting) {
    ball_observation_t m{};
    m.utime = image.utime;
    m.request_id = request_id_;
    m.channel = kImages[static_cast<std::size_t>(image.camera)]->name;
    m.frame = image.frame;
    if (sighting.found) {
      m.found = 1;
      m.u = sighting.fit.centre.x();
      m.v = sighting.fit.centre.y();
      m.radius = sighting.fit.radius;
      copyCovariance(sighting.fit.cov, m.cov_uv);
    }
    observations_.publish(m);
  }

  void sayTrack() {
    const auto report = tracker_.takeTrack();
    if (!report)
      return;
    ball_track_t m{};
    m.utime = report->utime;
    m.request_id = request_id_;
    m.n_observations = report->observations;
    copyVector(report->state.p_WBall, m.p_WBall);
    copyVector(report->state.v_WBall, m.v_WBall);
    m.drag = report->drag;
    Eigen::Map<Eigen::Vector2d>{m.landing} = report->landing.landing;
    copyCovariance(report->landing.cov, m.cov_landing);
    m.landing_utime = report->landing.utime;
    tracks_.publish(m);
  }

  void sayLanding() {
    const auto report = tracker_.takeLanding();
    if (!report)
      return;
    landing_t m{};
    m.request_id = request_id_;
    m.measured = report->measured ? 1 : 0;
    m.message = report->message;
    if (refused_ > 0) {
      m.message += fmt::format("{}{} images could not be used, the first: {}",
                               m.message.empty() ? "" : "; ", refused_, notice_);
      m.message = messaging::shortened(m.message);
    }
    if (report->measured) {
      m.utime = report->landing.utime;
      Eigen::Map<Eigen::Vector2d>{m.landing} = report->landing.landing;
      copyCovariance(report->landing.cov, m.cov_landing);
      copyVector(report->landing.state.v_WBall, m.v_WBall);
      m.n_observations = report->observations;
      m.residual_px = report->residual_px;
    }
    landings_.publish(m);
  }

  const messaging::Clock& clock_;
  int64_t silence_us_;
  ThrowTracker tracker_;
  ImageOrder order_;
  messaging::Publisher<ball_observation_t> observations_;
  messaging::Publisher<ball_track_t> tracks_;
  messaging::Publisher<landing_t> landings_;

  std::array<std::optional<CameraSetup>, kCameras> infos_;
  cv::Mat decoded_;
  int64_t request_id_ = 0;
  int64_t images_ = 0;         ///< accepted, of the throw
  int64_t refused_ = 0;        ///< images, of the throw
  int64_t last_image_us_ = 0;  ///< monotonic
  std::string notice_;
};

}  // namespace

std::unique_ptr<messaging::Node> makeNode(messaging::Endpoint& endpoint,
                                          const messaging::Clock& clock,
                                          const messaging::ProcessOptions& options) {
  return std::make_unique<TrackerNode>(endpoint, clock,
                                       readTracker(config::experimentPath(options.config)));
}

}  // namespace fastball::vision_tracker
