#include "messaging/refusals.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

namespace fastball::messaging {

void Refusals::tell(const std::string& channel, int64_t count, const std::string& what) {
  spdlog::warn("refused {} {}{}; this one {}", count, channel, count == 1 ? "" : "s", what);
  Channel& told = channels_[channel];
  if (told.count == 0)
    told.first = what;
  told.count = count;
  sentence_.clear();
  for (const auto& [name, refused] : channels_) {
    sentence_ += fmt::format("{}refused {} {}{}; the first {}", sentence_.empty() ? "" : "; ",
                             refused.count, name, refused.count == 1 ? "" : "s", refused.first);
  }
}

}  // namespace fastball::messaging
