#include "launch/systems/supervisor.h"

#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <stdexcept>

#include "messaging/stop_signals.h"

namespace fastball::launch {
namespace {

using namespace std::chrono_literals;

constexpr auto kListenTime = 1100ms;  // HEARTBEAT comes once a second
constexpr double kSilentAfter = 3;  // [s] without a HEARTBEAT, where the file has no silence_limit
constexpr auto kBeatInterval = 500ms;  // the other end gives up after 3 s
constexpr auto kWriteInterval = 500ms;
constexpr auto kLinkTime = 2s;  // beyond the grace, for a stop to come and go over a link
constexpr int kTickMs = 20;
constexpr double kFirstDelay = 0.2, kLongestDelay = 10;  // [s], before a restart

}  // namespace

Supervisor::Supervisor(System system, StateFolder& folder, Listener listener)
    : system_(std::move(system)),
      folder_(folder),
      listener_(std::move(listener)),
      endpoint_(system_.lcm_url),
      roster_(endpoint_),
      clocks_(endpoint_, clock_, roster_) {
  for (const SystemProcess& process : system_.processes) {
    members_.emplace_back();
    members_.back().process = process;
  }
}

void Supervisor::run() {
  const messaging::StopSignals signals;
  refuseStrangers();
  writeState();
  try {
    for (Member& member : members_) {
      std::remove(folder_.outputPath(member.process.name).c_str());
      start(member);
    }
  } catch (const std::runtime_error& e) {
    failure_ = e.what();
    stopping_ = true;
  }
  while (!stopping_ || anyHeld()) {
    std::array<pollfd, 2> waits = {pollfd{endpoint_.fileDescriptor(), POLLIN, 0},
                                   pollfd{stopping_ ? -1 : signals.fileDescriptor(), POLLIN, 0}};
    poll(waits.data(), waits.size(), kTickMs);
    stopping_ = stopping_ || signals.received();
    endpoint_.drain();
    context_.restart();
    context_.poll();
    tick();
  }
  writeState();
  if (!failure_.empty())
    throw std::runtime_error(failure_);
}

void Supervisor::refuseStrangers() {
  const auto end = Steady::now() + kListenTime;
  while (Steady::now() < end) {
    pollfd wait{endpoint_.fileDescriptor(), POLLIN, 0};
    poll(&wait, 1, kTickMs);
    endpoint_.drain();
  }
  for (const heartbeat_t& heartbeat : roster_.everyone()) {
    const bool ours = std::any_of(members_.begin(), members_.end(), [&](const Member& member) {
      return member.process.name == heartbeat.name;
    });
    if (ours)
      throw std::runtime_error(fmt::format(
          "a {} is on {} already (process {} on {}): end it, or give this system a port of its own",
          heartbeat.name, system_.lcm_url, heartbeat.pid, heartbeat.host));
  }
}

void Supervisor::start(Member& member) {
  const std::string name = member.process.name;
  if (const heartbeat_t* heartbeat = roster_.newest(name)) {
    member.old_pid = heartbeat->pid;
    member.heartbeat_utime = heartbeat->utime;
  }
  try {
    member.held = std::make_unique<HeldProcess>(
        context_, holdCommand(member.process, system_.lcm_url), !member.process.host.isHere(),
        folder_.outputPath(name),
        [this, name](const std::string& line) { say(fmt::format("[{}] {}", name, line)); });
  } catch (const std::runtime_error& e) {
    throw std::runtime_error(fmt::format("{}: {}", name, e.what()));
  }
  enter(member, State::kStarting);
}

void Supervisor::enter(Member& member, State state) {
  member.state = state;
  member.since = Steady::now();
}

void Supervisor::tick() {
  const auto now = Steady::now();
  if (now >= next_beat_) {
    next_beat_ = now + kBeatInterval;
    for (Member& member : members_)
      if (member.held && member.state != State::kStopping)
        member.held->sayAlive();
  }
  for (Member& member : members_)
    look(member);
  if (stopping_)
    stopNext();
  const bool ready = std::all_of(members_.begin(), members_.end(), [](const Member& member) {
    return member.state == State::kReady;
  });
  if (ready && !announced_ && !stopping_ && checkClocks()) {
    announced_ = true;
    writeState();
    listener_.ready();
  }
  if (now >= next_write_) {
    next_write_ = now + kWriteInterval;
    writeState();
  }
}

bool Supervisor::checkClocks() {
  if (system_.clock_limit == 0)
    return true;
  if (!clocks_.update())
    return false;
  if (const std::string report = clocks_.report(); !report.empty())
    say(report);
  failure_ = clocks_.fault(system_.clock_limit);
  stopping_ = !failure_.empty();
  return !stopping_;
}

void Supervisor::look(Member& member) {
  const auto now = Steady::now();
  if (member.state == State::kWaiting && !stopping_ && now >= member.since) {
    start(member);
    return;
  }
  if (!member.held)
    return;
  if (!member.held->running()) {
    context_.poll();  // its last words
    ended(member);
    return;
  }
  hear(member);
  const SystemProcess& process = member.process;
  if (member.state == State::kStarting && process.ready_when == ReadyWhen::kStarted)
    enter(member, State::kReady);
  if (member.state == State::kStarting &&
      now - member.since > std::chrono::duration<double>(process.ready_timeout)) {
    member.note = fmt::format("did not say HEARTBEAT within {} s", process.ready_timeout);
    if (announced_)
      member.held->kill();
    else
      failBeforeReady(member, member.note);
  }
  if (member.state == State::kReady && process.ready_when == ReadyWhen::kHeartbeat &&
      now - member.heard > std::chrono::duration<double>(silentAfter(member))) {
    say(fmt::format("{} on {} has said no HEARTBEAT for {} s", process.name, process.host.name,
                    silentAfter(member)));
    enter(member, State::kSilent);
  }
}

double Supervisor::silentAfter(const Member& member) const {
  const heartbeat_t* heartbeat = roster_.newest(member.process.name);
  const bool plans = heartbeat != nullptr && heartbeat->state == "planning";
  return system_.silence_limit > 0 && !plans ? system_.silence_limit : kSilentAfter;
}

void Supervisor::hear(Member& member) {
  const heartbeat_t* heartbeat = roster_.newest(member.process.name);
  if (heartbeat == nullptr || heartbeat->utime == member.heartbeat_utime ||
      (member.state == State::kStarting && heartbeat->pid == member.old_pid))
    return;
  member.heartbeat_utime = heartbeat->utime;
  member.heard = Steady::now();
  if (member.state == State::kSilent)
    say(fmt::format("{} on {} is heard again", member.process.name, member.process.host.name));
  if (member.state == State::kStarting || member.state == State::kSilent)
    enter(member, State::kReady);
}

void Supervisor::ended(Member& member) {
  const SystemProcess& process = member.process;
  const bool stopped = member.state == State::kStopping;
  const bool well = member.held->endedWell();
  member.note = member.held->ending();
  if (!stopped && !announced_ && !stopping_) {
    failBeforeReady(member, member.note);
  }
  if (!stopped && !stopping_)
    say(fmt::format("{} on {}: {}", process.name, process.host.name, member.note));
  member.held.reset();
  if (stopped || stopping_ || well || process.restart == Restart::kNever ||
      member.restarts >= process.most_restarts) {
    enter(member, State::kEnded);
    return;
  }
  const double delay = std::min(kLongestDelay, kFirstDelay * (1 << std::min(member.restarts, 10)));
  ++member.restarts;
  say(fmt::format("{}: restart {} of {} in {} s", process.name, member.restarts,
                  process.most_restarts, delay));
  enter(member, State::kWaiting);
  member.since +=
      std::chrono::duration_cast<Steady::duration>(std::chrono::duration<double>(delay));
}

void Supervisor::failBeforeReady(const Member& member, const std::string& what) {
  stopping_ = true;
  if (!failure_.empty())
    return;
  failure_ = fmt::format("{} on {}: {}", member.process.name, member.process.host.name, what);
  for (const std::string& line : member.held->lastLines())
    failure_ += fmt::format("\n[{}] {}", member.process.name, line);
}

bool Supervisor::anyHeld() const {
  return std::any_of(members_.begin(), members_.end(),
                     [](const Member& member) { return member.held != nullptr; });
}

/// One after the other, the last of the file first: its logger, named first, hears the others' last words.
void Supervisor::stopNext() {
  const auto last = std::find_if(members_.rbegin(), members_.rend(),
                                 [](const Member& member) { return member.held != nullptr; });
  if (last == members_.rend())
    return;
  const auto now = Steady::now();
  const std::chrono::duration<double> patience =
      std::chrono::duration<double>(last->process.grace) + kLinkTime;
  if (last->state != State::kStopping) {
    last->held->letGo();
    enter(*last, State::kStopping);
  } else if (now - last->since > patience) {
    last->held->kill();
  }
}

void Supervisor::writeState() const {
  static const std::array<const char*, 6> kWords = {"starting",   "ready", "silent",
                                                    "restarting", "ended", "stopping"};
  nlohmann::json processes = nlohmann::json::array();
  const auto now = Steady::now();
  for (const Member& member : members_) {
    nlohmann::json entry = {{"name", member.process.name},
                            {"host", member.process.host.name},
                            {"state", kWords[static_cast<std::size_t>(member.state)]},
                            {"restarts", member.restarts},
                            {"note", member.note},
                            {"output", folder_.outputPath(member.process.name)}};
    const heartbeat_t* heartbeat = roster_.newest(member.process.name);
    if (heartbeat != nullptr && member.held) {
      entry["pid"] = heartbeat->pid;
      entry["says"] = heartbeat->state;
      entry["detail"] = heartbeat->detail;
      entry["heartbeat_age_s"] = std::chrono::duration<double>(now - member.heard).count();
    }
    processes.push_back(entry);
  }
  folder_.write({{"launcher", getpid()},
                 {"system", system_.path},
                 {"lcm_url", endpoint_.url()},
                 {"ready", announced_},
                 {"processes", processes}});
}

}  // namespace fastball::launch
