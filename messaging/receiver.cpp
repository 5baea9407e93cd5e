#include "messaging/receiver.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <exception>

#include "messaging/sequence_step.h"

namespace fastball::messaging {

void Receiver::deliver(const void* message) {
  countGap(type_->seq(message));
  try {
    for (const Handler& handler : handlers_)
      handler(message);
    ++counts_->accepted;
  } catch (const std::exception& error) {
    refuse(fmt::format("{}: its handler failed: {}", channel_, error.what()));
  } catch (...) {
    refuse(channel_ + ": its handler failed");
  }
}

void Receiver::refuse(const std::string& why) {
  if (worthALine(++counts_->invalid)) {
    spdlog::warn("dropped message {} of its channel: {}", counts_->invalid, why);
  }
}

void Receiver::countGap(int64_t seq) {
  if (!one_sender_)
    return;
  if (any_ && seq <= last_seq_)
    ++counts_->repeated;
  if (any_)
    counts_->lost += missingBetween(last_seq_, seq);
  // Also after a step back: a sender that was started again begins at 0.
  any_ = true;
  last_seq_ = seq;
}

void UnsentCount::add(const std::string& why) {
  if (worthALine(++value_))
    spdlog::error("could not send message (number {}): {}", value_, why);
}

}  // namespace fastball::messaging
