#include "logger/node.h"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <chrono>
#include <ctime>
#include <thread>

#include "logger/channel_filter.h"
#include "logger/run_record.h"
#include "logger/sequence_gaps.h"
#include "messaging/wire_lengths.h"

namespace fastball::logger {
namespace {

constexpr int64_t kStatusPeriodUs = 1'000'000;
/// How often it looks whether the log is still whole.
constexpr int64_t kWatchPeriodUs = 100'000;
/// So long without a drop, and dropping has ended: a slow disk drops now and then.
constexpr int64_t kDropsEndUs = 2'000'000;
/// At its end it looks so often, a millisecond apart, for the last messages.
constexpr int kLastLooks = 500;

std::string timeOfDay(int64_t utime) {
  const std::time_t seconds = utime / 1'000'000;
  std::tm local{};
  localtime_r(&seconds, &local);
  return fmt::format("{:%H:%M:%S}.{:03d}", local, utime / 1000 % 1000);
}

class LoggerNode : public messaging::Node {
 public:
  LoggerNode(messaging::LcmEndpoint& endpoint,
             const messaging::Clock& clock,
             const LoggerOptions& options)
      : endpoint_(endpoint),
        clock_(clock),
        log_path_(options.recorder.path),
        filter_(options.channels, options.excluded),
        gaps_(types_),
        recorder_(options.recorder),
        status_publisher_(endpoint, messaging::kLoggerStatus),
        next_watch_us_(clock.monotonicUs()),
        next_status_us_(clock.monotonicUs()) {
    endpoint.subscribeRaw(".*", [this](const std::string& channel, const void* data,
                                       std::size_t size, int64_t utime) {
      if (channel == messaging::kLoggerStatus.name)
        hearOwn(data, size);
      if (channel == messaging::kSelfTestChannel || !filter_.wants(channel))
        return;
      missing_ += gaps_.missingBefore(channel, data, size);
      recorder_.add(channel, {static_cast<const char*>(data), size}, utime);
    });
  }

  std::string name() const override { return "logger"; }

  void step() override {
    const int64_t now = clock_.monotonicUs();
    if (now >= next_watch_us_) {
      watch();
      next_watch_us_ = now + kWatchPeriodUs;
    }
    if (now >= next_status_us_) {
      sayStatus();
      next_status_us_ = now + kStatusPeriodUs;
    }
  }

  int64_t wakeUs() const override { return std::min(next_watch_us_, next_status_us_); }

  messaging::NodeState state() const override {
    if (dropping_)
      return {"dropping", failure_.empty() ? "the disk is too slow" : failure_, 0};
    return failure_.empty() ? messaging::NodeState{"logging", log_path_, 0}
                            : messaging::NodeState{"waiting", failure_, 0};
  }

  void shutDown() override {
    sayStatus();
    // LCM hands over what arrives in its order, but on a busy machine not at once: with this status, all said before it is there.
    for (int look = 0; look < kLastLooks && own_status_us_ != said_status_us_; ++look) {
      if (endpoint_.drain() == 0)
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    recorder_.stop();
    watch();
    addRecordingToRunRecord(log_path_, recorder_, missing_);
    if (const int64_t dropped = recorder_.queue().droppedMessages(); dropped > 0)
      spdlog::error("{} messages were dropped: {}", dropped, droppedInWords());
  }

 private:
  /// Says when the log ceases to be whole and when it goes on.
  void watch() {
    const auto status = recorder_.status();
    const int64_t dropped = recorder_.queue().droppedMessages();
    if (status.failure.empty() != failure_.empty()) {
      if (failure_.empty())
        spdlog::error("{}; messages wait in memory until there is room", status.failure);
      else
        spdlog::warn("writing to '{}' goes on", status.files.back());
    }
    failure_ = status.failure;
    const int64_t now_us = clock_.monotonicUs();
    if (dropped > dropped_) {
      last_drop_us_ = now_us;
      if (!dropping_)
        spdlog::error("dropping messages: {} MB wait for the disk",
                      recorder_.queue().bytes() / 1'000'000);
      dropping_ = true;
    } else if (dropping_ && now_us - last_drop_us_ > kDropsEndUs) {
      spdlog::warn("no more messages are dropped; so far {}", droppedInWords());
      dropping_ = false;
    }
    dropped_ = dropped;
  }

  void hearOwn(const void* data, std::size_t size) {
    const int bytes = static_cast<int>(size);
    logger_status_t status{};
    if (messaging::lengthsFit<logger_status_t>(data, bytes) &&
        status.decode(data, 0, bytes) == bytes && status.utime == said_status_us_)
      own_status_us_ = status.utime;
  }

  std::string droppedInWords() const {
    std::string words;
    for (const auto& [channel, dropped] : recorder_.queue().dropped())
      words += fmt::format("{}{} {} from {} to {}", words.empty() ? "" : ", ", dropped.messages,
                           channel, timeOfDay(dropped.first_utime), timeOfDay(dropped.last_utime));
    return words;
  }

  void sayStatus() {
    const auto written = recorder_.status();
    const int64_t dropped = recorder_.queue().droppedMessages();
    logger_status_t status{};
    status.utime = said_status_us_ = clock_.wallUs();
    status.path = written.files.back();
    status.messages = written.messages;
    status.bytes = written.bytes;
    status.lost = missing_ + dropped;
    status.message = written.failure;
    if (dropped > 0)
      status.message =
          messaging::shortened(fmt::format("{}{}dropped {}", written.failure,
                                           written.failure.empty() ? "" : "; ", droppedInWords()));
    status_publisher_.publish(status);
  }

  messaging::LcmEndpoint& endpoint_;
  const messaging::Clock& clock_;
  const std::string log_path_;
  ChannelFilter filter_;
  const messaging::TypeLibrary types_;
  SequenceGaps gaps_;
  Recorder recorder_;
  messaging::Publisher<logger_status_t> status_publisher_;
  int64_t next_watch_us_;
  int64_t next_status_us_;
  int64_t said_status_us_ = 0, own_status_us_ = 0;  ///< utime of the last status said, and heard
  int64_t missing_ = 0;
  int64_t dropped_ = 0;
  int64_t last_drop_us_ = 0;
  bool dropping_ = false;
  std::string failure_;
};

}  // namespace

std::unique_ptr<messaging::Node> makeNode(messaging::LcmEndpoint& endpoint,
                                          const messaging::Clock& clock,
                                          const LoggerOptions& options) {
  return std::make_unique<LoggerNode>(endpoint, clock, options);
}

}  // namespace fastball::logger
