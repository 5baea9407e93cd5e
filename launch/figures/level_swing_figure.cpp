#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "launch/figures/figure.h"
#include "launch/figures/level_swing.h"
#include "launch/figures/style.h"
#include "launch/figures/table.h"
#include "launch/gnuplot.h"

namespace fastball::launch {
namespace {

constexpr double kScarce = 0.1;  // of the limits of torque, in the second column
// [rad/s, 1/s, rad/s]: swings of half a second and more, as the paper's. Without such a bound the
// fastest ones are flicks of a tenth of a second, to which nothing in Eq. (15) objects.
const Eigen::Vector3d kOmegaMax(4, 6, 7);
constexpr int kStarts = 24;
constexpr int64_t kSeed = 1;
constexpr int kRows = 600;

/// Of the table.
enum Column { kTime, kSpeed1 = 4, kTorque1 = 7, kTorque2 };

/// One column of the figure.
struct Optimum {
  LevelSwing level;
  SwingLimits limits;
  Table table;
};

Optimum optimum(const FigureTask& task, double torque_share) {
  const model::LevelSwingModel model(model::swingParameters(
      task.experiment.arm, task.experiment.hand.payload, task.experiment.hand.p_HBall));
  Optimum result;
  result.limits = levelSwingLimits(task.experiment.arm, kOmegaMax, torque_share);
  result.level = fastestLevelSwing(model, result.limits, kStarts, kSeed);
  if (result.level.release_speed == 0)
    throw std::runtime_error("Eq. (15) has no solution with these limits");
  result.table.columns = {"t (s)",       "q1 (rad)",    "q2 (rad)",    "q3 (rad)",
                          "dq1 (rad/s)", "dq2 (rad/s)", "dq3 (rad/s)", "tau1 (N m)",
                          "tau2 (N m)",  "tau3 (N m)",  "speed (m/s)"};
  const BaseSwing& swing = result.level.swing;
  for (int i = 0; i <= kRows; ++i) {
    const double t = swing.start() + (swing.end() - swing.start()) * i / kRows;
    const model::SwingAngles s = swing.at(t);
    const Eigen::Vector3d tau = model.inverseDynamics(s.q, s.qd, s.qdd);
    result.table.rows.push_back({t - swing.start(), s.q[0], s.q[1], s.q[2], s.qd[0], s.qd[1],
                                 s.qd[2], tau[0], tau[1], tau[2],
                                 model.endEffectorVelocity(s.q, s.qd).norm()});
  }
  return result;
}

/// Speeds or torques over the time, with the times of release and change of sign.
std::string panel(const Optimum& o, const char* block, bool torque) {
  const double zero = o.level.swing.start();
  std::string commands = fmt::format(
      "set xrange [0:{:.4f}]\nset arrow 1 from {:.4f}, graph 0 to {:.4f}, graph 1 nohead dt 2 lc "
      "rgb {}\n"
      "set arrow 2 from {:.4f}, graph 0 to {:.4f}, graph 1 nohead dt 3 lw 1.5 lc rgb {}\n",
      o.level.swing.end() - zero, -zero, -zero, kGrey, o.level.swing.q2.t_switch - zero,
      o.level.swing.q2.t_switch - zero, kColours[1]);
  if (!torque) {
    commands += fmt::format(
        "set label 1 'release' at {:.4f}, graph 0.05 right offset -0.5,0 tc rgb {}\n"
        "set label 2 'ω_2 changes sign' at {:.4f}, graph 0.05 offset 0.5,0 tc rgb {}\n",
        -zero, kGrey, o.level.swing.q2.t_switch - zero, kColours[1]);
  } else {
    commands += "unset label 1; unset label 2\n";
  }
  commands += "plot 0 w l lw 1 lc rgb '#404040'";
  for (int j = 0; j < 3; ++j) {
    commands += fmt::format(", ${} u 1:{} w l lw 2.5 lc rgb {} title '{} (limit {:.3g})'", block,
                            (torque ? kTorque1 : kSpeed1) + j + 1, kColours[j],
                            fmt::format("{}_{}", torque ? "τ" : "dq", j + 1),
                            torque ? o.limits.tau_max[j] : o.limits.qd_max[j]);
  }
  return commands + "\n";
}

/// "12 ms before the release".
std::string beside(double t, const std::string& what) {
  const double ms = 1e3 * t;
  if (std::abs(ms) < 0.5)
    return "at " + what;
  return fmt::format("{:.0f} ms {} {}", std::abs(ms), ms < 0 ? "before" : "after", what);
}

/// When joint 1 peaks: the order of the kinetic chain is from the shoulder outwards.
std::string order(const BaseSwing& swing) {
  const auto peak = [](const model::SinBase& base) { return -base.phi / base.omega; };
  return "joint 1 is fastest " +
         beside(peak(swing.q1) - peak(swing.q3), "the moment at which joint 3 is");
}

std::string captionOf(const std::string& profile, const Optimum& full, const Optimum& scarce) {
  const BaseSwing& swing = full.level.swing;
  const Eigen::Vector3d speeds = 100 * swing.at(0).qd.cwiseQuotient(full.limits.qd_max);
  double before = 0, after = 0, most3 = 0;
  for (const auto& row : full.table.rows) {
    if (row[kTime] < swing.q2.t_switch - swing.start())
      before = row[kTorque2];
    else if (after == 0)
      after = row[kTorque2];
    most3 = std::max(most3, std::abs(row[kTorque2 + 1]));
  }
  return fmt::format(
             "Eq. (15) for the first model with the data of {}: {:.2f} m/s at the release. Joints "
             "1, 2, 3 then turn "
             "at {:.0f}, {:.0f}, {:.0f} % of their speed limits, and the swing needs {:.0f} % of "
             "the torque limits. ",
             profile, full.level.release_speed, speeds[0], speeds[1], speeds[2],
             100 * full.level.torque_share) +
         fmt::format(
             "omega2 changes sign {:.3f} s after the start, {}, and the torque of joint 2 falls "
             "from {:+.1f} to "
             "{:+.1f} N m. Joint 3 gets its speed with {:.0f} % of its torque. Joints 1 and 3 move "
             "by sines, joint 2 "
             "by an exponential; {}. ",
             swing.q2.t_switch - swing.start(), beside(swing.q2.t_switch, "the release"), before,
             after, 100 * most3 / full.limits.tau_max[2], order(swing)) +
         fmt::format(
             "With {:.0f} % of the torques (right) the release is at {:.2f} m/s, omega2 changes "
             "sign {}, and {}.",
             100 * kScarce, scarce.level.release_speed,
             beside(scarce.level.swing.q2.t_switch, "the release"), order(scarce.level.swing));
}

}  // namespace

std::string drawLevelSwing(const FigureTask& task) {
  const Optimum full = optimum(task, 1), scarce = optimum(task, kScarce);
  const std::string stem = task.folder + "/fig05";
  writeCsv(full.table, stem + "-all-torque.csv");
  writeCsv(scarce.table, stem + "-scarce-torque.csv");
  const std::string data =
      dataBlock("full", plotData(full.table)) + dataBlock("scarce", plotData(scarce.table));
  const std::string commands =
      kStyle +
      fmt::format(R"(set multiplot layout 2,2 margins 0.065,0.975,0.075,0.9 spacing 0.07,0.1 \
  title 'The optimal swing of the first model, Eq. (15) with the data of {}' font ',15'
set key top left
set format x ''
set ylabel 'speed (rad/s)'
set yrange [-1.6:7]
set title 'all torque' font ',12'
{}set title '{:.0f} % of the torques' font ',12'
{}set format x '%g'
set xlabel 'time from t_s (s)'
unset title
set ylabel 'torque (N m)'
set yrange [-30:45]
{}set yrange [-12:18]
{}unset multiplot
)",
                  task.experiment.arm.profile, panel(full, "full", false), 100 * kScarce,
                  panel(scarce, "scarce", false), panel(full, "full", true),
                  panel(scarce, "scarce", true));
  drawPicture(stem, 1400, 900, data, commands);
  return captionOf(task.experiment.arm.profile, full, scarce);
}

}  // namespace fastball::launch
