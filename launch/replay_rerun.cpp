#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <functional>
#include <stdexcept>

#include "config/experiment.h"
#include "launch/processes.h"
#include "launch/replay.h"
#include "launch/roster.h"
#include "logger/log_reader.h"

namespace fastball::launch {
namespace {

/// Images that may be on their way to the tracker: enough to keep it busy, few enough for any receive buffer.
constexpr int64_t kImagesAhead = 16;
constexpr double kAnswerTimeout = 30;  ///< [s] wall time
constexpr const char* kTracker = "vision_tracker";

/// A URL that no other run uses: LCM tells runs apart by port.
std::string privateUrl() {
  return fmt::format("udpm://239.255.76.67:{}?ttl=0", 20000 + getpid() % 20000);
}

/// One tracker process, fed from a log.
class TrackerRerun {
 public:
  explicit TrackerRerun(const std::string& config_path)
      : cameras_(config::processSection(config_path, "tracker").texts("cameras")),
        endpoint_(privateUrl()),
        roster_(endpoint_) {
    endpoint_.subscribe<ball_observation_t>(messaging::kBallObservation,
                                            [this](const ball_observation_t&) { ++answered_; });
    endpoint_.subscribe<landing_t>(messaging::kLanding,
                                   [this](const landing_t& m) { landings_.push_back(m); });
    processes_.start({kTracker,
                      programFolder() + "/fastball-vision-tracker",
                      {"--lcm-url", endpoint_.url(), "--config", config_path}});
    waitUntil([this] { return roster_.newest(kTracker) != nullptr; }, "start");
  }

  void feed(const logger::LogEntry& entry) {
    const bool is_image =
        std::find(cameras_.begin(), cameras_.end(), entry.channel) != cameras_.end();
    if (is_image || entry.channel == messaging::kCameraInfo.name ||
        entry.channel == messaging::kPlanRequest.name)
      endpoint_.publishBytes(entry.channel, entry.data.data(), entry.data.size());
    if (is_image) {
      ++sent_;
      waitUntil([this] { return sent_ - answered_ <= kImagesAhead; }, "answer the images");
    }
    landing_t recorded{};
    if (entry.channel == messaging::kLanding.name && entry.decode(recorded))
      compare(recorded);
  }

  std::vector<RerunLanding> results;

 private:
  void compare(const landing_t& recorded) {
    const std::size_t number = results.size();
    waitUntil([this, number] { return landings_.size() > number; }, "say LANDING");
    RerunLanding result{recorded, landings_[number], false};
    result.equal = encoded(result.recorded) == encoded(result.rerun);
    results.push_back(result);
  }

  static std::vector<char> encoded(landing_t landing) {
    landing.seq = 0;
    std::vector<char> bytes(static_cast<std::size_t>(landing.getEncodedSize()));
    landing.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
    return bytes;
  }

  void waitUntil(const std::function<bool()>& condition, const char* what) {
    const auto deadline =
        std::chrono::steady_clock::now() + std::chrono::duration<double>(kAnswerTimeout);
    while (endpoint_.drain(), !condition()) {
      if (const auto sentence = processes_.ended())
        throw std::runtime_error(*sentence + "\n" + processes_.lastOutput(kTracker));
      if (std::chrono::steady_clock::now() > deadline)
        throw std::runtime_error(
            fmt::format("the tracker did not {} within {} s", what, kAnswerTimeout));
      pollfd waiting{endpoint_.fileDescriptor(), POLLIN, 0};
      poll(&waiting, 1, 50);
    }
  }

  std::vector<std::string> cameras_;  ///< channels of the images that the tracker uses
  messaging::LcmEndpoint endpoint_;
  Roster roster_;
  Processes processes_;
  std::vector<landing_t> landings_;
  int64_t sent_ = 0;
  int64_t answered_ = 0;
};

std::string point(const landing_t& landing) {
  return landing.measured ? fmt::format("({:+.2f}, {:+.2f}) mm", 1e3 * landing.landing[0],
                                        1e3 * landing.landing[1])
                          : "not measured";
}

}  // namespace

std::vector<RerunLanding> rerunTracker(const std::string& log_path,
                                       const std::string& config_path) {
  TrackerRerun rerun(config_path);
  logger::readLog(log_path, [&](const logger::LogEntry& entry) { rerun.feed(entry); });
  if (rerun.results.empty())
    throw std::invalid_argument(fmt::format("'{}' holds no LANDING to compare with", log_path));
  return std::move(rerun.results);
}

std::string rerunLine(const RerunLanding& landing) {
  return fmt::format("throw {}: recorded {}, now {}: {}", landing.recorded.request_id,
                     point(landing.recorded), point(landing.rerun),
                     landing.equal ? "equal" : "DIFFERENT");
}

}  // namespace fastball::launch
