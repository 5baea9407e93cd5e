#include "camera/node.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

#include "camera/camera_info.h"
#include "camera/capture.h"
#include "camera/jpeg.h"
#include "messaging/image_channel.h"

namespace fastball::camera {
namespace {

constexpr int64_t kLookUs = 1000;  // how often a source is asked for its next image
constexpr int64_t kInfoPeriodUs = 1'000'000;
constexpr int64_t kRequestDelayUs = 100'000;  // the tracker shall have heard the request too
constexpr int kMostAtOnce = 16;               // images, before the process looks around
constexpr int64_t kSilenceUs = 5'000'000;     // devices take a second or two to begin

std::string smallLetters(std::string name) {
  std::transform(name.begin(), name.end(), name.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return name;
}

class CameraNode : public messaging::Node {
 public:
  CameraNode(messaging::Endpoint& endpoint,
             const messaging::Clock& clock,
             const CameraOptions& options,
             const OpenSource& open)
      : endpoint_(endpoint),
        clock_(clock),
        options_(options),
        open_(open),
        name_(smallLetters(options.channel)),
        jpeg_(options.quality, messaging::kDatagramBytes),
        infos_(endpoint, messaging::kCameraInfo) {
    if (options.on_request)
      endpoint.subscribe<plan_request_t>(messaging::kPlanRequest,
                                         [this](const plan_request_t& m) { takeRequest(m); });
    if (!options.calibration)
      spdlog::warn(
          "{}: without --calib there is no CAMERA_INFO, and the tracker uses no images "
          "of a camera that it does not know",
          options.channel);
    reopen();
  }

  std::string name() const override { return name_; }

  void step() override {
    fetch();
    beginVideo();
    for (int i = 0; i < kMostAtOnce && next_ && clock_.monotonicUs() >= dueUs(); ++i) {
      say(*next_);
      next_.reset();
      fetch();
    }
    if (!next_ && capture_->ended())
      end();
    if (clock_.monotonicUs() >= next_info_us_)
      sayInfo();
  }

  int64_t wakeUs() const override {
    if (next_)
      return std::min(next_info_us_, dueUs());
    return std::min(next_info_us_, capture_->ended() ? INT64_MAX : clock_.monotonicUs() + kLookUs);
  }

  messaging::NodeState state() const override {
    std::string detail = note_;
    if (dropped() > 0)
      detail += fmt::format("{}images came faster than they could be said, some were dropped",
                            detail.empty() ? "" : "; ");
    return {word(), detail, request_id_};
  }

  bool finished() const override { return ended_; }

  void shutDown() override {
    spdlog::info("{} images said on {}{}", said_, options_.channel,
                 dropped() > 0 ? fmt::format(", {} dropped", dropped()) : "");
  }

 private:
  const char* word() const {
    if (ended_)
      return "ended";
    if (!size_known_)
      return "opening";
    return waiting_ || next_frame_ == 0 ? "waiting" : "publishing";
  }

  int64_t dropped() const { return dropped_before_ + capture_->dropped(); }

  void reopen() {
    if (capture_)
      dropped_before_ += capture_->dropped();
    capture_ = std::make_unique<Capture>(
        open_, options_.video ? Capture::WhenFull::kWait : Capture::WhenFull::kDropOldest);
    next_.reset();
    waiting_ = options_.on_request;
    begun_ = false;
    next_frame_ = 0;
    last_image_us_ = clock_.monotonicUs();
  }

  /// A request is said again until it is answered: only a new one begins the video.
  void takeRequest(const plan_request_t& m) {
    if (m.request_id == request_id_)
      return;
    if (begun_)
      reopen();
    request_id_ = m.request_id;
    waiting_ = false;
  }

  /// Takes the source's next image, if there is one, and looks whether it can be used.
  void fetch() {
    if (next_)
      return;
    next_ = capture_->take();
    const int64_t now = clock_.monotonicUs();
    if (next_) {
      last_image_us_ = now;
      check(next_->pixels);
      return;
    }
    if (!capture_->ended() && now - last_image_us_ > kSilenceUs)
      throw std::runtime_error(fmt::format("{}: no image for {} s", options_.source,
                                           static_cast<double>(kSilenceUs) * 1e-6));
  }

  void check(const cv::Mat& pixels) {
    const auto fits = [&](const cv::Size& size) { return size == pixels.size(); };
    if (pixels.depth() != CV_8U || (pixels.channels() != 1 && pixels.channels() != 3))
      throw std::runtime_error(
          fmt::format("{}: its images have {} channels of {} bytes, not 1 or 3 of 1",
                      options_.source, pixels.channels(), pixels.elemSize1()));
    if (size_known_ && !fits(size_))
      throw std::runtime_error(fmt::format("{}: image {} has {} x {} pixels, the first had {} x {}",
                                           options_.source, next_->frame, pixels.cols, pixels.rows,
                                           size_.width, size_.height));
    if (size_known_)
      return;
    if (!options_.size.empty() && !fits(options_.size))
      throw std::invalid_argument(
          fmt::format("{}: its images have {} x {} pixels, --size says {} x {}", options_.source,
                      pixels.cols, pixels.rows, options_.size.width, options_.size.height));
    if (options_.calibration && !fits({options_.calibration->width, options_.calibration->height}))
      throw std::invalid_argument(
          fmt::format("{}: its images have {} x {} pixels, but the calibration is of a camera with "
                      "{} x {}",
                      options_.source, pixels.cols, pixels.rows, options_.calibration->width,
                      options_.calibration->height));
    rate_ = options_.rate > 0 ? options_.rate : capture_->rate();
    if (!(rate_ > 0) && (options_.video || options_.calibration))
      throw std::invalid_argument(
          fmt::format("{}: does not tell its rate: give --rate", options_.source));
    size_ = pixels.size();
    size_known_ = true;
    next_info_us_ = clock_.monotonicUs();
    sayInfo();
  }

  /// [us], since a video's first image.
  int64_t videoTime(int64_t frame, double speed) const {
    return std::llround(static_cast<double>(frame) * 1e6 / (rate_ * speed));
  }

  void beginVideo() {
    if (!options_.video || begun_ || waiting_ || !next_)
      return;
    const int64_t wall = clock_.wallUs();
    first_utime_ = options_.start_utime.value_or(options_.on_request ? 0 : wall);
    const int64_t delay =
        options_.on_request ? kRequestDelayUs : std::max<int64_t>(0, first_utime_ - wall);
    begin_us_ = clock_.monotonicUs() + delay;
    begun_ = true;
  }

  /// When the image that waits is due, monotonic.
  int64_t dueUs() const {
    if (!options_.video)
      return INT64_MIN;
    return begun_ ? begin_us_ + videoTime(next_->frame, options_.speed) : INT64_MAX;
  }

  void say(const SourceImage& image) {
    cv::Mat pixels = image.pixels;
    if (options_.gray && pixels.channels() == 3)
      cv::cvtColor(pixels, pixels, cv::COLOR_BGR2GRAY);
    image_t m{};
    m.utime = options_.video ? first_utime_ + videoTime(image.frame, 1)
                             : image.utime.value_or(clock_.wallUs());
    m.seq = image.frame;
    m.width = pixels.cols;
    m.height = pixels.rows;
    m.row_stride = pixels.cols;
    m.pixelformat = image_t::MJPEG;
    m.data = jpeg_.encode(pixels);
    m.size = static_cast<int32_t>(m.data.size());
    if (jpeg_.quality() < options_.quality && note_.empty()) {
      note_ = fmt::format("JPEG quality is {}, not {}, so that images fit messages of {} bytes",
                          jpeg_.quality(), options_.quality, messaging::kDatagramBytes);
      spdlog::warn("{}: {}", options_.channel, note_);
    }
    if (endpoint_.publish(messaging::imageChannel(options_.channel.c_str()), m))
      ++said_;
    next_frame_ = image.frame + 1;
  }

  void sayInfo() {
    next_info_us_ = INT64_MAX;
    if (!options_.calibration || !size_known_)
      return;
    camera_info_t m = infoMessage(*options_.calibration);
    m.utime = options_.video && begun_ ? first_utime_ + videoTime(next_frame_, 1) : clock_.wallUs();
    m.channel = options_.channel;
    m.rate = rate_;
    m.exposure = options_.exposure;
    infos_.publish(m);
    next_info_us_ = clock_.monotonicUs() + kInfoPeriodUs;
  }

  /// A new request begins a video again.
  void end() {
    if (!size_known_)
      throw std::invalid_argument(fmt::format("{}: holds no image", options_.source));
    waiting_ = options_.on_request;
    ended_ = !options_.on_request;
  }

  messaging::Endpoint& endpoint_;
  const messaging::Clock& clock_;
  const CameraOptions options_;
  const OpenSource open_;
  const std::string name_;
  JpegEncoder jpeg_;
  messaging::Publisher<camera_info_t> infos_;

  std::unique_ptr<Capture> capture_;
  std::optional<SourceImage> next_;  ///< waits for its time
  bool size_known_ = false;          ///< an image has come
  cv::Size size_;                    ///< [px]
  double rate_ = 0;                  ///< [Hz]
  int64_t request_id_ = 0;
  bool waiting_ = false;     ///< for a request
  bool begun_ = false;       ///< the video's times are known
  int64_t begin_us_ = 0;     ///< monotonic, of its first image
  int64_t first_utime_ = 0;  ///< stamp of its first image
  int64_t next_frame_ = 0;
  int64_t last_image_us_ = 0;  ///< monotonic
  int64_t next_info_us_ = INT64_MAX;
  int64_t said_ = 0;
  int64_t dropped_before_ = 0;
  bool ended_ = false;
  std::string note_;
};

}  // namespace

std::unique_ptr<messaging::Node> makeNode(messaging::Endpoint& endpoint,
                                          const messaging::Clock& clock,
                                          const CameraOptions& options,
                                          const OpenSource& open) {
  return std::make_unique<CameraNode>(endpoint, clock, options, open);
}

}  // namespace fastball::camera
