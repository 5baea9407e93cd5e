// What each error costs, from a study that switches each off and leaves each alone.
#include <fmt/format.h>

#include <algorithm>

#include "launch/campaign/campaign_drawing.h"
#include "launch/campaign/causes.h"
#include "launch/figures/style.h"
#include "launch/gnuplot.h"

namespace fastball::launch {
namespace {

constexpr double kMilli = 1e3;

/// "mean right,mean up,sd right,sd up" [mm].
std::string landingFields(const CaseSummary& s) {
  return fmt::format("{:.3f},{:.3f},{:.3f},{:.3f}", kMilli * s.bias.x(), kMilli * s.bias.y(),
                     kMilli * s.deviation(0), kMilli * s.deviation(1));
}

std::string tableOf(const Causes& causes) {
  std::string csv =
      "error,throws,hit_percent_off,hit_low,hit_high,gain_percent,gain_low,gain_high,"
      "throws_alone,hit_percent_alone,alone_low,alone_high,mean_right_alone_mm,"
      "mean_up_alone_mm,sd_right_alone_mm,sd_up_alone_mm\n";
  csv += fmt::format("none off,{},{},,,,,,,,{}\n", causes.all.hits.of,
                     percentFields(causes.all.hits), landingFields(causes.all));
  for (const Cause& c : causes.causes)
    csv += fmt::format("{},{},{},{:.3f},{:.3f},{:.3f},{},{},{}\n", c.error, c.off.hits.of,
                       percentFields(c.off.hits), 100 * c.gain.value, 100 * c.gain.low,
                       100 * c.gain.high, c.alone.hits.of, percentFields(c.alone.hits),
                       landingFields(c.alone));
  return csv;
}

std::string spaced(std::string name) {
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

int heightOf(const Causes& causes) {
  return 150 + 30 * static_cast<int>(causes.causes.size());
}

std::string commandsOf(const Causes& causes, const std::string& strategy) {
  std::string tics;
  for (std::size_t n = 0; n < causes.causes.size(); ++n)
    tics += fmt::format("{}{} {}", n == 0 ? "" : ", ", quoted(spaced(causes.causes[n].error)),
                        -static_cast<int>(n));
  return kStyle + fmt::format(R"gp(set multiplot title {} font ',14'
set tmargin at screen {}; set bmargin at screen {}; set yrange [{}:0.7]; set style fill solid 1
set lmargin at screen 0.15; set rmargin at screen 0.57
set ytics ({}) scale 0
set xlabel "gain of hits with the error switched off\n(percentage points, 95 % intervals)"; set xrange [*:*]
set arrow 1 from 0, graph 0 to 0, graph 1 nohead lw 1 lc rgb '#404040' front
plot $c u 2:1:(0):2:($1-0.32):($1+0.32) w boxxyerror fc rgb {}, \
  '' u 2:1:3:4 w xerrorbars pt 7 ps 0.4 lw 1.6 lc rgb '#000000'
unset arrow 1; unset ytics
set lmargin at screen 0.60; set rmargin at screen 0.98
set xlabel "landings with this error alone (mm): standard deviations\nand distance of the mean from the centre"; set xrange [0:*]
set key at graph 0.5,1.01 bottom center horizontal
plot $c u 5:1:(0):5:($1):($1+0.36) w boxxyerror fc rgb {} title 'sd right', \
  '' u 6:1:(0):6:($1-0.36):($1) w boxxyerror fc rgb {} title 'sd up', \
  '' u 7:1 w p pt 7 ps 1 lc rgb '#000000' title '|mean|'
unset multiplot
)gp",
                              quoted(fmt::format("Causes of misses, strategy {}: {:.1f} % of {} "
                                                 "throws hit with all errors",
                                                 strategy, 100 * causes.all.hits.value(),
                                                 causes.all.hits.of)),
                              1 - 70.0 / heightOf(causes), 70.0 / heightOf(causes),
                              0.3 - static_cast<double>(causes.causes.size()), tics, kColours[0],
                              kColours[2], kYellow);
}

std::string dataOf(const Causes& causes) {
  std::string data;
  for (std::size_t n = 0; n < causes.causes.size(); ++n) {
    const Cause& c = causes.causes[n];
    data += fmt::format("{} {} {} {} {} {} {}\n", -static_cast<int>(n), 100 * c.gain.value,
                        100 * c.gain.low, 100 * c.gain.high, kMilli * c.alone.deviation(0),
                        kMilli * c.alone.deviation(1), kMilli * c.alone.bias.norm());
  }
  return dataBlock("c", data);
}

}  // namespace

std::vector<std::string> drawCauses(const CampaignResults& results, const std::string& folder) {
  std::vector<std::string> names;
  for (const std::string& strategy : strategiesOf(results.campaign)) {
    const Causes causes = causesOf(results, strategy);
    if (causes.causes.empty())
      continue;
    names.push_back("causes-" + strategy);
    const std::string path_stem = folder + "/" + names.back();
    writeText(tableOf(causes), path_stem + ".csv");
    drawPicture(path_stem, 1200, heightOf(causes), dataOf(causes), commandsOf(causes, strategy));
  }
  return names;
}

}  // namespace fastball::launch
