#pragma once

#include <map>
#include <string>
#include <vector>

#include "launch/campaign/statistics.h"

namespace fastball::launch {

/// A campaign's folder as far as its throws are made.
struct CampaignResults {
  Campaign campaign;
  std::map<Unit, UnitResult> record;
  std::vector<CaseSummary> summaries;  ///< of campaign.cases
};

/// @throw std::invalid_argument if the folder has no campaign, or one without a single throw.
/// @throw std::runtime_error as readRecord().
CampaignResults readResults(const std::string& folder);

/// Names of the strategies in the order of the cases, each once.
std::vector<std::string> strategiesOf(const Campaign& campaign);

/// What is varied in a case, its name without the strategy: "drag off"; empty: nothing.
std::string variantOf(const Case& one);

/// Cases of a strategy, by number.
std::vector<std::size_t> casesOfStrategy(const Campaign& campaign, const std::string& strategy);

}  // namespace fastball::launch
