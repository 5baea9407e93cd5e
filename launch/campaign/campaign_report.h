#pragma once

#include <string>
#include <vector>

namespace fastball::launch {

/// Draws what a campaign's folder has recorded so far, also while it goes on: pictures (PNG, SVG) with their numbers (CSV), cases.csv, and
/// report.md with a table of all cases, the pictures and the errors.
/// @param output folder, made if absent.
/// @return one sentence for each picture that could not be drawn.
/// @throw std::invalid_argument if there is no campaign or no throw.
std::vector<std::string> writeCampaignReport(const std::string& folder, const std::string& output);

}  // namespace fastball::launch
