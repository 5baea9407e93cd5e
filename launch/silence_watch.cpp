#include "launch/silence_watch.h"

#include <fmt/format.h>

namespace fastball::launch {

SilenceWatch::SilenceWatch(messaging::Endpoint& endpoint, const messaging::Clock& clock)
    : clock_(clock) {
  endpoint.subscribe<heartbeat_t>(messaging::kHeartbeat, [this](const heartbeat_t& m) {
    heard_us_[m.name] = clock_.monotonicUs();
  });
}

std::string SilenceWatch::silentFor(double limit, const std::vector<std::string>& names) const {
  std::string sentence;
  for (const std::string& name : names) {
    const auto heard = heard_us_.find(name);
    if (heard == heard_us_.end())
      continue;
    const double silence = static_cast<double>(clock_.monotonicUs() - heard->second) / 1e6;
    if (silence < limit)
      continue;
    sentence += fmt::format("{}{} has said no HEARTBEAT for {:.1f} s", sentence.empty() ? "" : ", ",
                            name, silence);
  }
  return sentence;
}

}  // namespace fastball::launch
