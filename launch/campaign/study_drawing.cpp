// Hit rates over what an ordered study varies.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "launch/campaign/campaign_drawing.h"
#include "launch/figures/style.h"
#include "launch/gnuplot.h"

namespace fastball::launch {
namespace {

constexpr double kMilli = 1e3;
constexpr const char* kTimes = " (times)";

struct Point {
  double value;
  std::size_t case_index;
};

/// The cases of one strategy in the order of the quantity.
struct Curve {
  std::string strategy;
  std::vector<Point> points;
};

/// All curves over one quantity.
struct Axis {
  std::string quantity;
  std::vector<Curve> curves;
};

/// With nothing varied an error has its own size.
bool isOnceOf(const Case& one, const std::string& quantity) {
  const std::string times = kTimes;
  return !one.quantity && variantOf(one).empty() && quantity.size() > times.size() &&
         quantity.compare(quantity.size() - times.size(), times.size(), times) == 0;
}

Axis axisOf(const CampaignResults& results, const std::string& quantity) {
  Axis axis{quantity, {}};
  for (const std::string& strategy : strategiesOf(results.campaign)) {
    Curve curve{strategy, {}};
    for (const std::size_t i : casesOfStrategy(results.campaign, strategy)) {
      const Case& one = results.campaign.cases[i];
      if (results.summaries[i].hits.of == 0)
        continue;
      if (one.quantity && one.quantity->name == quantity)
        curve.points.push_back({one.quantity->value, i});
      else if (isOnceOf(one, quantity))
        curve.points.push_back({1, i});
    }
    std::sort(curve.points.begin(), curve.points.end(),
              [](const Point& a, const Point& b) { return a.value < b.value; });
    axis.curves.push_back(curve);
  }
  return axis;
}

std::vector<Axis> axesOf(const CampaignResults& results) {
  std::vector<std::string> quantities;
  for (const Case& one : results.campaign.cases) {
    if (one.quantity &&
        std::find(quantities.begin(), quantities.end(), one.quantity->name) == quantities.end())
      quantities.push_back(one.quantity->name);
  }
  std::vector<Axis> axes;
  for (const std::string& quantity : quantities)
    axes.push_back(axisOf(results, quantity));
  return axes;
}

/// What gnuplot needs to know of the horizontal axis.
struct Range {
  double least = 0, most = 0;
  bool logarithmic = false;
  /// Where curve number `n` of `curves` stands, so that their intervals do not hide one another.
  double aside(double value, std::size_t n, std::size_t curves) const {
    const double step = 0.012 * (static_cast<double>(n) - (static_cast<double>(curves) - 1) / 2);
    return logarithmic ? value * std::pow(most / least, step) : value + step * (most - least);
  }
  std::string commands() const {
    if (logarithmic)
      return fmt::format("set logscale x; set format x '10^{{%T}}'; set xrange [{}:{}]\n",
                         least / 1.3, most * 1.3);
    const double margin = 0.06 * (most - least);
    return fmt::format("set xrange [{}:{}]\n", least - margin, most + margin);
  }
};

Range rangeOf(const Axis& axis) {
  std::vector<double> values;
  for (const Curve& curve : axis.curves) {
    for (const Point& point : curve.points)
      values.push_back(point.value);
  }
  if (values.empty())
    return {0, 1, false};
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  constexpr double kWide = 20;
  if (*least == *most)
    return {*least - 1, *most + 1, false};
  return {*least, *most, *least > 0 && *most > kWide * *least};
}

/// A curve's lines: value aside, hits [%], low, high, standard deviations right and up [mm], value.
std::string curveData(const CampaignResults& results,
                      const Curve& curve,
                      const Range& range,
                      std::size_t n,
                      std::size_t curves) {
  std::string data;
  for (const Point& point : curve.points) {
    const CaseSummary& s = results.summaries[point.case_index];
    data += fmt::format("{:.6g} {:.4f} {:.4f} {:.4f}", range.aside(point.value, n, curves),
                        100 * s.hits.value(), 100 * s.hits.low(), 100 * s.hits.high());
    data += s.landed > 1
                ? fmt::format(" {:.3f} {:.3f}\n", kMilli * s.deviation(0), kMilli * s.deviation(1))
                : " NaN NaN\n";
  }
  return data.empty() ? "NaN NaN NaN NaN NaN NaN\n" : data;
}

std::string blocksOf(const CampaignResults& results, const Axis& axis, std::size_t number) {
  std::string blocks;
  const Range range = rangeOf(axis);
  for (std::size_t n = 0; n < axis.curves.size(); ++n)
    blocks += dataBlock(fmt::format("curve{}x{}", number, n),
                        curveData(results, axis.curves[n], range, n, axis.curves.size()));
  return blocks;
}

std::string hitPlot(const Axis& axis, std::size_t number, double size) {
  std::string plot;
  for (std::size_t n = 0; n < axis.curves.size(); ++n)
    plot += fmt::format("{}$curve{}x{} u 1:2:3:4 w yerrorlines pt {} ps {} lw 2 lc rgb {} title {}",
                        n == 0 ? "plot " : ", ", number, n, kMarks[n % 4], size, kColours[n % 4],
                        quoted(axis.curves[n].strategy));
  return plot + '\n';
}

std::string scatterPlot(const Axis& axis) {
  std::string plot;
  for (std::size_t n = 0; n < axis.curves.size(); ++n)
    plot += fmt::format(
        "{0}$curve0x{1} u 1:5 w lp pt {2} ps 1.2 lw 2 lc rgb {3} title {4}, "
        "$curve0x{1} u 1:6 w lp pt {2} ps 1.2 lw 2 dt 2 lc rgb {3} title {5}",
        n == 0 ? "plot " : ", ", n, kMarks[n % 4], kColours[n % 4],
        quoted(axis.curves[n].strategy + ", right"), quoted(axis.curves[n].strategy + ", up"));
  return plot + '\n';
}

std::string oneAxisCommands(const Axis& axis) {
  return kStyle +
         fmt::format(R"gp(set multiplot layout 1,2 margins 0.07,0.985,0.13,0.86 spacing 0.08,0
set xlabel {}
{}set key at graph 0.5,1.02 center bottom horizontal
set ylabel 'hits (%), with 95 % intervals'; set yrange [0:102]
{}set ylabel 'standard deviation of the landings (mm)'; set yrange [0:*]
{}unset multiplot
)gp",
                     quoted(axis.quantity), rangeOf(axis).commands(), hitPlot(axis, 0, 1.2),
                     scatterPlot(axis));
}

/// "grasp offset" of "grasp_offset (times)".
std::string shortName(std::string quantity) {
  if (const std::size_t at = quantity.find(kTimes); at != std::string::npos)
    quantity.resize(at);
  std::replace(quantity.begin(), quantity.end(), '_', ' ');
  return quantity;
}

std::string allAxesCommands(const std::vector<Axis>& axes, int columns, int rows) {
  std::string commands = kStyle + fmt::format(R"gp(set termoption noenhanced
set multiplot layout {},{} title 'Hits (%) with one error at so many times its size, with 95 % intervals' font ',14'
set yrange [0:105]; set ytics 25; set xtics 1; set tmargin 1.8; set bmargin 2; set lmargin 5; set rmargin 1.5
)gp",
                                              rows, columns);
  for (std::size_t number = 0; number < axes.size(); ++number) {
    commands += number == 0 ? "set key bottom left font ',9'\n" : "set key off\n";
    commands +=
        fmt::format("set title {} font ',11' offset 0,-0.7\n{}",
                    quoted(shortName(axes[number].quantity)), rangeOf(axes[number]).commands());
    commands += hitPlot(axes[number], number, 0.8);
  }
  return commands + "unset multiplot\n";
}

std::string tableOf(const CampaignResults& results, const std::vector<Axis>& axes) {
  std::string csv =
      "quantity,value,strategy,throws,hit_percent,hit_low,hit_high,clean_percent,"
      "clean_low,clean_high,sd_right_mm,sd_up_mm\n";
  for (const Axis& axis : axes) {
    for (const Curve& curve : axis.curves) {
      for (const Point& point : curve.points) {
        const CaseSummary& s = results.summaries[point.case_index];
        csv += fmt::format("{},{:g},{},{},{},{},", axis.quantity, point.value, curve.strategy,
                           s.hits.of, percentFields(s.hits), percentFields(s.cleans));
        csv += s.landed > 1 ? fmt::format("{:.3f},{:.3f}\n", kMilli * s.deviation(0),
                                          kMilli * s.deviation(1))
                            : ",\n";
      }
    }
  }
  return csv;
}

}  // namespace

std::vector<std::string> drawStudy(const CampaignResults& results, const std::string& folder) {
  const std::vector<Axis> axes = axesOf(results);
  if (axes.empty())
    return {};
  writeText(tableOf(results, axes), folder + "/study.csv");
  std::string blocks;
  for (std::size_t number = 0; number < axes.size(); ++number)
    blocks += blocksOf(results, axes[number], number);
  if (axes.size() == 1) {
    drawPicture(folder + "/study", 1200, 480, blocks, oneAxisCommands(axes.front()));
  } else {
    const int columns = 5, rows = (static_cast<int>(axes.size()) + columns - 1) / columns;
    drawPicture(folder + "/study", 1400, 60 + 220 * rows, blocks,
                allAxesCommands(axes, columns, rows));
  }
  return {"study"};
}

}  // namespace fastball::launch
