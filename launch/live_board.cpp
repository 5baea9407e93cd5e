#include "launch/live_board.h"

#include <fmt/format.h>
#include <poll.h>

#include <algorithm>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <stdexcept>

#include "messaging/clock.h"
#include "messaging/image_channel.h"
#include "messaging/lcm_endpoint.h"
#include "messaging/stop_signals.h"
#include "vision_tracker/board_collector.h"
#include "vision_tracker/image_order.h"

namespace fastball::launch {
namespace {

constexpr int64_t kLookUs = 200'000;       // a hand that holds still does so for longer
constexpr int64_t kLaggardUs = 1'000'000;  // then the others are looked at without it
constexpr int64_t kSilenceUs = 10'000'000;
constexpr int64_t kProgressUs = 1'000'000;

/// The newest image of one camera.
struct Newest {
  image_t message;
  bool is_new = false;
  int64_t came_us = 0;  ///< monotonic
};

class Collection {
 public:
  explicit Collection(const LiveBoard& options)
      : options_(options),
        collector_(options.shape, options.channels),
        endpoint_(options.lcm_url),
        newest_(options.channels.size()) {
    for (std::size_t i = 0; i < newest_.size(); ++i) {
      newest_[i].came_us = clock_.monotonicUs();
      endpoint_.subscribe<image_t>(messaging::imageChannel(options_.channels[i].c_str()),
                                   [this, i](const image_t& m) {
                                     newest_[i] = {m, true, clock_.monotonicUs()};
                                   });
    }
  }

  std::vector<vision_tracker::CameraImages> run() {
    const messaging::StopSignals signals;
    fmt::print(
        "hold the board still for a moment in each place, tilted, near and far, in all parts of "
        "the "
        "images; Ctrl-C ends\n");
    std::fflush(stdout);
    while (!signals.received() && collector_.fewestViews() < options_.views) {
      pollfd waits[] = {{endpoint_.fileDescriptor(), POLLIN, 0},
                        {signals.fileDescriptor(), POLLIN, 0}};
      poll(waits, 2, static_cast<int>(kLookUs / 1000));
      endpoint_.drain();
      requireImages();
      if (isTimeToLook())
        look();
    }
    return collector_.images();
  }

 private:
  void requireImages() const {
    for (std::size_t i = 0; i < newest_.size(); ++i)
      if (clock_.monotonicUs() - newest_[i].came_us > kSilenceUs)
        throw std::runtime_error(fmt::format("no image on {} for {} s", options_.channels[i],
                                             static_cast<double>(kSilenceUs) * 1e-6));
  }

  bool isTimeToLook() const {
    const int64_t since = clock_.monotonicUs() - looked_us_;
    const bool all =
        std::all_of(newest_.begin(), newest_.end(), [](const Newest& n) { return n.is_new; });
    return since >= (all ? kLookUs : kLaggardUs);
  }

  cv::Mat take(Newest& newest) {
    if (!std::exchange(newest.is_new, false))
      return {};
    const image_t& m = newest.message;
    cv::Mat grey;
    const std::string fault =
        vision_tracker::decode({0, m.utime, m.seq, m.width, m.height, m.row_stride,
                                m.pixelformat == image_t::MJPEG, m.data},
                               {m.width, m.height}, grey);
    return fault.empty() ? grey.clone() : cv::Mat();
  }

  void look() {
    std::vector<cv::Mat> greys;
    for (Newest& newest : newest_)
      greys.push_back(take(newest));
    looked_us_ = clock_.monotonicUs();
    const bool taken = collector_.look(greys);
    if (taken)
      keep();
    if (taken || looked_us_ - said_us_ > kProgressUs)
      sayProgress();
  }

  /// On disk, so that no work is lost when the calibration is refused.
  void keep() const {
    for (const vision_tracker::CameraImages& camera : collector_.images()) {
      if (camera.images.empty())
        continue;
      const auto folder = std::filesystem::path(options_.folder) / camera.name;
      std::error_code error;
      std::filesystem::create_directories(folder, error);
      const vision_tracker::BoardImage& image = camera.images.back();
      const std::string path = (folder / image.name).string();
      if (!std::filesystem::exists(path) && !cv::imwrite(path, image.grey))
        throw std::invalid_argument(fmt::format("{}: cannot be written", path));
    }
  }

  void sayProgress() {
    said_us_ = looked_us_;
    std::string line;
    const std::vector<std::size_t> corners = collector_.corners();
    for (std::size_t i = 0; i < corners.size(); ++i)
      line += fmt::format("{}{}: {} of {} views, {} corners now", i == 0 ? "" : "; ",
                          options_.channels[i], collector_.images()[i].images.size(),
                          options_.views, corners[i]);
    fmt::print("{}\n", line);
    std::fflush(stdout);
  }

  const LiveBoard& options_;
  messaging::SystemClock clock_;
  vision_tracker::BoardCollector collector_;
  messaging::LcmEndpoint endpoint_;
  std::vector<Newest> newest_;
  int64_t looked_us_ = 0;
  int64_t said_us_ = 0;
};

}  // namespace

std::vector<vision_tracker::CameraImages> collectViews(const LiveBoard& options) {
  return Collection(options).run();
}

}  // namespace fastball::launch
