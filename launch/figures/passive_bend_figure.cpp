#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "launch/figures/figure.h"
#include "launch/figures/passive_bend.h"
#include "launch/figures/style.h"
#include "launch/figures/table.h"
#include "launch/gnuplot.h"

namespace fastball::launch {
namespace {

// Only dq3 / dq1 changes the shape of the motion, so the speeds are free; Eq. (6) has dq1 >> dq3.
constexpr double kSteadyQd1 = 8, kSteadyQd3 = 1;  // [rad/s], of the joint that is not varied
const std::vector<double> kQd1 = {4, 6, 8, 10}, kQd3 = {0.5, 1, 1.5, 2};  // [rad/s]
constexpr double kStart = 0.3;                                            // [rad] from pi/2
constexpr double kDuration = 8 * M_PI;  // [s]: whole turns of joint 3 at each of these speeds
constexpr double kStep = 0.01;          // [s]
constexpr double kHeavy = 10;           // times the mass of the upper arm, where Eq. (4) holds
constexpr double kMostRatio = 1.6;      // of dq3 to dq1 in the sweep
constexpr double kSweepStep = 0.02;
constexpr double kSweepTurns = 20;  // of joint 1, at least

/// Motions of several dq1 or several dq3, with their fits.
struct Family {
  std::vector<BendMotion> motions;
  std::vector<Oscillation> fits;
};

Family family(const model::SwingModel& model,
              const std::vector<double>& qd1,
              const std::vector<double>& qd3) {
  Family result;
  for (const double a : qd1) {
    for (const double b : qd3) {
      result.motions.push_back(passiveBend(model, a, b, M_PI / 2 - kStart, kDuration, kStep));
      result.fits.push_back(oscillation(result.motions.back().q2));
    }
  }
  return result;
}

Table curves(const Family& family) {
  Table table{{"t (s)"}, {}};
  for (const BendMotion& m : family.motions)
    table.columns.push_back(fmt::format("q2 (rad) at dq1 = {} dq3 = {} rad/s", m.qd1, m.qd3));
  const std::vector<double>& t = family.motions[0].q2.t;
  for (std::size_t i = 0; i < t.size(); ++i) {
    std::vector<double> row{t[i]};
    for (const BendMotion& m : family.motions)
      row.push_back(m.q2.y[i]);
    table.rows.push_back(row);
  }
  return table;
}

Table fits(const Family& family) {
  Table table{{"dq1 (rad/s)", "dq3 (rad/s)", "omega (rad/s)", "mean (rad)"}, {}};
  for (std::size_t i = 0; i < family.fits.size(); ++i) {
    const Oscillation& f = family.fits[i];
    table.rows.push_back({family.motions[i].qd1, family.motions[i].qd3, f.omega, f.mean});
  }
  return table;
}

std::vector<double> column(const Table& table, int index) {
  std::vector<double> values;
  for (const auto& row : table.rows)
    values.push_back(row[index]);
  return values;
}

/// Fitted frequency over dq1 for dq3 / dq1 from 0 up, with the WAM's masses and with a heavy upper
/// arm; none where joint 2 has turned past the axis.
Table sweep(const model::SwingParameters& wam) {
  model::SwingParameters heavy = wam;
  heavy.m1 *= kHeavy;
  Table table{{"dq3 / dq1", "omega / dq1 of the arm", "omega / dq1 with a heavy upper arm"}, {}};
  for (int i = 1; i * kSweepStep < kMostRatio; ++i) {
    const double ratio = i * kSweepStep;
    const double duration = 2 * M_PI / ratio * std::ceil(kSweepTurns * ratio);
    std::vector<double> row{ratio};
    for (const model::SwingParameters& p : {wam, heavy}) {
      const BendMotion motion =
          passiveBend(model::LevelSwingModel(p), 1, ratio, M_PI / 2 - kStart, duration, 0.05);
      const auto [low, high] = std::minmax_element(motion.q2.y.begin(), motion.q2.y.end());
      row.push_back(*low > 0 && *high < M_PI ? oscillation(motion.q2).omega : kNoNumber);
    }
    table.rows.push_back(row);
  }
  return table;
}

/// The largest dq3 / dq1 up to which the column has numbers.
double boundedUpTo(const Table& sweep, int index) {
  double ratio = 0;
  for (const auto& row : sweep.rows) {
    if (!std::isfinite(row[index]))
      break;
    ratio = row[0];
  }
  return ratio;
}

std::string curvePanel(const std::string& block, const Family& family, bool varies_qd1) {
  std::string plot = "plot pi/2 w l dt 2 lw 1 lc rgb '#606060' notitle";
  for (std::size_t i = 0; i < family.motions.size(); ++i) {
    plot += fmt::format(", ${} u 1:{} w l lw 2 lc rgb {} title '{}'", block, i + 2, kColours[i % 4],
                        varies_qd1 ? fmt::format("dq_1 = {} rad/s", family.motions[i].qd1)
                                   : fmt::format("dq_3 = {} rad/s", family.motions[i].qd3));
  }
  return plot + "\n";
}

/// All that the figure shows.
struct Content {
  model::SwingInertias inertias;
  Family by_qd3, by_qd1;
  Table fits3, fits1, ratios;
};

std::string commandsOf(const Content& c) {
  const model::SwingInertias& i = c.inertias;
  return kStyle +
         fmt::format(R"(set multiplot layout 2,2 margins 0.07,0.975,0.085,0.88 spacing 0.075,0.14 \
  title 'Joint 2 of the swing model without torque (section 2.2)' font ',15'
set key top right horizontal
set xlabel 'time (s)'; set ylabel 'q_2 (rad)'
set xrange [0:3]; set yrange [1.0:2.4]
set label 1 'π/2' at graph 1.005, first pi/2 left font ',10'
set title 'dq_1 = {0} rad/s, dq_3 varied' font ',12'
{2}set title 'dq_3 = {1} rad/s, dq_1 varied' font ',12'
{3}unset label 1
set key top left vertical
set xrange [0:10.5]; set yrange [0:12]
set title 'Frequency, in the mean over whole turns of joint 3' font ',12'
set xlabel 'speed that is varied (rad/s)'; set ylabel 'ω_2 (rad/s)'
plot x w l dt 2 lw 1 lc rgb '#606060' title 'ω_2 = dq_1, Eq. (7)', \
  $f1 u 1:3 w lp pt 7 ps 1.2 lw 2 lc rgb '#0072B2' title 'dq_1 varied (dq_3 = {1} rad/s)', \
  $f3 u 2:3 w lp pt 5 ps 1.2 lw 2 lc rgb '#D55E00' title 'dq_3 varied (dq_1 = {0} rad/s)'
)",
                     kSteadyQd1, kSteadyQd3, curvePanel("c3", c.by_qd3, false),
                     curvePanel("c1", c.by_qd1, true)) +
         fmt::format(R"(set xrange [0:{}]; set yrange [0.6:1.3]
set key top right
set title 'How far that holds: faster joint 3' font ',12'
set xlabel 'dq_3 / dq_1'; set ylabel 'ω_2 / dq_1'
plot 1 w l dt 2 lw 1 lc rgb '#606060' title 'Eq. (7)', \
  $s u 1:2 w p pt 7 ps 0.7 lc rgb '#0072B2' title 'this arm, A_{{12}} / (J_1 + B_2) = {:.2f}', \
  $s u 1:3 w p pt 4 ps 0.9 lc rgb '#E69F00' title 'upper arm {:g} times as heavy: {:.2f}'
unset multiplot
)",
                     kMostRatio, i.A12 / (i.J1 + i.B2), kHeavy, i.A12 / (kHeavy * i.J1 + i.B2));
}

std::string captionOf(const Content& c) {
  std::vector<double> means = column(c.fits3, 3);
  for (const double mean : column(c.fits1, 3))
    means.push_back(mean);
  const auto [least, most] = std::minmax_element(means.begin(), means.end());
  return fmt::format(
             "Joint 2 oscillates about pi/2 (means {:.3f} to {:.3f} pi/2). Its frequency follows "
             "dq1 "
             "and not dq3: it changes by {:+.2f} rad/s per rad/s of dq1 and by {:+.2f} per rad/s "
             "of dq3. ",
             *least / (M_PI / 2), *most / (M_PI / 2),
             fitLine(column(c.fits1, 0), column(c.fits1, 2)).slope,
             fitLine(column(c.fits3, 1), column(c.fits3, 2)).slope) +
         fmt::format(
             "That holds while joint 3 is slow, as Eq. (6) assumes: up to dq3 = {:.2f} dq1 with "
             "this "
             "arm's masses ({:.2f} with an upper arm {:g} times as heavy, Eq. 4); beyond, joint 3 "
             "pumps "
             "the oscillation until joint 2 turns past the axis.",
             boundedUpTo(c.ratios, 1), boundedUpTo(c.ratios, 2), kHeavy);
}

}  // namespace

std::string drawPassiveBend(const FigureTask& task) {
  const model::SwingParameters wam = model::swingParameters(
      task.experiment.arm, task.experiment.hand.payload, task.experiment.hand.p_HBall);
  const model::LevelSwingModel model(wam);
  Content content;
  content.inertias = wam.inertias();
  content.by_qd3 = family(model, {kSteadyQd1}, kQd3);
  content.by_qd1 = family(model, kQd1, {kSteadyQd3});
  content.fits3 = fits(content.by_qd3);
  content.fits1 = fits(content.by_qd1);
  content.ratios = sweep(wam);
  const Table curves3 = curves(content.by_qd3), curves1 = curves(content.by_qd1);
  Table all_fits = content.fits3;
  all_fits.rows.insert(all_fits.rows.end(), content.fits1.rows.begin(), content.fits1.rows.end());
  const std::string stem = task.folder + "/fig04";
  writeCsv(curves3, stem + "-dq3-varied.csv");
  writeCsv(curves1, stem + "-dq1-varied.csv");
  writeCsv(all_fits, stem + "-fits.csv");
  writeCsv(content.ratios, stem + "-sweep.csv");
  const std::string data = dataBlock("c3", plotData(curves3)) + dataBlock("c1", plotData(curves1)) +
                           dataBlock("f3", plotData(content.fits3)) +
                           dataBlock("f1", plotData(content.fits1)) +
                           dataBlock("s", plotData(content.ratios));
  drawPicture(stem, 1400, 950, data, commandsOf(content));
  return captionOf(content);
}

}  // namespace fastball::launch
