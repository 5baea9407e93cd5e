#pragma once

#include <string>
#include <vector>

#include "launch/campaign/campaign_results.h"

/// Pictures of a campaign, each as NAME.png, NAME.svg and NAME.csv in a folder that exists.
namespace fastball::launch {

/// All landings in the target plane with ring, mean and ellipses. One picture "landings" with the strategies side
/// by side, or where something is varied "landings-STRATEGY" with its cases; all axes are equal.
/// @return names of the pictures.
/// @throw std::runtime_error if one cannot be drawn, as all of these do.
std::vector<std::string> drawLandings(const CampaignResults& results, const std::string& folder);

/// Hit rate, and for one quantity also the scatter of the landings, over what an ordered study varies: "study".
std::vector<std::string> drawStudy(const CampaignResults& results, const std::string& folder);

/// What each error costs: "causes-STRATEGY".
std::vector<std::string> drawCauses(const CampaignResults& results, const std::string& folder);

/// Hit and clean rate of every case, where no other picture has them: "rates".
std::vector<std::string> drawRates(const CampaignResults& results, const std::string& folder);

/// Hit rate of the first, second, ... throw of the set-ups with nothing varied: "throw-numbers".
std::vector<std::string> drawThrowNumbers(const CampaignResults& results,
                                          const std::string& folder);

/// "hit_percent,hit_low,hit_high" of a rate, for a table. Empty fields where nothing was thrown.
std::string percentFields(const Rate& rate);

/// @throw std::runtime_error if it cannot be written.
void writeText(const std::string& text, const std::string& path);

}  // namespace fastball::launch
