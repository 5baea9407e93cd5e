#include "launch/figures/planned_swing.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "launch/figures/style.h"
#include "launch/figures/table.h"
#include "launch/gnuplot.h"

namespace fastball::launch {
namespace {

constexpr double kStep = 1e-3;  // [s]

enum Column {
  kTime,
  kSwing1,
  kSwing2,
  kSwing3,
  kSpeed1,
  kTorque1 = kSpeed1 + 4,
  kSpeedShare = kTorque1 + 4,
  kTorqueShare,
  kHand
};

Table planTable(const model::Arm& arm, const planner::Plan& plan, const Eigen::Vector3d& p_TBall) {
  Table table;
  table.columns = {"t (s)", "dq1 of the model (rad/s)", "dq2 of the model (rad/s)",
                   "dq3 of the model (rad/s)"};
  for (const char* what : {"dJ{} (rad/s)", "tau{} (N m)"}) {
    for (int j = 1; j <= model::kArmJoints; ++j)
      table.columns.push_back(fmt::format(fmt::runtime(what), j));
  }
  table.columns.insert(table.columns.end(),
                       {"speed share (%)", "torque share (%)", "hand speed (m/s)"});
  const double duration = plan.trajectory.duration() - plan.t_swing;
  for (int i = 0; i * kStep <= duration; ++i) {
    const model::ArmMotion m = plan.trajectory.at(plan.t_swing + i * kStep);
    const Eigen::Vector3d swing = swingSpeeds(arm, m);
    const Eigen::Vector4d tau = arm.inverseDynamics(m.q, m.qd, m.qdd) + arm.frictionTorque(m.qd);
    std::vector<double> row{i * kStep, swing[0], swing[1], swing[2]};
    row.insert(row.end(), m.qd.data(), m.qd.data() + model::kArmJoints);
    row.insert(row.end(), tau.data(), tau.data() + model::kArmJoints);
    row.push_back(100 * arm.speedRatio(m.qd));
    row.push_back(100 * arm.torqueRatio(tau));
    row.push_back((arm.pointJacobian(m.q, p_TBall) * m.qd).norm());
    table.rows.push_back(row);
  }
  return table;
}

/// Vertical lines for the whole picture: release, change of sign, follow-through.
std::string marks(const planner::Plan& plan) {
  const double release = plan.t_release - plan.t_swing,
               turn = parameter(plan, "t_switch2") - plan.t_swing,
               brake = plan.t_swing_end - plan.t_swing;
  std::string commands;
  int tag = 1;
  for (const auto& [t, look] : {std::pair(release, fmt::format("dt 2 lc rgb {}", kGrey)),
                                std::pair(turn, fmt::format("dt 3 lw 1.5 lc rgb {}", kColours[1])),
                                std::pair(brake, std::string("dt 4 lc rgb '#a0a0a0'"))}) {
    commands += fmt::format("set arrow {} from {:.4f}, graph 0 to {:.4f}, graph 1 nohead {}\n",
                            tag++, t, t, look);
  }
  // One above the other, right of all lines; colours and dashes tell which is which.
  const double right = std::max({release, turn, brake});
  return commands +
         fmt::format(
             "set label 1 'ball leaves (dashes)' at {0:.4f}, graph 0.19 offset 0.7,0 tc rgb {1}\n"
             "set label 2 'ω_2 changes sign (dots)' at {0:.4f}, graph 0.12 offset 0.7,0 tc rgb "
             "{2}\n"
             "set label 3 'braking begins' at {0:.4f}, graph 0.05 offset 0.7,0 tc rgb '#808080'\n",
             right, kGrey, kColours[1]);
}

std::string curves(int first, int count, const char* symbol, const Eigen::Vector4d* limits) {
  std::string plot = "plot 0 w l lw 1 lc rgb '#404040'";
  for (int j = 0; j < count; ++j) {
    plot +=
        fmt::format(", $p u 1:{} w l lw 2.5 lc rgb {} title '{}_{}{}'", first + j + 1, kColours[j],
                    symbol, j + 1, limits ? fmt::format(" (limit {:.3g})", (*limits)[j]) : "");
  }
  return plot + "\n";
}

std::string commandsOf(const model::ArmParameters& arm,
                       const planner::Plan& plan,
                       const Table& table) {
  return kStyle +
         fmt::format(R"(set multiplot layout 2,2 margins 0.06,0.975,0.075,0.9 spacing 0.07,0.13 \
  title 'The planned swing of the analogous model on the arm {}' font ',15'
set xrange [0:{:.3f}]
set key top left
set title 'joints of the swing model (section 2.6)' font ',12'
set ylabel 'speed (rad/s)'; set yrange [-6:9]
{}{}unset label 1; unset label 2; unset label 3
set title 'joints of the arm' font ',12'
{}set title 'torques of the arm, with friction, drives and gravity' font ',12'
set ylabel 'torque (N m)'; set yrange [-60:90]
set xlabel 'time from the start of the swing (s)'
{}set title 'nearest limit, with the differential of joints 2 and 3' font ',12'
set ylabel 'share of the limit (%)'; set yrange [0:125]
plot 100 w l lw 1 dt 2 lc rgb '#404040', $p u 1:{} w l lw 2.5 lc rgb {} title 'speed', \
  $p u 1:{} w l lw 2.5 lc rgb {} title 'torque'
unset multiplot
)",
                     arm.profile, table.rows.back()[kTime], marks(plan),
                     curves(kSwing1, 3, "dq", nullptr), curves(kSpeed1, 4, "dJ", &arm.qd_max),
                     curves(kTorque1, 4, "τ", &arm.tau_max), kSpeedShare + 1, kColours[0],
                     kTorqueShare + 1, kColours[1]);
}

double largest(const Table& table, int column) {
  double value = table.rows.front()[column];
  for (const auto& row : table.rows)
    value = std::max(value, row[column]);
  return value;
}

std::string captionOf(const config::Experiment& e,
                      const model::Arm& arm,
                      const planner::Plan& plan,
                      const Table& table) {
  const Eigen::Vector3d swing = swingSpeeds(arm, plan.trajectory.at(plan.t_release));
  const double turn = parameter(plan, "t_switch2");
  const Eigen::Vector3d& p_WTarget = e.target.p_WTarget;
  const double shoulder = plan.trajectory.at(plan.t_release).q[1];
  double moved = 0;
  for (const auto& row : table.rows) {
    const double t = plan.t_swing + row[kTime];
    if (t <= plan.t_swing_end)
      moved = std::max(moved, std::abs(plan.trajectory.at(t).q[1] - shoulder));
  }
  return fmt::format(
             "The plan '{}' for the net at ({:g}, {:g}, {:g}) m with the arm {}: the ball leaves "
             "at {:.2f} m/s "
             "(hand at most {:.2f} m/s). ",
             plan.strategy, p_WTarget.x(), p_WTarget.y(), p_WTarget.z(), e.arm.profile,
             plan.release.v_WBall.norm(), largest(table, kHand)) +
         fmt::format(
             "omega2 changes sign {:.3f} s after the start of the swing, {:.0f} ms {} the ball "
             "leaves; the swing "
             "model's joints turn at ({:.2f}, {:.2f}, {:.2f}) rad/s when it leaves. ",
             turn - plan.t_swing, 1e3 * std::abs(plan.t_release - turn),
             turn <= plan.t_release ? "before" : "after", swing[0], swing[1], swing[2]) +
         fmt::format(
             "The motion uses at most {:.0f} % of the limits of speed and {:.0f} % of those of "
             "torque. Joint 2 of "
             "the arm is at {:.2f} rad and moves by {:.2f} rad during the swing.",
             largest(table, kSpeedShare), largest(table, kTorqueShare), shoulder, moved);
}

}  // namespace

std::string drawPlannedSwing(const FigureTask& task) {
  const planner::Plan plan = planPaperThrow(task);
  const model::Arm arm(task.experiment.arm, task.experiment.hand.payload);
  const Table table = planTable(arm, plan, task.experiment.hand.p_HBall);
  const std::string stem = task.folder + "/fig05b";
  writeCsv(table, stem + ".csv");
  drawPicture(stem, 1400, 900, dataBlock("p", plotData(table)),
              commandsOf(task.experiment.arm, plan, table));
  return captionOf(task.experiment, arm, plan, table);
}

}  // namespace fastball::launch
