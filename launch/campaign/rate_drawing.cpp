// Rates with their intervals: of every case, and of the throws of a set-up by their number.
#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <stdexcept>

#include "launch/campaign/campaign_drawing.h"
#include "launch/figures/style.h"
#include "launch/gnuplot.h"

namespace fastball::launch {
namespace {

constexpr std::size_t kMostBars = 60;

bool isAnError(const Case& one) {
  const std::string variant = variantOf(one);
  const auto ends = [&](const std::string& with) {
    return variant.size() > with.size() &&
           variant.compare(variant.size() - with.size(), with.size(), with) == 0;
  };
  return ends(" off") || ends(" alone");
}

/// Of each case "y hit low high clean low high" [%], top to bottom.
std::string barData(const CampaignResults& results, const std::vector<std::size_t>& cases) {
  std::string data;
  for (std::size_t n = 0; n < cases.size(); ++n) {
    const Rate &hits = results.summaries[cases[n]].hits,
               &cleans = results.summaries[cases[n]].cleans;
    data += fmt::format("{} {} {} {} {} {} {}\n", -static_cast<int>(n), 100 * hits.value(),
                        100 * hits.low(), 100 * hits.high(), 100 * cleans.value(),
                        100 * cleans.low(), 100 * cleans.high());
  }
  return dataBlock("bars", data);
}

std::string barCommands(const CampaignResults& results,
                        const std::vector<std::size_t>& cases,
                        const std::string& title) {
  std::string tics;
  std::size_t longest = 0;
  for (std::size_t n = 0; n < cases.size(); ++n) {
    const std::string label = fmt::format("{} ({})", results.campaign.cases[cases[n]].name,
                                          results.summaries[cases[n]].hits.of);
    longest = std::max(longest, label.size());
    tics += fmt::format("{}{} {}", n == 0 ? "" : ", ", quoted(label), -static_cast<int>(n));
  }
  return kStyle + fmt::format(R"gp(set termoption noenhanced
set lmargin {}; set tmargin 4; set bmargin 3.6; set rmargin 4
set label 1 {} at graph 0,1 left offset 0,1 font ',13'
set key at graph 1,{:.4f} bottom right horizontal reverse Left
set xlabel 'throws (%), with 95 % intervals'; set xrange [0:100]; set yrange [{}:0.6]
set ytics ({}) scale 0
set style fill solid 1
plot $bars u 2:1:(0):2:($1):($1+0.36) w boxxyerror fc rgb {} title 'hits', \
  '' u 5:1:(0):5:($1-0.36):($1) w boxxyerror fc rgb {} title 'clean hits', \
  '' u 2:($1+0.18):3:4 w xerrorbars pt 7 ps 0.3 lw 1.6 lc rgb '#000000', \
  '' u 5:($1-0.18):6:7 w xerrorbars pt 7 ps 0.3 lw 1.6 lc rgb '#000000'
)gp",
                              longest + 3, quoted(title),
                              1 + 0.1 / static_cast<double>(cases.size()),
                              0.4 - static_cast<double>(cases.size()), tics, kColours[0], kYellow);
}

/// Of the strategies with nothing varied: number, then hit rate and interval [%] of each.
std::string throwNumberData(const CampaignResults& results, const std::vector<std::size_t>& cases) {
  std::string data;
  for (std::size_t k = 0; k < static_cast<std::size_t>(results.campaign.set_up_throws); ++k) {
    data += fmt::format("{}", k + 1);
    for (const std::size_t i : cases) {
      const std::vector<Rate>& rates = results.summaries[i].by_throw;
      const Rate rate = k < rates.size() ? rates[k] : Rate{};
      data += rate.of > 0 ? fmt::format(" {} {} {}", 100 * rate.value(), 100 * rate.low(),
                                        100 * rate.high())
                          : " NaN NaN NaN";
    }
    data += '\n';
  }
  return data;
}

std::string throwNumberTable(const CampaignResults& results,
                             const std::vector<std::size_t>& cases) {
  std::string csv = "strategy,throw,throws,hit_percent,hit_low,hit_high\n";
  for (const std::size_t i : cases) {
    const std::vector<Rate>& rates = results.summaries[i].by_throw;
    for (std::size_t k = 0; k < rates.size(); ++k)
      csv += fmt::format("{},{},{},{}\n", results.campaign.cases[i].strategy, k + 1, rates[k].of,
                         percentFields(rates[k]));
  }
  return csv;
}

}  // namespace

std::string percentFields(const Rate& rate) {
  if (rate.of == 0)
    return ",,";
  return fmt::format("{:.3f},{:.3f},{:.3f}", 100 * rate.value(), 100 * rate.low(),
                     100 * rate.high());
}

void writeText(const std::string& text, const std::string& path) {
  std::ofstream file(path);
  if (!(file << text).flush())
    throw std::runtime_error(fmt::format("cannot write '{}'", path));
}

std::vector<std::string> drawRates(const CampaignResults& results, const std::string& folder) {
  std::string csv =
      "strategy,variant,throws,hit_percent,hit_low,hit_high,clean_percent,clean_low,"
      "clean_high\n";
  std::vector<std::size_t> thrown;
  for (std::size_t i = 0; i < results.campaign.cases.size(); ++i) {
    const Case& one = results.campaign.cases[i];
    if (one.quantity || isAnError(one))
      return {};
    const CaseSummary& s = results.summaries[i];
    csv += fmt::format("{},{},{},{},{}\n", one.strategy, variantOf(one), s.hits.of,
                       percentFields(s.hits), percentFields(s.cleans));
    if (s.hits.of > 0)
      thrown.push_back(i);
  }
  std::string title;
  if (thrown.size() > kMostBars) {
    title = fmt::format("The {} cases of {} with the fewest hits", kMostBars, thrown.size());
    std::stable_sort(thrown.begin(), thrown.end(), [&](std::size_t a, std::size_t b) {
      return results.summaries[a].hits.value() < results.summaries[b].hits.value();
    });
    thrown.resize(kMostBars);
  }
  writeText(csv, folder + "/rates.csv");
  const auto height = 130 + 42 * thrown.size();
  drawPicture(folder + "/rates", 1000, static_cast<int>(height), barData(results, thrown),
              barCommands(results, thrown, title));
  return {"rates"};
}

std::vector<std::string> drawThrowNumbers(const CampaignResults& results,
                                          const std::string& folder) {
  std::vector<std::size_t> cases;
  for (std::size_t i = 0; i < results.campaign.cases.size(); ++i) {
    if (variantOf(results.campaign.cases[i]).empty() && results.summaries[i].hits.of > 0)
      cases.push_back(i);
  }
  if (cases.empty() || results.campaign.set_up_throws < 2)
    return {};
  std::string plot;
  for (std::size_t n = 0; n < cases.size(); ++n) {
    const double aside = 0.07 * (static_cast<double>(n) - (cases.size() - 1) / 2.0);
    plot += fmt::format(
        "{}$rates u ($1+{}):{}:{}:{} w yerrorlines pt {} ps 1.2 lw 2 lc rgb {} title {}",
        n == 0 ? "plot " : ", ", aside, 3 * n + 2, 3 * n + 3, 3 * n + 4, kMarks[n % 4],
        kColours[n % 4], quoted(results.campaign.cases[cases[n]].strategy));
  }
  writeText(throwNumberTable(results, cases), folder + "/throw-numbers.csv");
  drawPicture(folder + "/throw-numbers", 900, 520,
              dataBlock("rates", throwNumberData(results, cases)),
              kStyle + fmt::format(R"gp(set termoption noenhanced
set title 'Hits by the number of the throw in its set-up, with 95 % intervals' font ',13'
set xlabel 'throw of the set-up'; set ylabel 'hits (%)'
set xrange [0.5:{}]; set yrange [0:102]; set xtics {}
set bmargin 6; set key bottom center at screen 0.5, screen 0.02 horizontal
{}
)gp",
                                   results.campaign.set_up_throws + 0.5,
                                   results.campaign.set_up_throws > 20 ? "autofreq" : "1", plot));
  return {"throw-numbers"};
}

}  // namespace fastball::launch
