#pragma once

#include <string>
#include <vector>

namespace fastball::launch {

/// Draws what a campaign's folder has recorded so far, also while it goes on: pictures (PNG, SVG)
/// with their numbers (CSV), cases.csv, and a page, index.html, with a table of all cases, the
/// pictures, the causes and the errors; and report.md, nearly the same for a repository.
/// @param output folder, made if absent.
/// @return one sentence for each picture that could not be drawn.
/// @throw std::invalid_argument if there is no campaign or no throw.
/// @throw std::runtime_error if the record makes no sense or `output` cannot be written.
std::vector<std::string> writeCampaignReport(const std::string& folder, const std::string& output);

}  // namespace fastball::launch
