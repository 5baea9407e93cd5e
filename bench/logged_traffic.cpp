#include "bench/logged_traffic.h"

#include <fmt/format.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <boost/process/args.hpp>
#include <boost/process/child.hpp>
#include <boost/process/exe.hpp>
#include <boost/process/io.hpp>
#include <boost/process/search_path.hpp>
#include <chrono>
#include <filesystem>
#include <memory>
#include <stdexcept>

#include "logger/log_reader.h"
#include "logger/run_record.h"

namespace fastball::bench {
namespace {

namespace bp = boost::process;
namespace fs = std::filesystem;
using Steady = std::chrono::steady_clock;
using namespace std::chrono_literals;

constexpr auto kStartTimeout = 10s;
/// For what is still on its way when all is said.
constexpr auto kGrace = 2s;

double secondsSince(Steady::time_point start) {
  return std::chrono::duration<double>(Steady::now() - start).count();
}

std::string logPath(const char* name) {
  return (fs::temp_directory_path() / fmt::format("fastball-bench-{}-{}.lcmlog", getpid(), name))
      .string();
}

/// How many of these messages are not in the log.
int64_t missingIn(const std::string& log, std::map<std::string, int64_t> sent) {
  logger::LogReader reader(log);
  for (logger::LogEntry entry; reader.next(entry);) {
    const auto channel = sent.find(entry.channel);
    if (channel != sent.end())
      --channel->second;
  }
  int64_t missing = 0;
  for (const auto& [channel, count] : sent)
    missing += count;
  return missing;
}

/// A logger while it runs.
class RunningLogger {
 public:
  explicit RunningLogger(LoggerCommand command)
      : command_(std::move(command)),
        child_(bp::exe = command_.program,
               bp::args = command_.arguments,
               bp::std_out > bp::null,
               bp::std_err > bp::null) {}
  ~RunningLogger() {
    end();
    std::error_code ignored;
    fs::remove(command_.log, ignored);
    fs::remove(logger::runRecordPath(command_.log), ignored);
  }
  RunningLogger(const RunningLogger&) = delete;
  RunningLogger& operator=(const RunningLogger&) = delete;

  bool logsSomething() {
    std::error_code error;
    if (!child_.running())
      throw std::runtime_error(fmt::format("{} does not run", command_.program));
    return fs::file_size(command_.log, error) > 0 && !error;
  }
  void end() {
    if (!child_.running())
      return;
    kill(child_.id(), SIGINT);
    child_.wait();
  }
  const std::string& log() const { return command_.log; }

 private:
  LoggerCommand command_;
  bp::child child_;
};

void awaitStart(RunningLogger& logger, messaging::LcmEndpoint& endpoint) {
  const auto start = Steady::now();
  while (!logger.logsSomething()) {
    if (Steady::now() - start > kStartTimeout)
      throw std::runtime_error(fmt::format("no message gets into {}", logger.log()));
    endpoint.publishBytes("START", "start", 5);
    std::this_thread::sleep_for(20ms);
  }
}

}  // namespace

std::map<std::string, int64_t> sayStreams(messaging::LcmEndpoint& endpoint,
                                          const std::vector<Stream>& streams,
                                          double seconds,
                                          double& took) {
  std::map<std::string, int64_t> sent;
  std::vector<int64_t> bursts(streams.size(), 0);
  const auto start = Steady::now();
  for (;;) {
    // Of which stream the next burst is due first.
    const auto due = [&](std::size_t i) {
      return static_cast<double>(bursts[i]) / streams[i].rate;
    };
    std::size_t next = 0;
    for (std::size_t i = 1; i < streams.size(); ++i)
      next = due(i) < due(next) ? i : next;
    if (due(next) >= seconds)
      break;
    std::this_thread::sleep_until(start + std::chrono::duration_cast<Steady::duration>(
                                              std::chrono::duration<double>(due(next))));
    const Stream& stream = streams[next];
    const std::vector<char> data(stream.bytes, 'x');
    for (int i = 0; i < stream.burst; ++i)
      sent[stream.channel] +=
          endpoint.publishBytes(stream.channel, data.data(), data.size()) ? 1 : 0;
    ++bursts[next];
  }
  took = secondsSince(start);
  return sent;
}

BusyLoops::BusyLoops(int count) {
  for (int i = 0; i < count; ++i)
    threads_.emplace_back([this] {
      while (!end_) {
      }
    });
}

BusyLoops::~BusyLoops() {
  end_ = true;
  for (std::thread& thread : threads_)
    thread.join();
}

LoggerCommand ourLogger(const std::string& url) {
  const fs::path folder = fs::read_symlink("/proc/self/exe").parent_path();
  const std::string log = logPath("ours");
  return {(folder / "fastball-logger").string(), {"--log", log, "--lcm-url", url}, log};
}

LoggerCommand stockLogger(const std::string& url) {
  const std::string log = logPath("stock");
  return {bp::search_path("lcm-logger").string(), {"-q", "-f", "--lcm-url=" + url, log}, log};
}

std::vector<int64_t> lostBy(const std::vector<LoggerCommand>& loggers,
                            const std::string& url,
                            const Say& say) {
  messaging::LcmEndpoint endpoint(url);
  std::vector<std::unique_ptr<RunningLogger>> running;
  for (const LoggerCommand& logger : loggers)
    running.push_back(std::make_unique<RunningLogger>(logger));
  for (const auto& logger : running)
    awaitStart(*logger, endpoint);
  const auto sent = say(endpoint);
  std::this_thread::sleep_for(kGrace);
  std::vector<int64_t> lost;
  for (const auto& logger : running) {
    logger->end();
    lost.push_back(missingIn(logger->log(), sent));
  }
  return lost;
}

}  // namespace fastball::bench
