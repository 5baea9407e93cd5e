#pragma once

#include <functional>
#include <string>

namespace fastball::bench {

/// Seconds that one call takes, by Google Benchmark: wall time, mean over as many calls as half a second holds.
double secondsPerCall(const std::string& id, const std::function<void()>& call);
/// The same in time of this thread's processor, which other processes lengthen less; for a call that starts no thread.
double cpuSecondsPerCall(const std::string& id, const std::function<void()>& call);

/// A URL on a port of its own, so that the measurement disturbs nobody on this machine.
std::string privateLcmUrl();

/// Processor time of this program's children that have ended, and of theirs [s].
double childrenCpu();

}  // namespace fastball::bench
