#include "launch/view/missing.h"

#include <fmt/format.h>

#include <algorithm>

namespace fastball::view {
namespace {

/// [us] HEARTBEAT comes once a second.
constexpr int64_t kSilence = 3'000'000;
/// Messages that make it sure that the others should have come as well: half a second of states.
constexpr int64_t kEnoughStates = 500;

bool anyPicture(const Timeline& timeline) {
  return !timeline.pictures().empty();
}

std::string invalidWords(const Timeline& timeline) {
  std::string words;
  for (const auto& [channel, count] : timeline.counts()) {
    if (count.invalid > 0)
      words += fmt::format("{}{} of {}", words.empty() ? "" : ", ", count.invalid, channel);
  }
  return words;
}

/// `where`: "The log has no", "Heard no".
std::vector<std::string> absent(const Timeline& timeline,
                                const std::string& where,
                                bool states,
                                bool flown,
                                bool landed) {
  std::vector<std::string> sentences;
  const auto require = [&](bool due, bool there, const char* what, const char* consequence) {
    if (due && !there)
      sentences.push_back(fmt::format("{} {}: {}.", where, what, consequence));
  };
  const auto any = [&timeline](const char* channel) { return timeline.taken(channel) > 0; };
  require(states, any("ARM_STATE"), "ARM_STATE", "the arm and its plots are not shown");
  require(states, any("HAND_STATE"), "HAND_STATE",
          "hand, ball in the hand and forces are not shown");
  require(states, any("HEARTBEAT"), "HEARTBEAT", "the processes are not shown");
  require(states, any("ARM_COMMAND"), "ARM_COMMAND", "the controller's phase is not shown");
  require(states, any("PLAN_REQUEST"), "PLAN_REQUEST", "the target is that of the configuration");
  require(states, any("SWING_PLAN"), "SWING_PLAN", "the planned flight is not shown");
  require(flown, any("RELEASE"), "RELEASE", "it is not known when the ball left");
  require(flown, anyPicture(timeline), "images", "the camera views stay empty");
  require(landed, any("BALL_TRACK"), "BALL_TRACK", "the flight as measured is not shown");
  require(landed, any("LANDING"), "LANDING", "no landing is shown");
  const std::string invalid = invalidWords(timeline);
  if (!invalid.empty())
    sentences.push_back(
        fmt::format("Messages that do not decode or break their rule: {}.", invalid));
  return sentences;
}

}  // namespace

std::vector<std::string> missingFromLog(const Timeline& log) {
  return absent(log, "The log has no", true, true, true);
}

bool experimentHeard(const Timeline& live, int64_t wall_us) {
  return std::any_of(live.counts().begin(), live.counts().end(), [wall_us](const auto& count) {
    return wall_us - count.second.newest_utime < kSilence;
  });
}

std::vector<std::string> missingFromNetwork(const Timeline& live) {
  const bool states = std::max(live.taken("ARM_STATE"), live.taken("HAND_STATE")) >= kEnoughStates;
  const bool landed =
      std::any_of(live.throws().begin(), live.throws().end(),
                  [](const ViewedThrow& viewed) { return viewed.landing.has_value(); });
  return absent(live, "Heard no", states, landed, landed);
}

}  // namespace fastball::view
