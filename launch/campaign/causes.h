#pragma once

#include <string>
#include <vector>

#include "launch/campaign/campaign_results.h"

namespace fastball::launch {

/// An error's two cases beside that with all errors.
struct Cause {
  std::string error;
  CaseSummary off, alone;
  /// Hits without the error less those with all. The same draws in both make the interval wider than need be.
  RateDifference gain;
};

/// What each error of a study costs a strategy.
struct Causes {
  CaseSummary all;
  std::vector<Cause> causes;  ///< the dearest first
};

/// No causes: the campaign has not varied them.
Causes causesOf(const CampaignResults& results, const std::string& strategy);

}  // namespace fastball::launch
