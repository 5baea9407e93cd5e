#include "launch/campaign/campaign_page.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <stdexcept>

#include "launch/campaign/causes.h"
#include "launch/campaign/error_table.h"
#include "launch/html.h"

namespace fastball::launch {
namespace {

constexpr double kMilli = 1e3;

Html percent(const Rate& rate) {
  return rate.of > 0 ? html("{:.2f}", 100 * rate.value()) : Html{};
}

Html interval(const Rate& rate) {
  return rate.of > 0 ? html("{:.2f} to {:.2f}", 100 * rate.low(), 100 * rate.high()) : Html{};
}

Html pair(double right, double up, const char* pattern) {
  return html(pattern, kMilli * right, kMilli * up);
}

std::vector<Html> caseRow(const Case& one, const CaseSummary& s) {
  std::vector<Html> row{escaped(one.name),  html("{}", s.hits.of),  html("{}", s.hits.count),
                        percent(s.hits),    interval(s.hits),       percent(s.cleans),
                        interval(s.cleans), percent(s.settled_hits)};
  row.push_back(s.landed > 0 ? pair(s.bias.x(), s.bias.y(), "{:+.1f}, {:+.1f}") : Html{});
  row.push_back(s.landed > 1 ? pair(s.deviation(0), s.deviation(1), "{:.1f}, {:.1f}") : Html{});
  row.push_back(s.hits.of > 0 ? html("{:.2f}", s.release_speed) : Html{});
  return row;
}

Html caseTable(const CampaignResults& results) {
  std::vector<std::vector<Html>> rows;
  for (std::size_t i = 0; i < results.summaries.size(); ++i)
    rows.push_back(caseRow(results.campaign.cases[i], results.summaries[i]));
  return htmlTable(
      "All cases. A hit is a ball whose centre passes the ring; it is clean if the whole ball "
      "does. Intervals are Wilson's, 95 %. "
      "Means and standard deviations of the landings: to the right and up in the net's plane.",
      {{"case", false, true},
       {"throws"},
       {"hits"},
       {"hit %"},
       {"95 % interval"},
       {"clean %"},
       {"95 % interval"},
       {"from the third on, hit %"},
       {"mean (mm)"},
       {"sd (mm)"},
       {"release (m/s)"}},
      rows);
}

Html causeTable(const CampaignResults& results, const std::string& strategy) {
  const Causes causes = causesOf(results, strategy);
  std::vector<std::vector<Html>> rows;
  for (const Cause& cause : causes.causes) {
    const CaseSummary& alone = cause.alone;
    rows.push_back({escaped(cause.error), html("{:+.2f}", 100 * cause.gain.value),
                    html("{:+.2f} to {:+.2f}", 100 * cause.gain.low, 100 * cause.gain.high),
                    percent(cause.off.hits), percent(alone.hits), interval(alone.hits),
                    pair(alone.bias.x(), alone.bias.y(), "{:+.1f}, {:+.1f}"),
                    pair(alone.deviation(0), alone.deviation(1), "{:.1f}, {:.1f}")});
  }
  if (rows.empty())
    return {};
  return htmlTable(fmt::format("What each error costs strategy {}, the dearest first: percentage "
                               "points of hits that are gained without it "
                               "(difference of two rates with its 95 % interval by Newcombe), and "
                               "the landings with it alone.",
                               strategy),
                   {{"error", false, true},
                    {"gain"},
                    {"95 % interval"},
                    {"hit % without"},
                    {"hit % alone"},
                    {"95 % interval"},
                    {"mean alone (mm)"},
                    {"sd alone (mm)"}},
                   rows);
}

bool begins(const std::string& name, const char* with) {
  return name.rfind(with, 0) == 0;
}

std::string captionOf(const std::string& name) {
  if (name == "rates")
    return "Hits and clean hits of every case, with 95 % intervals; the number of throws in "
           "brackets.";
  if (name == "study")
    return "Hits over what the study varies, with 95 % intervals.";
  if (name == "throw-numbers")
    return "Hits of the first, second, ... throw of a set-up, with 95 % intervals: what a strategy "
           "learns there.";
  if (begins(name, "causes-"))
    return "What each error costs: hits gained without it, and where the balls land with it alone.";
  return "Where the balls crossed the net's plane, with mean and one and two standard deviations; "
         "all axes are equal.";
}

Html pictureSection(const std::vector<std::string>& pictures) {
  Html text;
  for (const std::string& name : pictures)
    text += htmlPicture(name, escaped(captionOf(name)), true);
  return text;
}

int throwsMade(const CampaignResults& results) {
  int made = 0;
  for (const CaseSummary& s : results.summaries)
    made += s.hits.of;
  return made;
}

/// Sentences of what is not there.
std::vector<std::string> missingOf(const CampaignResults& results,
                                   const std::vector<std::string>& failures) {
  std::vector<std::string> sentences;
  const Campaign& campaign = results.campaign;
  const int wanted = campaign.throws * static_cast<int>(campaign.cases.size());
  if (throwsMade(results) < wanted)
    sentences.push_back(fmt::format("The campaign is not finished: {} of {} throws are made.",
                                    throwsMade(results), wanted));
  sentences.insert(sentences.end(), failures.begin(), failures.end());
  return sentences;
}

Html missingSection(const std::vector<std::string>& sentences) {
  if (sentences.empty())
    return {};
  Html text{"<section class=\"missing\">\n<h2>What is missing</h2>\n<ul>\n"};
  for (const std::string& sentence : sentences)
    text += html("<li>{}</li>\n", sentence);
  text += {"</ul>\n</section>\n"};
  return text;
}

/// The hits of each strategy with nothing varied, in a sentence.
Html lead(const CampaignResults& results) {
  std::vector<std::string> words;
  for (std::size_t i = 0; i < results.summaries.size(); ++i) {
    const Case& one = results.campaign.cases[i];
    const Rate& hits = results.summaries[i].hits;
    if (variantOf(one).empty() && hits.of > 0)
      words.push_back(fmt::format("{} {:.1f} % ({:.1f} to {:.1f})", one.strategy,
                                  100 * hits.value(), 100 * hits.low(), 100 * hits.high()));
  }
  if (words.empty())
    return html("<p class=\"lead\">{} throws.</p>\n", throwsMade(results));
  return html("<p class=\"lead\">{} throws. Hits with nothing varied: {}.</p>\n",
              throwsMade(results), fmt::format("{}", fmt::join(words, "; ")));
}

template <class Member>
std::string namesOf(const Campaign& campaign, const Member& member) {
  std::set<std::string> names;
  for (const Case& one : campaign.cases)
    names.insert(one.*member);
  constexpr std::size_t kMost = 3;
  if (names.size() > kMost)
    return fmt::format("{}, and {} more", *names.begin(), names.size() - 1);
  return fmt::format("{}", fmt::join(names, ", "));
}

Html whatRan(const Campaign& campaign) {
  const std::vector<std::pair<std::string, std::string>> facts{
      {"Version", campaign.version},
      {"Throws", fmt::format("{} in each of {} cases, {} in a set-up", campaign.throws,
                             campaign.cases.size(), campaign.set_up_throws)},
      {"Seeds",
       fmt::format("from {} on, one for each set-up, the same for all cases", campaign.seed)},
      {"Strategies", fmt::format("{}", fmt::join(strategiesOf(campaign), ", "))},
      {"Landings measured by",
       campaign.images ? "cameras and tracker" : "a light curtain in the ring"},
      {"Experiment", namesOf(campaign, &Case::config)},
      {"Errors", namesOf(campaign, &Case::uncertainty)}};
  Html table{"<h2>What ran</h2>\n<div class=\"wide\"><table>\n"};
  for (const auto& [name, value] : facts)
    table += html("<tr><th scope=\"row\">{}</th><td class=\"p\">{}</td></tr>\n", name, value);
  table += {"</table></div>\n"};
  return table;
}

/// The errors with nothing varied.
Html errorSection(const Campaign& campaign) {
  const std::string& path = campaign.cases.front().uncertainty;
  if (path.empty())
    return html("<h2>Errors</h2>\n<p>No errors were injected.</p>\n");
  std::vector<std::vector<Html>> rows;
  try {
    for (const ErrorLine& error : errorLines(path))
      rows.push_back({html("<code>{}</code>", error.name), escaped(error.drawn_for),
                      escaped(error.distribution), escaped(error.unit), escaped(error.reason)});
  } catch (const std::invalid_argument& e) {
    return html("<h2>Errors</h2>\n<p>They are not known any more: {}.</p>\n", e.what());
  }
  return html("<h2>Errors</h2>\n{}", htmlTable("From " + path + ".",
                                               {{"error", false},
                                                {"drawn for each", false},
                                                {"distribution", false},
                                                {"unit", false},
                                                {"reason", false, true}},
                                               rows));
}

}  // namespace

std::string campaignPage(const CampaignResults& results,
                         const std::string& folder,
                         const std::vector<std::string>& pictures,
                         const std::vector<std::string>& failures) {
  const std::string name = std::filesystem::absolute(std::filesystem::path(folder) / ".")
                               .lexically_normal()
                               .parent_path()
                               .filename()
                               .string();
  Html body = html("<h1>Campaign {}</h1>\n", name);
  body += lead(results);
  body += missingSection(missingOf(results, failures));
  body += {"<h2>Hits</h2>\n"};
  body += pictureSection(pictures);
  body += caseTable(results);
  for (const std::string& strategy : strategiesOf(results.campaign))
    body += causeTable(results, strategy);
  body += whatRan(results.campaign);
  body += errorSection(results.campaign);
  return htmlPage("Campaign " + name, body);
}

}  // namespace fastball::launch
