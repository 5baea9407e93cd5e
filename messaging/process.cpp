#include "messaging/process.h"

#include <fmt/format.h>
#include <poll.h>
#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <limits>
#include <optional>
#include <stdexcept>

#include "messaging/clock_survey.h"
#include "messaging/heartbeat.h"
#include "messaging/peer_watch.h"
#include "messaging/stop_signals.h"
#include "messaging/version.h"

namespace fastball::messaging {
namespace {

/// Waits until a message or a signal has come, or `until_us`.
void waitUntil(int64_t until_us, const Clock& clock, int message_fd, int signal_fd) {
  // Looks around once a second in any case, as the heartbeat does.
  const int64_t wait_us = std::clamp<int64_t>(until_us - clock.monotonicUs(), 0, 1'000'000);
  const timespec timeout{wait_us / 1'000'000, (wait_us % 1'000'000) * 1000};
  pollfd waits[] = {{message_fd, POLLIN, 0}, {signal_fd, POLLIN, 0}};
  if (ppoll(waits, 2, &timeout, nullptr) < 0 && errno != EINTR) {
    throw std::runtime_error(fmt::format("cannot wait for messages: {}", std::strerror(errno)));
  }
  if ((waits[0].revents & (POLLERR | POLLNVAL)) != 0) {
    throw std::runtime_error("LCM's file descriptor has closed");
  }
}

int64_t deadlineUs(const Clock& clock, double duration_s) {
  if (duration_s <= 0)
    return INT64_MAX;
  const double limit_s = 1e9;
  return clock.monotonicUs() + static_cast<int64_t>(std::min(duration_s, limit_s) * 1e6);
}

/// Tells who has fallen silent and who is back. Without a limit there is nobody to tell of.
class Watch {
 public:
  Watch(Node& node, LcmEndpoint& endpoint, const Clock& clock, double limit) : node_(node) {
    if (limit > 0)
      peers_.emplace(endpoint, clock, node.name(), limit);
  }
  void update(Heartbeat& heartbeat) {
    if (!peers_)
      return;
    const std::vector<PeerNews> all = peers_->update();
    heartbeat.setNote(peers_->silence());
    for (const PeerNews& news : all) {
      spdlog::warn("{}", news.sentence);
      if (news.is_silent)
        node_.onSilence(news.names, news.sentence);
    }
  }
  int64_t wakeUs() const { return peers_ ? peers_->wakeUs() : INT64_MAX; }

 private:
  Node& node_;
  std::optional<PeerWatch> peers_;
};

void loop(Node& node,
          LcmEndpoint& endpoint,
          const Clock& clock,
          double duration_s,
          Heartbeat& heartbeat,
          Watch& watch,
          const StopSignals& signals) {
  const int64_t deadline_us = deadlineUs(clock, duration_s);
  while (true) {
    const int64_t start_us = clock.monotonicUs();
    endpoint.drain();
    watch.update(heartbeat);
    node.step();
    heartbeat.remark(endpoint.refusals());
    heartbeat.update(static_cast<double>(clock.monotonicUs() - start_us));
    if (node.finished() || signals.received() || clock.monotonicUs() >= deadline_us)
      return;
    const int64_t until_us =
        std::min({node.wakeUs(), heartbeat.wakeUs(), watch.wakeUs(), deadline_us});
    waitUntil(until_us, clock, endpoint.fileDescriptor(), signals.fileDescriptor());
  }
}

/// Standard error belongs to the log, so that standard output stays what the program prints.
void logToStandardError(const std::string& name, bool verbose) {
  spdlog::set_default_logger(
      std::make_shared<spdlog::logger>(name, std::make_shared<spdlog::sinks::stderr_sink_mt>()));
  spdlog::set_pattern("%n: %l: %v");
  spdlog::set_level(verbose ? spdlog::level::debug : spdlog::level::info);
}

/// A trailer has room for "vision-tracker".
std::string withoutPrefix(const std::string& name) {
  const std::string prefix = "fastball-";
  return name.rfind(prefix, 0) == 0 ? name.substr(prefix.size()) : name;
}

int runProcess(const std::string& name, const ProcessOptions& options, const MakeNode& make_node) {
  logToStandardError(name, options.verbose);
  std::signal(SIGPIPE, SIG_IGN);
  // From here on a signal ends the process in order, also while its parts are being built.
  const StopSignals signals;
  LcmEndpoint endpoint(options.lcm_url, keyOf(options.key), withoutPrefix(name));
  fmt::print("{} {} on {}\n", name, version(), endpoint.url());
  std::fflush(stdout);
  const SystemClock clock;
  const auto node = make_node(endpoint, clock, options);
  return runOverLcm(*node, endpoint, clock, options.duration_s, options.silence_limit);
}

}  // namespace

std::shared_ptr<const CommandKey> keyOf(const std::string& path) {
  return path.empty() ? nullptr : std::make_shared<const CommandKey>(CommandKey::read(path));
}

int runOverLcm(Node& node,
               LcmEndpoint& endpoint,
               const Clock& clock,
               double duration_s,
               double silence_limit) {
  const StopSignals signals;
  const double period = silence_limit > 0 ? silence_limit / kBeatsWithinLimit : Heartbeat::kPeriod;
  Heartbeat heartbeat(endpoint, clock, node, period, endpoint.keyId());
  Watch watch(node, endpoint, clock, silence_limit);
  const ClockAnswer answer(endpoint, clock, node.name());
  try {
    loop(node, endpoint, clock, duration_s, heartbeat, watch, signals);
  } catch (const std::exception& error) {
    heartbeat.sayLast(error.what());
    node.shutDown();
    throw;
  }
  node.shutDown();
  heartbeat.sayLast();
  const bool failed = node.finished() && node.state().state == "failed";
  if (failed)
    spdlog::error("{}", node.state().detail);
  return failed ? kExitFailed : kExitDone;
}

int processMain(int argc,
                char** argv,
                const std::string& name,
                const std::string& description,
                const MakeNode& make_node,
                const AddFlags& add_flags) {
  ProcessOptions options;
  options.lcm_url = defaultLcmUrl();
  CLI::App app(description, name);
  app.set_version_flag("--version", std::string(version()));
  app.add_option("--lcm-url", options.lcm_url,
                 "LCM network; default: $FASTBALL_LCM_URL, else $LCM_DEFAULT_URL, else " +
                     std::string(kDefaultLcmUrl))
      ->option_text("URL");
  app.add_option("--config", options.config, "Experiment file; default: that of the experiment")
      ->check(CLI::ExistingFile)
      ->option_text("FILE");
  app.add_option("--key", options.key, kKeyHelp)->option_text("FILE");
  app.add_flag("--realtime", options.realtime, "Pace by the wall clock instead of in lockstep");
  app.add_option("--duration", options.duration_s,
                 "End after this time; 0: run until SIGINT or SIGTERM")
      ->check(CLI::Range(0.0, 1e9))
      ->option_text("SECONDS");
  app.add_option(
         "--silence-limit", options.silence_limit,
         "For processes on several machines: how soon a silent one is noticed; HEARTBEAT is "
         "said five times as often; default: $FASTBALL_SILENCE_LIMIT, else 0: never")
      ->envname("FASTBALL_SILENCE_LIMIT")
      ->check(CLI::Range(0.0, 3600.0))
      ->option_text("SECONDS");
  app.add_flag("-v,--verbose", options.verbose, "Say more on standard error");
  app.footer("Exit status: 0 done, 1 failed, 2 wrong usage or bad input file.");
  try {
    if (add_flags)
      add_flags(app);
    app.parse(argc, argv);
    return runProcess(name, options, make_node);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kExitDone : kExitUsage;
  } catch (const std::invalid_argument& error) {
    fmt::print(stderr, "{}: {}\n", name, error.what());
    return kExitUsage;
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}: {}\n", name, error.what());
    return kExitFailed;
  }
}

}  // namespace fastball::messaging
