#include "launch/replay_comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace fastball::launch {
namespace {

/// What a message answers.
const std::set<std::string> kAnswered{"tick", "frame"};
const std::set<std::string> kKeyFields{"scene_id", "tick", "frame", "channel"};
const std::set<std::string> kNotCompared{"seq", "plan_ms"};

bool namesInput(const std::vector<messaging::MessageField>& fields) {
  return std::any_of(fields.begin(), fields.end(),
                     [](const auto& field) { return kAnswered.count(field.name()) != 0; });
}

}  // namespace

bool MessageComparison::isAnswer(const Bytes& message) const {
  const auto fields = types_.fields(message.data(), message.size());
  return fields && namesInput(*fields);
}

/// Members that say what the message answers, and how many with the same ones came before. A message that names no
/// tick or frame is known by its place in the row alone.
MessageComparison::Key MessageComparison::keyOf(const std::string& channel,
                                                const Bytes& message,
                                                std::map<Key, int64_t>& counts) const {
  std::string key;
  const auto fields = types_.fields(message.data(), message.size());
  if (fields && namesInput(*fields)) {
    for (const auto& field : *fields) {
      if (field.count() == 1 && kKeyFields.count(field.name()) != 0)
        key += fmt::format("{} {} ", field.name(), field.text(0));
    }
  }
  key += fmt::format("{}", counts[{channel, key}]++);
  return {channel, key};
}

MessageComparison::Key MessageComparison::record(const std::string& channel, const Bytes& message) {
  const Recorded recorded{++channels_[channel].recorded, message};
  Key key = keyOf(channel, message, recorded_counts_);
  const auto said = said_.find(key);
  if (said == said_.end()) {
    recorded_.emplace(key, recorded);
    return key;
  }
  compare(channel, recorded, said->second);
  said_.erase(said);
  return key;
}

void MessageComparison::say(const std::string& channel, const Bytes& message) {
  const Key key = keyOf(channel, message, said_counts_);
  const auto recorded = recorded_.find(key);
  if (recorded == recorded_.end()) {
    said_.emplace(key, message);
    return;
  }
  compare(channel, recorded->second, message);
  recorded_.erase(recorded);
}

void MessageComparison::compare(const std::string& channel,
                                const Recorded& recorded,
                                const Bytes& said) {
  ComparedChannel& result = channels_[channel];
  const std::string found = difference(recorded.bytes, said);
  ++(found.empty() ? result.equal : result.different);
  if (!found.empty() && result.first_difference.empty())
    result.first_difference = fmt::format("message {}: {}", recorded.number, found);
}

/// The first field that differs, in words; empty: none.
std::string MessageComparison::difference(const Bytes& recorded, const Bytes& said) const {
  const auto was = types_.fields(recorded.data(), recorded.size());
  const auto is = types_.fields(said.data(), said.size());
  if (!was || !is)
    return recorded == said ? "" : "its bytes differ, and they are no known message";
  for (std::size_t f = 0; f < std::min(was->size(), is->size()); ++f) {
    const auto& a = (*was)[f];
    const auto& b = (*is)[f];
    if (a.name() != b.name())
      return fmt::format("'{}' stands where '{}' was", b.name(), a.name());
    if (kNotCompared.count(a.name()) != 0)
      continue;
    if (a.count() != b.count())
      return fmt::format("{} had {} values, has {}", a.name(), a.count(), b.count());
    for (std::size_t i = 0; i < a.count(); ++i) {
      if (a.bytes(i) != b.bytes(i))
        return fmt::format("{} was {}, is {}", a.elementName(i), a.text(i), b.text(i));
    }
  }
  return was->size() == is->size() ? "" : "it has another number of fields";
}

std::string comparisonLine(const std::string& name, const ComparedChannel& channel) {
  std::string line = fmt::format("{}: {} of {} equal", name, channel.equal, channel.recorded);
  if (channel.different > 0)
    line += fmt::format(", {} different, first {}", channel.different, channel.first_difference);
  if (channel.missing() > 0)
    line += fmt::format(", {} not said", channel.missing());
  return line;
}

}  // namespace fastball::launch
