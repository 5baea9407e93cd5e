#include "launch/campaign/causes.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace fastball::launch {
namespace {

constexpr double kMilli = 1e3;

const CaseSummary* summaryOf(const CampaignResults& results,
                             const std::string& strategy,
                             const std::string& variant) {
  for (const std::size_t i : casesOfStrategy(results.campaign, strategy)) {
    if (variantOf(results.campaign.cases[i]) == variant && results.summaries[i].hits.of > 0)
      return &results.summaries[i];
  }
  return nullptr;
}

/// Name of the error of which `variant` says that it is off.
std::optional<std::string> errorOff(const std::string& variant) {
  const std::string off = " off";
  if (variant.size() <= off.size() ||
      variant.compare(variant.size() - off.size(), off.size(), off) != 0)
    return {};
  return variant.substr(0, variant.size() - off.size());
}

double scatter(const CaseSummary& s) {
  return kMilli * std::sqrt(s.covariance.trace());
}

}  // namespace

Causes causesOf(const CampaignResults& results, const std::string& strategy) {
  Causes found;
  const CaseSummary* all = summaryOf(results, strategy, "");
  if (all == nullptr)
    return found;
  found.all = *all;
  for (const std::size_t i : casesOfStrategy(results.campaign, strategy)) {
    const auto error = errorOff(variantOf(results.campaign.cases[i]));
    const CaseSummary* alone = error ? summaryOf(results, strategy, *error + " alone") : nullptr;
    if (alone == nullptr || results.summaries[i].hits.of == 0)
      continue;
    found.causes.push_back({*error, results.summaries[i], *alone,
                            difference(results.summaries[i].hits, found.all.hits)});
  }
  std::stable_sort(found.causes.begin(), found.causes.end(), [](const Cause& a, const Cause& b) {
    return std::make_pair(a.gain.value, scatter(a.alone)) >
           std::make_pair(b.gain.value, scatter(b.alone));
  });
  return found;
}

}  // namespace fastball::launch
