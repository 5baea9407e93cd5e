#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "launch/figures/figure.h"
#include "launch/figures/style.h"
#include "launch/figures/table.h"
#include "launch/figures/tracking.h"
#include "launch/gnuplot.h"
#include "model/arm.h"

namespace fastball::launch {
namespace {

using Row = Eigen::Map<const Eigen::Vector4d>;

/// What the planned motion and one law's simulated motion are at one tick.
struct Moment {
  double t = 0;  ///< [s] from the start of the swing
  model::ArmMotion planned;
  Eigen::Vector4d q, qd;
};

std::vector<Moment> swingOf(const TrackedThrow& tracked) {
  std::vector<Moment> moments;
  for (const arm_state_t& state : tracked.states) {
    const double t = tracked.time(state);
    if (t < tracked.plan.t_swing || t > tracked.planned.duration())
      continue;
    moments.push_back(
        {t - tracked.plan.t_swing, tracked.planned.at(t), Row(state.q), Row(state.qd)});
  }
  return moments;
}

/// How well a law follows the plan while the arm swings.
struct Deviation {
  Eigen::Vector4d q = Eigen::Vector4d::Zero();  ///< [rad], largest
  double hand = 0;             ///< [m], largest distance of the end effector from its planned place
  double hand_at_release = 0;  ///< [m]
  double overshoot1 = 0;       ///< [rad/s], of joint 1's highest speed over the planned one
};

Deviation deviation(const model::Arm& arm,
                    const Eigen::Vector3d& p_TBall,
                    const std::vector<Moment>& moments,
                    double t_release) {
  Deviation result;
  double planned1 = 0, simulated1 = 0;
  for (const Moment& m : moments) {
    const double distance =
        (arm.p_WPoint(m.q, p_TBall) - arm.p_WPoint(m.planned.q, p_TBall)).norm();
    result.q = result.q.cwiseMax((m.q - m.planned.q).cwiseAbs());
    result.hand = std::max(result.hand, distance);
    if (m.t <= t_release)
      result.hand_at_release = distance;
    planned1 = std::max(planned1, std::abs(m.planned.qd[0]));
    simulated1 = std::max(simulated1, std::abs(m.qd[0]));
  }
  result.overshoot1 = simulated1 - planned1;
  return result;
}

enum Column {
  kTime,
  kPlannedX,
  kPdX = kPlannedX + 3,
  kForwardX = kPdX + 3,
  kPlannedSpeed = kForwardX + 3,
  kPdSpeed = kPlannedSpeed + 4,
  kForwardSpeed = kPdSpeed + 4,
  kPdError = kForwardSpeed + 4,
  kForwardError,
  kElbowZ,
  kColumns
};

Table trackingTable(const model::Arm& arm,
                    const Eigen::Vector3d& p_TBall,
                    const std::vector<Moment>& pd,
                    const std::vector<Moment>& forward) {
  Table table{{"t (s)"}, {}};
  for (const char* who : {"planned", "Eq. (26)", "feed-forward"})
    for (const char axis : {'x', 'y', 'z'})
      table.columns.push_back(fmt::format("{} {} (m)", axis, who));
  for (const char* who : {"planned", "Eq. (26)", "feed-forward"})
    for (int j = 1; j <= model::kArmJoints; ++j)
      table.columns.push_back(fmt::format("dJ{} {} (rad/s)", j, who));
  table.columns.insert(
      table.columns.end(),
      {"off the plan Eq. (26) (mm)", "off the plan feed-forward (mm)", "elbow z planned (m)"});
  for (std::size_t i = 0; i < std::min(pd.size(), forward.size()); ++i) {
    const model::ArmMotion& planned = pd[i].planned;
    const Eigen::Vector3d p = arm.p_WPoint(planned.q, p_TBall),
                          p_pd = arm.p_WPoint(pd[i].q, p_TBall),
                          p_forward = arm.p_WPoint(forward[i].q, p_TBall);
    std::vector<double> row{pd[i].t};
    for (const Eigen::Vector3d& point : {p, p_pd, p_forward})
      row.insert(row.end(), point.data(), point.data() + 3);
    for (const Eigen::Vector4d& qd : {planned.qd, pd[i].qd, forward[i].qd})
      row.insert(row.end(), qd.data(), qd.data() + 4);
    row.push_back(1e3 * (p_pd - p).norm());
    row.push_back(1e3 * (p_forward - p).norm());
    // The end of the upper arm's line is the elbow.
    row.push_back(
        (arm.X_WLink(planned.q, 2) * Eigen::Vector3d(0, 0, arm.parameters().dh[2].d)).z());
    table.rows.push_back(row);
  }
  return table;
}

/// The path in the plane of two axes (0: x, 1: y, 2: z).
std::string pathPanel(int first, int second, bool with_titles) {
  const auto curve = [&](int x, const std::string& look, const char* title) {
    return fmt::format("$p u {}:{} w l {} {}", x + first + 1, x + second + 1, look,
                       with_titles ? fmt::format("title '{}'", title) : "notitle");
  };
  return fmt::format(
      "plot {}, {}, {}, $r u {}:{} w p pt 7 ps 1.4 lc rgb '#000000' {}",
      curve(kPlannedX, "lw 5 lc rgb '#c0c0c0'", "planned"),
      curve(kPdX, fmt::format("lw 2 lc rgb {}", kColours[1]), "simulated, Eq. (26)"),
      curve(kForwardX, fmt::format("lw 2 dt 2 lc rgb {}", kColours[0]), "simulated, feed-forward"),
      first + 1, second + 1, with_titles ? "title 'ball leaves'" : "notitle");
}

/// The range of a column, with room about it.
std::string range(const Table& table, int column, double room) {
  double low = 1e300, high = -1e300;
  for (const auto& row : table.rows) {
    low = std::min(low, row[column]);
    high = std::max(high, row[column]);
  }
  return fmt::format("[{:.3f}:{:.3f}]", low - room, high + room);
}

std::string speedPanel() {
  std::string plot =
      "plot NaN w l lw 5 lc rgb '#c0c0c0' title 'planned', NaN w l lw 2 lc rgb '#404040' title "
      "'Eq. (26)', NaN w l lw 2 dt 2 lc rgb '#404040' title 'feed-forward'";
  for (int j = 0; j < model::kArmJoints; ++j) {
    plot += fmt::format(", $p u 1:{} w l lw 5 lc rgb '#d0d0d0'", kPlannedSpeed + j + 1);
    plot += fmt::format(", $p u 1:{} w l lw 2 lc rgb {} title 'J{}'", kPdSpeed + j + 1, kColours[j],
                        j + 1);
    plot += fmt::format(", $p u 1:{} w l lw 2 dt 2 lc rgb {}", kForwardSpeed + j + 1, kColours[j]);
  }
  return plot + "\n";
}

std::string commandsOf(const std::string& profile, const Table& table, double t_release) {
  return kStyle +
         fmt::format(R"(set multiplot layout 2,2 margins 0.06,0.975,0.075,0.9 spacing 0.08,0.14 \
  title 'The plan on the simulated arm {}' font ',15'
set size ratio -1
set title 'path of the end effector, from the side' font ',12'
set xlabel 'x (m)'; set ylabel 'z (m)'
set xrange {}
set yrange {}
set key top left
{}, $p u {}:{} w l lw 1.5 dt 4 lc rgb {} title 'elbow'
set title 'from above' font ',12'; set ylabel 'y (m)'
set yrange {}
{}
set size noratio
set autoscale x
)",
                     profile, range(table, kPlannedX, 0.05), range(table, kPlannedX + 2, 0.25),
                     pathPanel(0, 2, false), kPlannedX + 1, kElbowZ + 1, kGrey,
                     range(table, kPlannedX + 1, 0.1), pathPanel(0, 1, true)) +
         fmt::format(R"(set key top left maxrows 3
set arrow 1 from {0:.4f}, graph 0 to {0:.4f}, graph 1 nohead dt 2 lc rgb {1}
set label 1 'ball leaves' at {0:.4f}, graph 0.04 offset 0.5,0 tc rgb {1}
set xlabel 'time from the start of the swing (s)'
set title 'joint speeds' font ',12'; set ylabel 'speed (rad/s)'; set yrange [-8:11]
{2}unset label 1
set title 'distance of the end effector from its planned place' font ',12'
set ylabel 'distance (mm)'; set yrange [0:*]
plot $p u 1:{3} w l lw 2 lc rgb {4} title 'Eq. (26)', \
  $p u 1:{5} w l lw 2 dt 2 lc rgb {6} title 'feed-forward'
unset multiplot
)",
                     t_release, kGrey, speedPanel(), kPdError + 1, kColours[1], kForwardError + 1,
                     kColours[0]);
}

std::string milliradians(const Eigen::Vector4d& q) {
  return fmt::format("({:.1f}, {:.1f}, {:.1f}, {:.1f}) mrad", 1e3 * q[0], 1e3 * q[1], 1e3 * q[2],
                     1e3 * q[3]);
}

/// What the path of the end effector is like while the arm swings, up to t_end [s].
std::string pathWords(const Table& table, double t_end, double z_release) {
  double low = 1e9, high = -1e9, elbow = 0;
  for (const auto& row : table.rows) {
    if (row[kTime] > t_end)
      break;
    low = std::min(low, row[kPlannedX + 2]);
    high = std::max(high, row[kPlannedX + 2]);
    elbow = row[kElbowZ];
  }
  return fmt::format(
      "The end effector moves between z = {:+.2f} and {:+.2f} m during the swing and is at {:+.2f} "
      "m "
      "when the ball leaves, {:.2f} m {} the elbow. ",
      low, high, z_release, std::abs(z_release - elbow), z_release < elbow ? "below" : "above");
}

std::string deviationWords(const Deviation& pd, const Deviation& forward) {
  return fmt::format(
      "Largest errors of the joints from the start of the swing to rest: {} by Eq. (26), {} by "
      "feed-forward; of the end effector {:.1f} and {:.1f} mm, when the ball leaves {:.1f} and "
      "{:.1f} "
      "mm. The highest speed of joint 1 differs from the planned one by {:+.3f} and {:+.3f} rad/s.",
      milliradians(pd.q), milliradians(forward.q), 1e3 * pd.hand, 1e3 * forward.hand,
      1e3 * pd.hand_at_release, 1e3 * forward.hand_at_release, pd.overshoot1, forward.overshoot1);
}

}  // namespace

std::string drawTracking(const FigureTask& task) {
  const TrackedThrow pd = trackedThrow(task.config, "gravity_pd"),
                     forward = trackedThrow(task.config, "feed_forward");
  const config::Experiment& e = task.experiment;
  const model::Arm arm(e.arm, e.hand.payload);
  const std::vector<Moment> pd_swing = swingOf(pd), forward_swing = swingOf(forward);
  const double t_release = pd.plan.t_release - pd.plan.t_swing;
  const Table table = trackingTable(arm, e.hand.p_HBall, pd_swing, forward_swing);
  const Eigen::Vector3d p = arm.p_WPoint(pd.planned.at(pd.plan.t_release).q, e.hand.p_HBall);
  const std::string stem = task.folder + "/fig11";
  writeCsv(table, stem + ".csv");
  drawPicture(stem, 1400, 950,
              dataBlock("p", plotData(table)) +
                  dataBlock("r", fmt::format("{} {} {}\n", p.x(), p.y(), p.z())),
              commandsOf(e.arm.profile, table, t_release));
  return "The same plan followed by Eq. (26) and by full feed-forward. " +
         pathWords(table, pd.plan.t_swing_end - pd.plan.t_swing, p.z()) +
         deviationWords(deviation(arm, e.hand.p_HBall, pd_swing, t_release),
                        deviation(arm, e.hand.p_HBall, forward_swing, t_release));
}

}  // namespace fastball::launch
