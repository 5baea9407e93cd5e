#pragma once

#include <cstdint>
#include <set>
#include <string>

#include "launch/roster.h"
#include "messaging/clock_survey.h"

namespace fastball::launch {

/// Measures how far the clocks of a system's machines are from this one's, while somebody else pumps the endpoint.
class ClockCheck {
 public:
  /// `roster`: of the same endpoint; it names the hosts that should answer.
  ClockCheck(messaging::Endpoint& endpoint, const messaging::Clock& clock, const Roster& roster);
  ClockCheck(const ClockCheck&) = delete;
  ClockCheck& operator=(const ClockCheck&) = delete;

  /// Asks, if it is time; to be called every 20 ms or so until it returns true: everybody has been asked often enough.
  bool update();
  /// "clocks: robot +0.1 ms (to 0.2), vision does not tell"; empty: there are no other hosts.
  std::string report() const;
  /// A sentence on the clock that is farther off than `limit` [s] beyond any doubt of the measurement; empty: there is none.
  std::string fault(double limit) const;

 private:
  std::set<std::string> otherHosts() const;

  const messaging::Clock& clock_;
  const Roster& roster_;
  messaging::ClockSurvey survey_;
  int asked_ = 0;
  int64_t next_us_ = INT64_MIN;
};

}  // namespace fastball::launch
