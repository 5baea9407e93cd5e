#include "launch/report/missing.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <functional>

namespace fastball::launch {
namespace {

constexpr int64_t kToleratedReversalUs = 10'000;  ///< of LCM's receive times, on a busy machine

/// Who says what. A robot and its cameras may bear any name.
struct Sender {
  std::string process;  ///< its name in HEARTBEAT; empty: must be in every log
  std::vector<std::string> channels;
};

const std::vector<Sender>& senders() {
  static const std::vector<Sender> all{
      {"",
       {"PLAN_REQUEST", "SCENE", "THROW_START", "ARM_STATE", "HAND_STATE", "LANDING", "HEARTBEAT"}},
      {"planner", {"SWING_PLAN"}},
      {"controller", {"ARM_COMMAND", "CONTROLLER_STATUS"}},
      {"hand_server", {"HAND_COMMAND", "RELEASE"}},
      {"sim_bullet", {"SIM_TRUTH"}},
      {"vision_tracker", {"CAMERA_INFO", "BALL_OBSERVATION", "BALL_TRACK"}},
      {"logger", {"LOGGER_STATUS"}}};
  return all;
}

void findChannels(const LoggedRun& run, Missing& missing) {
  for (const Sender& sender : senders()) {
    std::vector<std::string> absent;
    for (const std::string& channel : sender.channels) {
      if (run.summary->channels.count(channel) == 0)
        absent.push_back(channel);
    }
    if (absent.empty())
      continue;
    const std::string names = fmt::format("{}", fmt::join(absent, ", "));
    if (sender.process.empty() || tookPart(run, sender.process))
      missing.faults.push_back(fmt::format("The log holds no message on {}.", names));
    else
      missing.notes.push_back(
          fmt::format("No {} took part, so there is no {}.", sender.process, names));
  }
}

/// Of which throws something is missing that the log has of others.
void findInThrows(const LoggedRun& run,
                  const std::string& channel,
                  const std::string& what,
                  const std::function<bool(const LoggedThrow&)>& isThere,
                  Missing& missing) {
  if (run.summary->channels.count(channel) == 0)
    return;
  std::vector<int64_t> without;
  for (const auto& [number, thrown] : run.throws) {
    if (!isThere(thrown))
      without.push_back(number);
  }
  if (!without.empty())
    missing.faults.push_back(fmt::format("Throw {} has no {}.", numberWords(without), what));
}

void findInThrows(const LoggedRun& run, Missing& missing) {
  const auto find = [&](const char* channel, const char* what, const auto& isThere) {
    findInThrows(run, channel, what, isThere, missing);
  };
  using T = LoggedThrow;
  find("PLAN_REQUEST", "PLAN_REQUEST", [](const T& t) { return t.record.request.has_value(); });
  find("SWING_PLAN", "SWING_PLAN", [](const T& t) { return t.record.plan.has_value(); });
  find("THROW_START", "THROW_START", [](const T& t) { return t.record.start.has_value(); });
  find("ARM_STATE", "ARM_STATE", [](const T& t) { return !t.record.arm.empty(); });
  find("HAND_STATE", "HAND_STATE", [](const T& t) { return !t.record.hand.empty(); });
  find("RELEASE", "RELEASE of the command to let go",
       [](const T& t) { return t.record.commanded.has_value(); });
  find("RELEASE", "RELEASE of the ball's departure",
       [](const T& t) { return t.record.departed.has_value(); });
  find("BALL_TRACK", "BALL_TRACK", [](const T& t) { return !t.record.track.empty(); });
  find("LANDING", "LANDING", [](const T& t) { return t.record.landing.has_value(); });
  find("SIM_TRUTH", "end in SIM_TRUTH", [](const T& t) { return t.truth.finished; });
}

void findLosses(const LoggedRun& run, Missing& missing) {
  logger::LogSummary summary = *run.summary;
  for (auto& [name, channel] : summary.channels) {
    if (channel.missing > 0)
      missing.notes.push_back(fmt::format("{} of {} messages on {} are lost, by their numbers.",
                                          channel.missing, channel.missing + channel.messages,
                                          name));
    channel.missing = 0;
  }
  for (const std::string& fault : summary.faults(kToleratedReversalUs))
    missing.faults.push_back("Damage: " + fault + ".");
  if (run.record && run.record->messages > summary.messages)
    missing.faults.push_back(fmt::format("The run wrote {} messages, the log holds {} of them.",
                                         run.record->messages, summary.messages));
}

}  // namespace

Missing missingOf(const LoggedRun& run) {
  Missing missing;
  if (!run.summary) {
    missing.faults.push_back("The log holds no message: it is empty, or no LCM log.");
    return missing;
  }
  findLosses(run, missing);
  findChannels(run, missing);
  if (run.throws.empty())
    missing.faults.emplace_back("The log holds no throw.");
  findInThrows(run, missing);
  if (!run.record)
    missing.notes.push_back(
        fmt::format("There is no '{}': command line, seed and configuration are not recorded.",
                    logger::runRecordPath(run.path)));
  return missing;
}

bool tookPart(const LoggedRun& run, const std::string& process) {
  return run.processes.empty() ||
         std::any_of(run.processes.begin(), run.processes.end(),
                     [&](const LoggedProcess& p) { return p.last().name == process; });
}

std::string numberWords(const std::vector<int64_t>& numbers) {
  std::vector<std::string> spans;
  for (std::size_t i = 0; i < numbers.size();) {
    std::size_t end = i + 1;
    while (end < numbers.size() && numbers[end] == numbers[end - 1] + 1)
      ++end;
    if (end - i > 2) {
      spans.push_back(fmt::format("{} to {}", numbers[i], numbers[end - 1]));
      i = end;
    } else {
      spans.push_back(fmt::format("{}", numbers[i++]));
    }
  }
  if (spans.size() < 2)
    return spans.empty() ? "" : spans.front();
  const std::string last = spans.back();
  spans.pop_back();
  return fmt::format("{} and {}", fmt::join(spans, ", "), last);
}

}  // namespace fastball::launch
