#include "logger/node.h"

#include "logger/log_writer.h"

namespace fastball::logger {
namespace {

constexpr int64_t kFlushPeriodUs = 100'000;
constexpr int64_t kStatusPeriodUs = 1'000'000;
/// LCM talks to itself on this channel when it starts.
constexpr const char* kSelfTest = "LCM_SELF_TEST";

class LoggerNode : public messaging::Node {
 public:
  LoggerNode(messaging::LcmEndpoint& endpoint,
             const messaging::Clock& clock,
             const std::string& log_path)
      : endpoint_(endpoint),
        clock_(clock),
        writer_(log_path),
        status_publisher_(endpoint, messaging::kLoggerStatus),
        next_flush_us_(clock.monotonicUs()),
        next_status_us_(clock.monotonicUs()) {
    endpoint.subscribeRaw(".*", [this](const std::string& channel, const void* data,
                                       std::size_t size, int64_t utime) {
      if (channel != kSelfTest)
        writer_.write(channel, data, size, utime);
    });
  }

  std::string name() const override { return "logger"; }

  void step() override {
    const int64_t now = clock_.monotonicUs();
    if (now >= next_flush_us_) {
      writer_.flush();
      next_flush_us_ = now + kFlushPeriodUs;
    }
    if (now >= next_status_us_) {
      sayStatus();
      next_status_us_ = now + kStatusPeriodUs;
    }
  }

  int64_t wakeUs() const override { return std::min(next_flush_us_, next_status_us_); }

  messaging::NodeState state() const override {
    if (!writer_.failure().empty())
      return {"failed", writer_.failure(), 0};
    return {"logging", writer_.path(), 0};
  }

  void shutDown() override {
    sayStatus();
    while (endpoint_.drain() > 0) {  // what has arrived, the status above included
    }
    writer_.flush();
  }

 private:
  void sayStatus() {
    logger_status_t status{};
    status.utime = clock_.wallUs();
    status.path = writer_.path();
    status.messages = writer_.messages();
    status.bytes = writer_.bytes();
    status.lost = writer_.lost();
    status.message = writer_.failure();
    status_publisher_.publish(status);
  }

  messaging::LcmEndpoint& endpoint_;
  const messaging::Clock& clock_;
  LogWriter writer_;
  messaging::Publisher<logger_status_t> status_publisher_;
  int64_t next_flush_us_;
  int64_t next_status_us_;
};

}  // namespace

std::unique_ptr<messaging::Node> makeNode(messaging::LcmEndpoint& endpoint,
                                          const messaging::Clock& clock,
                                          const std::string& log_path) {
  return std::make_unique<LoggerNode>(endpoint, clock, log_path);
}

}  // namespace fastball::logger
