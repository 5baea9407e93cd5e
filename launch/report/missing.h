#pragma once

#include <string>
#include <vector>

#include "launch/report/logged_run.h"

namespace fastball::launch {

/// What a log lacks, in sentences.
struct Missing {
  std::vector<std::string> faults;  ///< it should be there
  std::vector<std::string>
      notes;  ///< it need not: nobody was to say it, or a few messages were lost
};

/// A channel is looked for if its sender took part.
Missing missingOf(const LoggedRun& run);

/// Whether a process of this name took part in the run; without HEARTBEATs nobody knows, and it may have.
bool tookPart(const LoggedRun& run, const std::string& process);

/// "1 to 4, 7 and 9". @param numbers ascending.
std::string numberWords(const std::vector<int64_t>& numbers);

}  // namespace fastball::launch
