#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "launch/figures/elastic_release.h"
#include "launch/figures/figure.h"
#include "launch/figures/planned_swing.h"
#include "launch/figures/release_shift.h"
#include "launch/figures/style.h"
#include "launch/figures/table.h"
#include "launch/gnuplot.h"
#include "model/contact.h"

namespace fastball::launch {
namespace {

constexpr double kMilli = 1e3;
const std::vector<double> kCourses = {3e4, 1e5, 1e6, 1e7};  // [Pa], drawn over time
const std::vector<double> kRates = {100, 450, 900};         // [N/s]
constexpr double kCourseRate = 450;                         // [N/s], of the courses
const std::vector<double> kGrips = {3, 6, 12};              // [N], of the thumb
constexpr double kFirst = 2e4, kLast = 2e7;                 // [Pa], of the delays
constexpr int kPerDecade = 6;

std::vector<double> moduli() {
  std::vector<double> result;
  for (int k = 0; kFirst * std::pow(10, static_cast<double>(k) / kPerDecade) <= kLast * 1.001; ++k)
    result.push_back(kFirst * std::pow(10, static_cast<double>(k) / kPerDecade));
  return result;
}

model::BallParameters undamped(model::BallParameters ball) {
  ball.damping_ratio = 0;
  return ball;
}

/// Force and displacement over time, the rigid ball's force last.
Table courses(const Unloading& situation, Table* ends) {
  Table table{{"t (ms)"}, {}};
  std::vector<model::ElasticMotion> motions;
  std::size_t rows = 0;
  for (const double modulus : kCourses) {
    table.columns.push_back(fmt::format("F'y (N) at {:.0e} Pa", modulus));
    table.columns.push_back(fmt::format("displacement (mm) at {:.0e} Pa", modulus));
    motions.push_back(elasticRelease(situation, modulus));
    rows = std::max(rows, motions.back().elastic.size());
    ends->rows.push_back({modulus, kMilli * motions.back().t_release, recovery(motions.back())});
  }
  table.columns.push_back("F'y (N) rigid");
  const model::RollingMotion rigid = rigidRelease(situation);
  for (std::size_t k = 0; k < rows; ++k) {
    std::vector<double> row{kMilli * 1e-4 * static_cast<double>(k)};
    for (const model::ElasticMotion& motion : motions) {
      const bool known = k + 1 < motion.elastic.size();
      const bool on = known && motion.elastic[k].t <= motion.t_release;
      row.push_back(on ? motion.elastic[k].force_F.y() : kNoNumber);
      row.push_back(on ? -kMilli * motion.elastic[k].p_FBall.y() : kNoNumber);
    }
    row.push_back(k + 1 < rigid.samples.size() ? rigid.samples[k].force_F.y() : kNoNumber);
    table.rows.push_back(row);
  }
  return table;
}

/// How much later than the rigid ball the elastic one leaves.
Table delays(const model::BallParameters& ball) {
  Table table{{"E (Pa)"}, {}};
  std::vector<Unloading> situations;
  std::vector<double> rigid;
  for (const double rate : kRates) {
    for (const bool damped : {false, true}) {
      table.columns.push_back(
          fmt::format("delay (ms) at {:g} N/s; {}", rate, damped ? "damped" : "undamped"));
      situations.push_back(unloading(damped ? ball : undamped(ball), rate));
      rigid.push_back(rigidRelease(situations.back()).t_release);
    }
  }
  for (const double modulus : moduli()) {
    std::vector<double> row{modulus};
    for (std::size_t i = 0; i < situations.size(); ++i)
      row.push_back(kMilli * (elasticRelease(situations[i], modulus).t_release - rigid[i]));
    table.rows.push_back(row);
  }
  return table;
}

/// From the command to the thumb of the planned throw until the ball leaves.
Table departures(const PlannedRelease& release) {
  Table table{{"E (Pa)"}, {}};
  for (const double grip : kGrips)
    table.columns.push_back(fmt::format("departure (ms) from a grip of {:g} N", grip));
  for (const double modulus : moduli()) {
    std::vector<double> row{modulus};
    for (const double grip : kGrips) {
      model::BallParameters ball = release.experiment.ball;
      ball.youngs_modulus = modulus;
      model::ReleaseCommand command = release.command;
      command.grip_force = grip;
      if (grip > model::maximumForce(ball)) {
        row.push_back(kNoNumber);
        continue;
      }
      const model::Departure departure =
          model::predictDeparture(ball, model::Hand(release.experiment.hand), command,
                                  release.hand_at, release.experiment.arm.gravity);
      row.push_back(departure.departed ? kMilli * departure.time : kNoNumber);
    }
    table.rows.push_back(row);
  }
  return table;
}

/// "3·10^{4}", for gnuplot.
std::string power(double number) {
  const int exponent = static_cast<int>(std::floor(std::log10(number) + 1e-9));
  const double factor = number / std::pow(10, exponent);
  return fmt::format("{}10^{{{}}}", factor > 1.01 ? fmt::format("{:.0f}·", factor) : "", exponent);
}

std::string courseCurves(int column, const char* rigid) {
  std::string plot = rigid;
  for (std::size_t i = 0; i < kCourses.size(); ++i) {
    plot += fmt::format(", $c u 1:{} w l lw 2.5 lc rgb {} title 'E = {} Pa'",
                        column + 2 * static_cast<int>(i), kColours[i], power(kCourses[i]));
  }
  return plot + "\n";
}

std::string delayCurves(double damping) {
  std::string plot = fmt::format(
      "plot NaN w l lw 2 lc rgb '#404040' title 'ζ = 0', NaN w l lw 2 dt 2 lc rgb "
      "'#404040' title 'ζ = {:g}'",
      damping);
  for (std::size_t i = 0; i < kRates.size(); ++i) {
    plot += fmt::format(
        ", $d u 1:{} w l lw 2.5 lc rgb {} title '{:g} N/s', $d u 1:{} w l lw 2 dt 2 lc rgb {}",
        2 + 2 * i, kColours[i], kRates[i], 3 + 2 * i, kColours[i]);
  }
  return plot + "\n";
}

std::string departureCurves() {
  std::string plot = "plot";
  for (std::size_t i = 0; i < kGrips.size(); ++i) {
    plot += fmt::format("{} $g u 1:{} w lp pt {} ps 0.8 lw 2 lc rgb {} title 'grip {:g} N'",
                        i ? "," : "", 2 + i, 5 + 2 * i, kColours[i], kGrips[i]);
  }
  return plot + "\n";
}

std::string commandsOf(const Unloading& situation, double damping, double last_time) {
  return kStyle +
         fmt::format(R"gp(set multiplot layout 2,2 margins 0.06,0.975,0.08,0.9 spacing 0.08,0.15 \
  title 'The elastic ball leaves a flat finger (section 5): its load falls by {:g} N/s from {:.2f} N' font ',15'
set xlabel 'time (ms)'; set xrange [0:{:.1f}]
set title 'normal force, no damping' font ',12'; set ylabel "F'_y (N)"; set yrange [0:*]
{}set title 'displacement of the ball towards the fingers, no damping' font ',12'
set ylabel "-y' (mm)"; set yrange [0:*]
{}set title 'delay of the release against the rigid ball' font ',12'
set logscale x; set format x '10^{{%T}}'
set xlabel "Young's modulus E (Pa)"; set ylabel 'delay (ms)'; set xrange [{}:{}]
{}set title 'the planned throw: departure after the command to the thumb' font ',12'
set ylabel 'departure (ms)'
{}unset multiplot
)gp",
                     situation.rate, rigidRelease(situation).samples.front().force_F.y(), last_time,
                     courseCurves(2, "plot $c u 1:10 w l lw 4 lc rgb '#b0b0b0' title 'rigid'"),
                     courseCurves(3, "plot 0 w l lw 1 lc rgb '#404040'"), kFirst, kLast,
                     delayCurves(damping), departureCurves());
}

/// From which E on [Pa] the column is between 1 and 10 ms, "a few"; and to which.
std::string fewMilliseconds(const Table& table, std::size_t column) {
  double from = 0, to = 0;
  for (const auto& row : table.rows) {
    if (row[column] < 1 || row[column] > 6)
      continue;
    from = from > 0 ? from : row[0];
    to = row[0];
  }
  return from > 0 ? fmt::format("{:.0e} to {:.0e} Pa", from, to) : "no E";
}

bool falls(const Table& table, std::size_t column) {
  for (std::size_t i = 1; i < table.rows.size(); ++i) {
    if (!(table.rows[i][column] < table.rows[i - 1][column]))
      return false;
  }
  return true;
}

double interpolated(const Table& table, std::size_t column, double modulus) {
  for (std::size_t i = 1; i < table.rows.size(); ++i) {
    const auto &a = table.rows[i - 1], &b = table.rows[i];
    if (modulus >= a[0] && modulus <= b[0]) {
      const double part = std::log(modulus / a[0]) / std::log(b[0] / a[0]);
      return a[column] + part * (b[column] - a[column]);
    }
  }
  return kNoNumber;
}

std::string captionOf(const Table& ends, const Table& delays, double damping) {
  std::string words = falls(delays, 3)
                          ? "The softer the ball, the later"
                          : "The release does not come later with every softer ball, but";
  words += fmt::format(
      " it leaves: {:.1f} ms after the rigid one at {:.0e} Pa and {:.1f} ms at {:.0e} Pa where the "
      "load falls by {:g} N/s, and {} the elastic energy throws it off the fingers: {:.2f} m/s at "
      "{:.0e} Pa, {:.2f} m/s at {:.0e} Pa. ",
      delays.rows.front()[3], delays.rows.front()[0], delays.rows.back()[3], delays.rows.back()[0],
      kCourseRate, ends.rows.front()[2] > ends.rows.back()[2] ? "the faster" : "no faster",
      ends.rows.front()[2], ends.rows.front()[0], ends.rows.back()[2], ends.rows.back()[0]);
  words += fmt::format("A delay of 1 to 6 ms, the paper's few, is that of {} at {:g} N/s",
                       fewMilliseconds(delays, 3), kCourseRate);
  words += fmt::format(" ({} with zeta = {:g}). ", fewMilliseconds(delays, 4), damping);
  if (!falls(delays, 1)) {
    words += fmt::format(
        "Where it falls by only {:g} N/s the ball swings on its finger before it leaves, and the "
        "delay goes up and down with E. ",
        kRates.front());
  }
  return words;
}

std::string departureWords(const Table& departures, const model::BallParameters& ball) {
  double least = INFINITY, most = 0;
  for (std::size_t i = 1; i <= kGrips.size(); ++i) {
    least = std::min(least, interpolated(departures, i, ball.youngs_modulus));
    most = std::max(most, interpolated(departures, i, ball.youngs_modulus));
  }
  return fmt::format(
      "In the planned throw, where the thumb squeezes until it opens, the ball of {:.0e} Pa leaves "
      "{:.1f} to {:.1f} ms after the command for grips of {:g} to {:g} N; the thumb's own way is "
      "part "
      "of that. Eq. (27) as printed lets the force fall again beyond y = 2a/3: a grip of {:g} N "
      "would have no equilibrium below E = {:.1e} Pa.",
      ball.youngs_modulus, least, most, kGrips.front(), kGrips.back(), kGrips.back(),
      27 * kGrips.back() / (4 * M_PI * ball.radius * ball.radius));
}

}  // namespace

std::string drawElasticRelease(const FigureTask& task) {
  const config::Experiment& e = task.experiment;
  const Unloading situation = unloading(undamped(e.ball), kCourseRate);
  Table ends{{"E (Pa)", "release (ms)", "speed off the fingers (m/s)"}, {}};
  const Table course_table = courses(situation, &ends), delay_table = delays(e.ball);
  const Table departure_table =
      departures(plannedRelease(e, planner::loadConfig(task.config), planPaperThrow(task)));
  const std::string stem = task.folder + "/fig14_15";
  writeCsv(course_table, stem + "-courses.csv");
  writeCsv(ends, stem + "-ends.csv");
  writeCsv(delay_table, stem + "-delays.csv");
  writeCsv(departure_table, stem + "-departures.csv");
  double last = 0;
  for (const auto& row : ends.rows)
    last = std::max(last, row[1]);
  drawPicture(stem, 1400, 950,
              dataBlock("c", plotData(course_table)) + dataBlock("d", plotData(delay_table)) +
                  dataBlock("g", plotData(departure_table)),
              commandsOf(situation, e.ball.damping_ratio, last + 1));
  return captionOf(ends, delay_table, e.ball.damping_ratio) +
         departureWords(departure_table, e.ball);
}

}  // namespace fastball::launch
