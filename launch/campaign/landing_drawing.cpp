// Where the balls crossed the target plane.
#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>

#include "config/experiment.h"
#include "launch/campaign/campaign_drawing.h"
#include "launch/figures/style.h"
#include "launch/gnuplot.h"

namespace fastball::launch {
namespace {

constexpr double kMilli = 1e3;
constexpr int kGap = 14, kLeft = 78, kTop = 44, kTitle = 26, kBottom = 118;  // [px]

/// The ring of a case, in mm.
struct Ring {
  double radius, ball;
};

/// A picture's panels in pixels.
struct Sheet {
  int panel, columns, rows;
  int width() const { return kLeft + columns * (panel + kGap) + kGap; }
  int height() const { return kTop + rows * (panel + kTitle + kGap) + kBottom; }
  /// Margins of panel number `i` as shares of the picture.
  std::string margins(int i) const {
    const double left = kLeft + i % columns * (panel + kGap),
                 top = kTop + kTitle + i / columns * (panel + kTitle + kGap);
    return fmt::format(
        "set lmargin at screen {:.5f}; set rmargin at screen {:.5f}\n"
        "set tmargin at screen {:.5f}; set bmargin at screen {:.5f}\n",
        left / width(), (left + panel) / width(), 1 - top / height(), 1 - (top + panel) / height());
  }
};

Sheet sheetFor(int panels) {
  const int columns = panels <= 4 ? panels : panels <= 8 ? (panels + 1) / 2 : 8;
  return {panels == 1 ? 480 : panels <= 8 ? 300 : 190, columns, (panels + columns - 1) / columns};
}

std::vector<const ThrowOutcome*> throwsOf(const CampaignResults& results, std::size_t case_index) {
  std::vector<const ThrowOutcome*> throws;
  for (const auto& [unit, result] : results.record) {
    if (static_cast<std::size_t>(unit.case_index) != case_index)
      continue;
    for (const ThrowOutcome& one : result.throws)
      throws.push_back(&one);
  }
  return throws;
}

constexpr double kRim = 35;  // [mm], beyond the last label of an axis

/// Half the width [mm] of all panels: most landings, at least the ring.
double halfWidth(const CampaignResults& results, double radius) {
  std::vector<double> farthest;
  for (const auto& [unit, result] : results.record) {
    for (const ThrowOutcome& one : result.throws) {
      if (one.landing)
        farthest.push_back(kMilli * one.landing->lpNorm<Eigen::Infinity>());
    }
  }
  if (farthest.empty())
    return radius + kRim;
  constexpr double kShare = 0.95;
  const auto at = farthest.begin() +
                  static_cast<std::ptrdiff_t>(kShare * static_cast<double>(farthest.size() - 1));
  std::nth_element(farthest.begin(), at, farthest.end());
  return std::clamp(std::ceil(*at / 100) * 100, radius, 4 * radius) + kRim;
}

/// Outlines [mm] of one and two standard deviations about the mean.
std::string ellipses(const CaseSummary& s) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(s.covariance);
  const Eigen::Matrix2d spread =
      axes.eigenvectors() * axes.eigenvalues().cwiseMax(0).cwiseSqrt().asDiagonal();
  std::string outline;
  for (const double deviations : {1.0, 2.0}) {
    for (int i = 0; i <= 72; ++i) {
      const double angle = i * M_PI / 36;
      const Eigen::Vector2d p =
          s.bias + deviations * spread * Eigen::Vector2d(std::cos(angle), std::sin(angle));
      outline += fmt::format("{:.2f} {:.2f}\n", kMilli * p.x(), kMilli * p.y());
    }
    outline += '\n';
  }
  return outline;
}

std::string unitCircle() {
  std::string outline;
  for (int i = 0; i <= 72; ++i)
    outline += fmt::format("{:.5f} {:.5f}\n", std::cos(i * M_PI / 36), std::sin(i * M_PI / 36));
  return outline;
}

/// One case: its data, and the commands for its panel.
struct Panel {
  std::string data, commands;
};

/// "12 farther out, 1 without landing": what the panel cannot show.
std::string notShown(int outside, int lost) {
  std::string text;
  if (outside > 0)
    text = fmt::format("{} farther out", outside);
  if (lost > 0)
    text += fmt::format("{}{} without landing", text.empty() ? "" : ", ", lost);
  return text;
}

Panel panelOf(const CampaignResults& results, std::size_t i, const Ring& ring, double half_width) {
  std::string hits, misses;
  int outside = 0, lost = 0;
  for (const ThrowOutcome* one : throwsOf(results, i)) {
    if (!one->landing) {
      ++lost;
      continue;
    }
    outside += kMilli * one->landing->lpNorm<Eigen::Infinity>() > half_width;
    (one->hit ? hits : misses) +=
        fmt::format("{:.2f} {:.2f}\n", kMilli * one->landing->x(), kMilli * one->landing->y());
  }
  const CaseSummary& s = results.summaries[i];
  const bool many = s.hits.of > 300;
  const double size = many ? 0.35 : 0.6;
  Panel panel;
  const std::string nothing = "NaN NaN\n";
  panel.data =
      dataBlock(fmt::format("hits{}", i), hits.empty() ? nothing : hits) +
      dataBlock(fmt::format("misses{}", i), misses.empty() ? nothing : misses) +
      dataBlock(fmt::format("ellipses{}", i), s.landed > 1 ? ellipses(s) : nothing) +
      dataBlock(fmt::format("mean{}", i),
                s.landed > 0 ? fmt::format("{} {}\n", kMilli * s.bias.x(), kMilli * s.bias.y())
                             : nothing);
  panel.commands = fmt::format(
      R"gp(plot $misses{0} w p pt 8 ps {7} lc rgb {2}, $hits{0} w p pt 7 ps {1} lc rgb {3}, \
  $circle u ({4}*$1):({4}*$2) w l lw 3 lc rgb '#000000', \
  $circle u ({5}*$1):({5}*$2) w l lw 2 dt 2 lc rgb '#000000', \
  $ellipses{0} w l lw 4 lc rgb '#ffffff', $ellipses{0} w l lw 2 lc rgb {6}, \
  $mean{0} w p pt 1 ps 2.2 lw 6 lc rgb '#ffffff', $mean{0} w p pt 1 ps 1.8 lw 3 lc rgb {6}
)gp",
      i, size, kColours[1], many ? "'#500072B2'" : kColours[0], ring.radius,
      ring.radius - ring.ball, kColours[2], 1.6 * size);
  const std::string note = notShown(outside, lost);
  panel.commands = (note.empty() ? "unset label 1\n"
                                 : fmt::format("set label 1 {} at graph 0.03,0.94 front boxed\n",
                                               quoted(note))) +
                   panel.commands;
  return panel;
}

Ring ringOf(const Case& one) {
  const config::Experiment experiment = config::loadExperiment(one.config);
  return {kMilli * experiment.target.radius, kMilli * experiment.ball.radius};
}

/// The signs explained, in the strip under the panels.
std::string legend(const Sheet& sheet) {
  return fmt::format(R"gp(set lmargin at screen 0.02; set rmargin at screen 0.98
set bmargin at screen 0; set tmargin at screen {:.5f}
unset border; unset tics; unset xlabel; unset ylabel; unset title; unset label 1
set key center center horizontal samplen 3 width 1; set xrange [0:1]; set yrange [0:1]
plot NaN w p pt 7 ps 1 lc rgb {} title 'hit', NaN w p pt 8 ps 1 lc rgb {} title 'miss', \
  NaN w l lw 3 lc rgb '#000000' title 'ring', NaN w l lw 2 dt 2 lc rgb '#000000' title 'ring for the whole ball', \
  NaN w lp pt 1 ps 1.8 lw 2 lc rgb {} title 'mean, 1 and 2 sd'
)gp",
                     60.0 / sheet.height(), kColours[0], kColours[1], kColours[2]);
}

std::string axesOf(const Sheet& sheet, int i, int panels) {
  const bool first = i % sheet.columns == 0, lowest = i + sheet.columns >= panels;
  return fmt::format(
      "set format y '{}'; set ylabel {} offset 1,0\nset format x '{}'; set xlabel {}\n",
      first ? "%g" : "", first ? "'up (mm)'" : "''", lowest ? "%g" : "",
      lowest ? "'right (mm)'" : "''");
}

std::string titleOf(const Case& one, const Rate& hits, bool varied) {
  std::string name = varied ? variantOf(one) : one.strategy;
  if (name.empty())
    name = "unchanged";
  return fmt::format("{}: {:.1f} % of {}", name, 100 * hits.value(), hits.of);
}

void drawSheet(const CampaignResults& results,
               const std::vector<std::size_t>& cases,
               bool varied,
               const std::string& path_stem) {
  const Sheet sheet = sheetFor(static_cast<int>(cases.size()));
  const double half_width =
      halfWidth(results, ringOf(results.campaign.cases[cases.front()]).radius);
  const std::string title = varied
                                ? fmt::format("Landings of strategy {}; above each panel its hits",
                                              results.campaign.cases[cases.front()].strategy)
                                : "Landings; above each panel its hits";
  std::string data = dataBlock("circle", unitCircle());
  std::string commands = kStyle + fmt::format(
                                      R"gp(set termoption noenhanced
set multiplot title {0} font ',14'
set key off; set style textbox opaque noborder margins 0.4,0.4
set xrange [-{1}:{1}]; set yrange [-{1}:{1}]; set xtics {2}; set ytics {2}
)gp",
                                      quoted(title), half_width, half_width > 240 ? 200 : 100);
  for (std::size_t n = 0; n < cases.size(); ++n) {
    const std::size_t i = cases[n];
    const Case& one = results.campaign.cases[i];
    const Panel panel = panelOf(results, i, ringOf(one), half_width);
    data += panel.data;
    commands += sheet.margins(static_cast<int>(n)) +
                axesOf(sheet, static_cast<int>(n), static_cast<int>(cases.size())) +
                fmt::format("set title {} offset 0,-0.7 font ',{}'\n",
                            quoted(titleOf(one, results.summaries[i].hits, varied)),
                            sheet.panel < 250 ? 8 : 11) +
                panel.commands;
  }
  drawPicture(path_stem, sheet.width(), sheet.height(), data,
              commands + legend(sheet) + "unset multiplot\n");
}

std::string landingLines(const CampaignResults& results, const std::vector<std::size_t>& cases) {
  std::string csv = "strategy,variant,seed,throw,right_mm,up_mm,hit,clean\n";
  for (const std::size_t i : cases) {
    const Case& one = results.campaign.cases[i];
    for (const auto& [unit, result] : results.record) {
      if (static_cast<std::size_t>(unit.case_index) != i)
        continue;
      for (std::size_t k = 0; k < result.throws.size(); ++k) {
        const ThrowOutcome& thrown = result.throws[k];
        csv += fmt::format("{},{},{},{},", one.strategy, variantOf(one),
                           results.campaign.seed + unit.set_up, k + 1);
        csv += thrown.landing ? fmt::format("{:.3f},{:.3f}", kMilli * thrown.landing->x(),
                                            kMilli * thrown.landing->y())
                              : ",";
        csv += fmt::format(",{:d},{:d}\n", thrown.hit, thrown.clean);
      }
    }
  }
  return csv;
}

/// By what the panels of a study are sorted.
double valueOf(const Case& one) {
  return one.quantity ? one.quantity->value : -std::numeric_limits<double>::infinity();
}

}  // namespace

std::vector<std::string> drawLandings(const CampaignResults& results, const std::string& folder) {
  const std::vector<std::string> strategies = strategiesOf(results.campaign);
  const bool varied = strategies.size() < results.campaign.cases.size();
  std::map<std::string, std::vector<std::size_t>> sheets;
  for (const std::string& strategy : strategies) {
    for (const std::size_t i : casesOfStrategy(results.campaign, strategy)) {
      if (results.summaries[i].hits.of > 0)
        sheets[varied ? "landings-" + strategy : "landings"].push_back(i);
    }
  }
  std::vector<std::string> names;
  for (auto& [name, cases] : sheets) {
    std::stable_sort(cases.begin(), cases.end(), [&](std::size_t a, std::size_t b) {
      return valueOf(results.campaign.cases[a]) < valueOf(results.campaign.cases[b]);
    });
    const std::string path_stem = fmt::format("{}/{}", folder, name);
    writeText(landingLines(results, cases), path_stem + ".csv");
    drawSheet(results, cases, varied, path_stem);
    names.push_back(name);
  }
  return names;
}

}  // namespace fastball::launch
