#include "launch/network_run.h"

#include <fmt/format.h>
#include <poll.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "launch/clock_check.h"
#include "launch/experiment_node.h"
#include "launch/experiment_processes.h"
#include "launch/key_check.h"
#include "launch/loss_report.h"
#include "launch/processes.h"
#include "launch/rest_watch.h"
#include "launch/silence_watch.h"
#include "launch/stranger_check.h"
#include "launch/verdicts.h"
#include "messaging/heartbeat.h"
#include "messaging/lcm_endpoint.h"
#include "messaging/peer_watch.h"
#include "messaging/stop_signals.h"
#include "messaging/validation.h"

namespace fastball::launch {
namespace {

constexpr double kMicro = 1e6;
constexpr int64_t kWatchIntervalUs = 20000;
// For the arm to come to rest.
constexpr int64_t kRestUs = 2'000'000, kInterruptedRestUs = 300'000;
constexpr double kInterruptedGrace = 0.8;  // [s], twice: an interrupted run is over within 2 s
constexpr double kTruthTime = 5.0;  // [s], for the truth to arrive once the experiment is over
constexpr double kHeartbeatPeriod = 1.1;  // [s]

/// [s], between two HEARTBEATs.
double beat(double silence_limit) {
  return silence_limit > 0 ? silence_limit / messaging::kBeatsWithinLimit
                           : messaging::Heartbeat::kPeriod;
}

/// The run while it goes on: one loop that hears, acts and watches the processes.
class NetworkRun {
 public:
  NetworkRun(const RunSetup& setup, Progress& progress)
      : setup_(setup),
        commands_(experimentProcesses(setup)),
        peers_(namesOf(commands_)),
        progress_(progress),
        endpoint_(setup.options.lcm_url, setup.key, "experiment"),
        roster_(endpoint_),
        clocks_(endpoint_, clock_, roster_),
        silence_(endpoint_, clock_),
        experiment_(endpoint_, clock_, roster_, setup.settings),
        judge_(endpoint_),
        verdicts_(experiment_, judge_, setup.settings.target.radius, progress),
        rest_(endpoint_, clock_),
        losses_(endpoint_, roster_),
        heartbeat_(endpoint_,
                   clock_,
                   experiment_,
                   beat(setup.options.silence_limit),
                   endpoint_.keyId()) {
    if (setup.options.silence_limit > 0)
      watch_.emplace(endpoint_, clock_, experiment_.name(), setup.options.silence_limit);
  }

  void listenForOthers();
  /// So that nobody takes the end of this run for a cut cable.
  void sayLast() { heartbeat_.sayLast(); }
  void startProcesses();
  /// Finds the processes of a system.
  void joinSystem();
  void conduct();
  /// @return what went wrong in doing so, empty: nothing.
  std::string stopProcesses();
  /// Who has not been heard for half the time that an answer may take, as an addition to a sentence.
  std::string silence() const;

  const ExperimentNode& experiment() const { return experiment_; }
  const Verdicts& verdicts() const { return verdicts_; }

 private:
  void pump(bool act);
  void pumpFor(double seconds, bool act);
  void awaitProcesses(const std::vector<std::string>& names);
  /// Waits after an ESTOP until the arm rests.
  void awaitRest();
  void watch();
  void watchPeers();
  void checkClocks();
  void refuseStrangers() const;
  void refuseOtherKeys() const;

  const RunSetup& setup_;
  const std::vector<ProcessCommand> commands_;
  const std::vector<std::string> peers_;
  Progress& progress_;
  messaging::StopSignals signals_;
  messaging::SystemClock clock_;
  messaging::LcmEndpoint endpoint_;
  Roster roster_;
  ClockCheck clocks_;
  SilenceWatch silence_;
  std::optional<messaging::PeerWatch> watch_;  ///< with a silence limit
  ExperimentNode experiment_;
  Judge judge_;
  Verdicts verdicts_;
  RestWatch rest_;
  LossReport losses_;
  messaging::Heartbeat heartbeat_;
  Processes processes_;
  const StrangerCheck strangers_{roster_, processes_};
  int64_t next_watch_us_ = INT64_MIN;
  bool conducting_ = false;
};

void NetworkRun::pump(bool act) {
  const int64_t now = clock_.monotonicUs();
  const int64_t wake = std::min(now + kWatchIntervalUs, act ? experiment_.wakeUs() : INT64_MAX);
  std::array<pollfd, 2> waits = {pollfd{endpoint_.fileDescriptor(), POLLIN, 0},
                                 pollfd{signals_.fileDescriptor(), POLLIN, 0}};
  poll(waits.data(), waits.size(), static_cast<int>(std::max<int64_t>(0, wake - now + 999) / 1000));
  const int64_t woke = clock_.monotonicUs();
  endpoint_.drain();
  if (watch_)
    watchPeers();
  if (act)
    experiment_.step();
  heartbeat_.remark(endpoint_.refusals());
  heartbeat_.update(static_cast<double>(clock_.monotonicUs() - woke));
  verdicts_.update();
  if (woke >= next_watch_us_) {
    next_watch_us_ = woke + kWatchIntervalUs;
    watch();
  }
}

void NetworkRun::pumpFor(double seconds, bool act) {
  const int64_t end = clock_.monotonicUs() + std::llround(seconds * kMicro);
  while (clock_.monotonicUs() < end)
    pump(act);
}

void NetworkRun::watchPeers() {
  const std::vector<messaging::PeerNews> all = watch_->update();
  heartbeat_.setNote(watch_->silence());
  for (const messaging::PeerNews& news : all) {
    if (news.is_silent && conducting_)
      throw std::runtime_error(news.sentence + ": a link is cut, or they hang");
    progress_.line(news.sentence);
  }
}

void NetworkRun::watch() {
  if (signals_.received())
    throw std::runtime_error("interrupted");
  if (const auto ended = processes_.ended())
    throw std::runtime_error(*ended);
  const double timeout = setup_.settings.config.answer_timeout;
  const std::string silent = silence_.silentFor(timeout, peers_);
  if (!silent.empty())
    throw std::runtime_error(fmt::format("{} (run.answer_timeout {} s)", silent, timeout));
  refuseStrangers();
  refuseOtherKeys();
}

std::string NetworkRun::silence() const {
  const std::string silent = silence_.silentFor(setup_.settings.config.answer_timeout / 2, peers_);
  return silent.empty() ? "" : "; " + silent;
}

void NetworkRun::refuseStrangers() const {
  // On a system only one experiment at a time is a stranger to another; and once this run is on, a
  // second `fastball run` that is about to refuse is no harm.
  const auto names =
      setup_.on_system ? std::vector<std::string>{experiment_.name()} : processes_.names();
  if (const std::string fault = strangers_.fault(names, setup_.options.lcm_url); !fault.empty())
    throw std::runtime_error(fault);
}

void NetworkRun::refuseOtherKeys() const {
  if (const std::string fault = keyFault(roster_, peers_, endpoint_.keyId()); !fault.empty())
    throw std::runtime_error(fault);
}

void NetworkRun::listenForOthers() {
  progress_.status("listening for another run", clock_.monotonicUs());
  pumpFor(setup_.settings.config.listen_time, false);
}

void NetworkRun::startProcesses() {
  for (const ProcessCommand& command : commands_)
    processes_.start(command);
  awaitProcesses(processes_.names());
}

void NetworkRun::joinSystem() {
  awaitProcesses(peers_);
  // Everyone's newest; a few beats where one may be lost on the way.
  pumpFor(watch_ ? 3 * beat(setup_.options.silence_limit) : kHeartbeatPeriod, false);
  if (setup_.clock_limit > 0)
    checkClocks();
  int64_t before = 0;
  for (const std::string& name : peers_)
    before = std::max(before, roster_.newest(name)->plan_id);
  experiment_.continueAfter(before);
}

void NetworkRun::checkClocks() {
  while (!clocks_.update())
    pump(false);
  if (const std::string report = clocks_.report(); !report.empty())
    progress_.line(report);
  if (const std::string fault = clocks_.fault(setup_.clock_limit); !fault.empty())
    throw std::runtime_error(fault);
}

void NetworkRun::awaitProcesses(const std::vector<std::string>& names) {
  const double timeout = setup_.settings.config.start_timeout;
  const int64_t end = clock_.monotonicUs() + std::llround(timeout * kMicro);
  for (const std::string& name : names) {
    while (roster_.newest(name) == nullptr) {
      progress_.status("waiting for " + name, clock_.monotonicUs());
      pump(false);
      if (clock_.monotonicUs() < end)
        continue;
      throw std::runtime_error(
          fmt::format("{} did not say HEARTBEAT within {} s (run.start_timeout)\n{}", name, timeout,
                      processes_.lastOutput(name)));
    }
  }
}

void NetworkRun::awaitRest() {
  rest_.await(signals_.received() ? kInterruptedRestUs : kRestUs);
}

void NetworkRun::conduct() {
  conducting_ = true;
  try {
    while (!experiment_.finished()) {
      pump(true);
      progress_.status(experiment_.progress(), clock_.monotonicUs());
    }
  } catch (const std::exception& e) {
    const std::string sentence = e.what();
    experiment_.stop(sentence.substr(0, sentence.find('\n')));
    awaitRest();
    throw;
  }
  if (!experiment_.error().empty())
    awaitRest();
  const int64_t end = clock_.monotonicUs() + std::llround(kTruthTime * kMicro);
  while (!verdicts_.complete()) {
    pump(true);
    if (clock_.monotonicUs() < end)
      continue;
    throw std::runtime_error(
        fmt::format("the simulator did not tell the truth of throw {} (SIM_TRUTH)",
                    verdicts_.throws().size() + 1));
  }
}

std::string NetworkRun::stopProcesses() {
  const double grace = signals_.received()
                           ? std::min(kInterruptedGrace, setup_.settings.config.stop_grace)
                           : setup_.settings.config.stop_grace;
  const std::vector<std::string> names = processes_.names();
  std::string fault;
  for (const std::string& name : processes_.stop(grace, kLogger)) {
    std::string sentence =
        fmt::format("{} did not end within {} s of SIGINT and was killed", name, grace);
    if (name == kLogger)
      fault = sentence += ": the log may lack its end";
    progress_.line(sentence);
  }
  endpoint_.drain();
  for (const std::string& sentence : losses_.sentences(names))
    progress_.line(sentence);
  return fault;
}

}  // namespace

void runOverNetwork(const RunSetup& setup, Progress& progress, RunResult& result) {
  NetworkRun run(setup, progress);
  try {
    if (setup.on_system) {
      run.joinSystem();
    } else {
      run.listenForOthers();
      run.startProcesses();
    }
    run.conduct();
    result.error = run.experiment().error();
    if (!result.error.empty())
      result.error += run.silence();
  } catch (const std::exception& e) {
    result.error = e.what();
  }
  run.sayLast();
  const std::string fault = run.stopProcesses();
  if (result.error.empty())
    result.error = fault;
  result.throws = run.verdicts().throws();
  result.throw_wall_s = run.experiment().throwWallTimes();
}

}  // namespace fastball::launch
