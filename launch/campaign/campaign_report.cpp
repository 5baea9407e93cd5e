#include "launch/campaign/campaign_report.h"

#include <fmt/format.h>

#include <filesystem>
#include <stdexcept>

#include "launch/campaign/campaign_drawing.h"
#include "launch/campaign/campaign_page.h"
#include "launch/campaign/error_table.h"

namespace fastball::launch {
namespace {

constexpr double kMilli = 1e3;

std::string casesCsv(const CampaignResults& results) {
  std::string csv =
      "strategy,variant,throws,hits,hit_percent,hit_low,hit_high,clean_percent,"
      "clean_low,clean_high,from_third_hit_percent,from_third_low,from_third_high,"
      "landed,mean_right_mm,mean_up_mm,sd_right_mm,sd_up_mm,release_speed_mps\n";
  for (std::size_t i = 0; i < results.summaries.size(); ++i) {
    const Case& one = results.campaign.cases[i];
    const CaseSummary& s = results.summaries[i];
    csv += fmt::format("{},{},{},{},{},{},{},{},{:.3f},{:.3f},{:.3f},{:.3f},{:.4f}\n", one.strategy,
                       variantOf(one), s.hits.of, s.hits.count, percentFields(s.hits),
                       percentFields(s.cleans), percentFields(s.settled_hits), s.landed,
                       kMilli * s.bias.x(), kMilli * s.bias.y(), kMilli * s.deviation(0),
                       kMilli * s.deviation(1), s.release_speed);
  }
  return csv;
}

std::string caseTable(const CampaignResults& results) {
  std::string table =
      "| case | throws | hit % | 95 % interval | clean % | from third on, hit % | mean right, up "
      "(mm) | sd right, up (mm) |\n| --- | --: | --: | --- | --: | --: | --- | --- |\n";
  for (std::size_t i = 0; i < results.summaries.size(); ++i) {
    const CaseSummary& s = results.summaries[i];
    if (s.hits.of == 0) {
      table += fmt::format("| {} | 0 | | | | | | |\n", results.campaign.cases[i].name);
      continue;
    }
    table += fmt::format(
        "| {} | {} | {:.2f} | {:.2f} to {:.2f} | {:.2f} | {} | {:+.1f}, {:+.1f} | {:.1f}, {:.1f} "
        "|\n",
        results.campaign.cases[i].name, s.hits.of, 100 * s.hits.value(), 100 * s.hits.low(),
        100 * s.hits.high(), 100 * s.cleans.value(),
        s.settled_hits.of > 0 ? fmt::format("{:.2f}", 100 * s.settled_hits.value()) : "",
        kMilli * s.bias.x(), kMilli * s.bias.y(), kMilli * s.deviation(0), kMilli * s.deviation(1));
  }
  return table;
}

/// The errors with nothing varied.
std::string errorsOf(const Campaign& campaign) {
  const std::string& path = campaign.cases.front().uncertainty;
  if (path.empty())
    return "No errors were injected.\n";
  try {
    return fmt::format("From `{}`.\n\n{}", path, errorTable(path));
  } catch (const std::invalid_argument& e) {
    return fmt::format("They are not known any more: {}.\n", e.what());
  }
}

std::string markdown(const CampaignResults& results, const std::vector<std::string>& pictures) {
  const Campaign& campaign = results.campaign;
  int done = 0;
  for (const CaseSummary& s : results.summaries)
    done += s.hits.of;
  std::string text = fmt::format(
      "# Campaign\n\n{} of {} throws, {} in each case and {} in a set-up; seeds from {}, {}, "
      "version "
      "{}. A hit is a ball whose centre passes the ring; it is clean if the whole ball does. "
      "Intervals are Wilson's, 95 %.\n\n{}\n",
      done, campaign.throws * static_cast<int>(campaign.cases.size()), campaign.throws,
      campaign.set_up_throws, campaign.seed,
      campaign.images ? "measured with cameras" : "measured with a light curtain in the ring",
      campaign.version, caseTable(results));
  for (const std::string& name : pictures)
    text += fmt::format("![{0}]({0}.svg)\n\nNumbers: [{0}.csv]({0}.csv)\n\n", name);
  return text + "## Errors\n\n" + errorsOf(campaign);
}

}  // namespace

std::vector<std::string> writeCampaignReport(const std::string& folder, const std::string& output) {
  const CampaignResults results = readResults(folder);
  std::filesystem::create_directories(output);
  std::vector<std::string> pictures, failures;
  const auto attempt = [&](const char* what, const auto& draw) {
    try {
      const std::vector<std::string> drawn = draw(results, output);
      pictures.insert(pictures.end(), drawn.begin(), drawn.end());
    } catch (const std::exception& e) {
      failures.push_back(fmt::format("there is no picture of {}: {}", what, e.what()));
    }
  };
  attempt("the rates", drawRates);
  attempt("the study", drawStudy);
  attempt("the causes", drawCauses);
  attempt("the landings", drawLandings);
  attempt("the throws by their number", drawThrowNumbers);
  writeText(casesCsv(results), output + "/cases.csv");
  writeText(markdown(results, pictures), output + "/report.md");
  writeText(campaignPage(results, folder, pictures, failures), output + "/index.html");
  return failures;
}

}  // namespace fastball::launch
