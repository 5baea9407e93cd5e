#pragma once

#include <map>
#include <string>

#include "messaging/clock.h"
#include "messaging/endpoint.h"

namespace fastball::messaging {

/// Answers everybody who asks on CLOCK what time it is here: part of every process (runOverLcm).
class ClockAnswer {
 public:
  /// @param name of this process. It must live as long as `endpoint` is drained; so must a
  ///   ClockSurvey.
  ClockAnswer(Endpoint& endpoint, const Clock& clock, const std::string& name);
  ClockAnswer(const ClockAnswer&) = delete;
  ClockAnswer& operator=(const ClockAnswer&) = delete;

 private:
  const Clock& clock_;
  Publisher<clock_probe_t> publisher_;
  clock_probe_t message_{};
};

/// How far the wall clock of another machine is from this one's.
struct HostClock {
  double offset = 0;  ///< [s], theirs minus ours
  double error = 0;   ///< [s], the offset is right to this: half of the shortest round trip
  int answers = 0;
};

/// Asks on CLOCK, and has each host's clock from the answer with the shortest round trip (D. L. Mills, RFC 5905, section 8): of
/// the four stamps t1 asked, t2 heard there, t3 answered, t4 heard here, the offset is ((t2 - t1) + (t3 - t4)) / 2 and the round
/// trip (t4 - t1) - (t3 - t2).
class ClockSurvey {
 public:
  ClockSurvey(Endpoint& endpoint, const Clock& clock);
  ClockSurvey(const ClockSurvey&) = delete;
  ClockSurvey& operator=(const ClockSurvey&) = delete;

  /// Asks everybody once more; answers come with later drains. Several times, for then one is hardly delayed.
  void ask();
  /// By host name, this machine's included.
  const std::map<std::string, HostClock>& clocks() const { return clocks_; }

 private:
  void hear(const clock_probe_t& answer);

  const Clock& clock_;
  Publisher<clock_probe_t> publisher_;
  clock_probe_t question_{};
  std::map<std::string, HostClock> clocks_;
};

}  // namespace fastball::messaging
