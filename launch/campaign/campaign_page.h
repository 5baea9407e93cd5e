#pragma once

#include <string>
#include <vector>

#include "launch/campaign/campaign_results.h"

namespace fastball::launch {

/// The report of a campaign as a page of HTML, with its pictures in the same folder.
/// @param folder of the campaign, for the title. @param pictures names of those that were drawn.
/// @param failures sentences: what could not be drawn.
std::string campaignPage(const CampaignResults& results,
                         const std::string& folder,
                         const std::vector<std::string>& pictures,
                         const std::vector<std::string>& failures);

}  // namespace fastball::launch
