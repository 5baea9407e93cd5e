#include "launch/log_endpoint.h"

#include <utility>

#include "logger/log_reader.h"
#include "messaging/command_trailer.h"

namespace fastball::launch {

void LogEndpoint::play(const std::string& path) {
  logger::readLog(path, [this](const logger::LogEntry& entry) {
    const auto found = subscriptions_.find(entry.channel);
    if (found == subscriptions_.end())
      return;
    for (const Subscription& one : found->second) {
      const bool sound = messaging::decodeWithoutTrailer(*one.type, one.message.get(),
                                                         entry.data.data(), entry.data.size()) &&
                         !one.type->fault(one.message.get());
      messaging::ReceiveCounts& counts = counts_[entry.channel];
      ++(sound ? counts.accepted : counts.invalid);
      if (sound)
        one.handler(one.message.get());
    }
  });
}

bool LogEndpoint::publishErased(const char* /*channel*/,
                                std::size_t /*max_bytes*/,
                                const void* /*message*/,
                                const messaging::MessageType& /*type*/) {
  return false;
}

void LogEndpoint::subscribeErased(const char* channel,
                                  bool /*one_sender*/,
                                  const messaging::MessageType& type,
                                  std::function<void(const void*)> handler) {
  subscriptions_[channel].push_back({&type, type.make(), std::move(handler)});
}

}  // namespace fastball::launch
