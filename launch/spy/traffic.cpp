#include "launch/spy/traffic.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "logger/record_format.h"
#include "logger/sequence_gaps.h"
#include "messaging/command_trailer.h"
#include "messaging/sequence_step.h"

namespace fastball::launch {
namespace {

constexpr double kSeconds = 1e-6;
constexpr std::size_t kFingerprintBytes = 8;
/// Anyone can invent names of senders.
constexpr std::size_t kMaxSenders = 256;

}  // namespace

void Traffic::take(const std::string& name, const void* data, std::size_t size, int64_t utime) {
  auto entry = channels_.find(name);
  if (entry == channels_.end()) {
    if (channels_.size() >= kMaxChannels) {
      ++unlisted_;
      return;
    }
    entry = channels_.try_emplace(name).first;
    entry->second.has_many_senders = logger::hasManySenders(name);
  }
  Channel& channel = entry->second;
  ++channel.count;
  channel.last_utime = utime;
  channel.window.take(utime, size);
  const KnownType* type = known(data, size);
  if (type == nullptr || !decodes(type->layout, data, size)) {
    ++channel.undecodable;
    nameUndecodable(channel, type, data, size);
    return;
  }
  if (channel.decoded_type != type->type) {
    channel.decoded_type = type->type;
    channel.type = type->type->name;
  }
  const char* bytes = static_cast<const char*>(data);
  channel.newest.assign(bytes, bytes + size);
  const auto seq = type->layout.seq(data, size);
  const auto whose = seq ? sender(channel, data, size) : std::nullopt;
  if (whose)
    countGap(channel, *seq, *whose);
}

const Traffic::KnownType* Traffic::known(const void* data, std::size_t size) {
  const auto* type = types_.typeOf(data, size);
  if (type == nullptr)
    return nullptr;
  const auto [entry, is_new] = known_.try_emplace(type);
  if (is_new)
    entry->second = {type, layoutOf(types_, *type)};
  return &entry->second;
}

bool Traffic::decodes(const MessageLayout& layout, const void* data, std::size_t size) const {
  if (!layout.bytes)
    return types_.fields(data, size).has_value();
  return size == *layout.bytes || messaging::withoutTrailer(data, size) == *layout.bytes;
}

/// Who sent it: where a channel has several senders, the process that a message names tells them apart.
std::optional<std::string> Traffic::sender(const Channel& channel,
                                           const void* data,
                                           std::size_t size) const {
  if (!channel.has_many_senders)
    return "";
  const auto fields = types_.fields(data, size);
  if (!fields)
    return std::nullopt;
  std::optional<std::string> words;
  for (const messaging::MessageField& field : *fields) {
    for (const char* name : {"name", "host", "pid"}) {
      if (field.name() == name && field.sizes().empty())
        words = words.value_or("") + field.text(0) + '\n';
    }
  }
  return words;
}

void Traffic::countGap(Channel& channel, int64_t seq, const std::string& sender) {
  auto last = channel.last_seq.find(sender);
  if (last == channel.last_seq.end()) {
    if (channel.last_seq.size() >= kMaxSenders)
      return;
    last = channel.last_seq.emplace(sender, seq).first;
    channel.lost = channel.lost.value_or(0);
    return;
  }
  *channel.lost += messaging::missingBetween(std::exchange(last->second, seq), seq);
}

void Traffic::nameUndecodable(Channel& channel,
                              const KnownType* type,
                              const void* data,
                              std::size_t size) const {
  if (channel.decoded_type != nullptr)
    return;
  if (type != nullptr)
    channel.type = type->type->name;
  else if (size >= kFingerprintBytes)
    channel.type =
        fmt::format("unknown 0x{:016x}",
                    static_cast<uint64_t>(logger::int64At(static_cast<const char*>(data))));
}

std::vector<ChannelReport> Traffic::report(int64_t now) const {
  std::vector<ChannelReport> all;
  for (const auto& [name, channel] : channels_) {
    const double age =
        kSeconds * static_cast<double>(std::max<int64_t>(now - channel.last_utime, 0));
    all.push_back({name, channel.type, channel.count, channel.undecodable, channel.lost,
                   channel.window.rate(now), channel.window.bandwidth(now),
                   channel.window.jitter(now), age});
  }
  return all;
}

std::vector<messaging::MessageField> Traffic::newestFields(const std::string& name) const {
  const auto channel = channels_.find(name);
  if (channel == channels_.end())
    return {};
  const std::vector<char>& newest = channel->second.newest;
  return types_.fields(newest.data(), newest.size())
      .value_or(std::vector<messaging::MessageField>{});
}

}  // namespace fastball::launch
