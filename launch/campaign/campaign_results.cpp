#include "launch/campaign/campaign_results.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace fastball::launch {

CampaignResults readResults(const std::string& folder) {
  CampaignResults results{readCampaign(folder), readRecord(folder), {}};
  if (results.record.empty())
    throw std::invalid_argument(fmt::format("{}: no throw of the campaign is made yet", folder));
  for (std::size_t i = 0; i < results.campaign.cases.size(); ++i)
    results.summaries.push_back(summarise(results.record, static_cast<int>(i)));
  return results;
}

std::vector<std::string> strategiesOf(const Campaign& campaign) {
  std::vector<std::string> strategies;
  for (const Case& one : campaign.cases) {
    if (std::find(strategies.begin(), strategies.end(), one.strategy) == strategies.end())
      strategies.push_back(one.strategy);
  }
  return strategies;
}

std::string variantOf(const Case& one) {
  const std::string prefix = one.strategy + ", ";
  if (one.name.compare(0, prefix.size(), prefix) == 0)
    return one.name.substr(prefix.size());
  return one.name == one.strategy ? "" : one.name;
}

std::vector<std::size_t> casesOfStrategy(const Campaign& campaign, const std::string& strategy) {
  std::vector<std::size_t> numbers;
  for (std::size_t i = 0; i < campaign.cases.size(); ++i) {
    if (campaign.cases[i].strategy == strategy)
      numbers.push_back(i);
  }
  return numbers;
}

}  // namespace fastball::launch
