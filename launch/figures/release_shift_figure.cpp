#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "launch/figures/figure.h"
#include "launch/figures/planned_swing.h"
#include "launch/figures/release_shift.h"
#include "launch/figures/style.h"
#include "launch/figures/table.h"
#include "launch/gnuplot.h"

namespace fastball::launch {
namespace {

constexpr double kMilli = 1e3;
constexpr double kFirst = -0.015, kLast = 0.015, kStep = 5e-4;  // [s], errors that are drawn
constexpr double kEarly = -kStep;  // [s], the last at which the hand surely pushes
constexpr double kLate = 0.008;    // [s], an error after which it does not

/// A way to let go, how it is called, and over which errors [s] it is a line.
struct Way {
  LetGo how;
  const char* name;
  double from, to;
};
const std::vector<Way> kWays = {
    {LetGo::kFreely, "ball simply let go", kFirst, kLast},
    {LetGo::kLongerOnFingers, "longer on the fingers, 5/7 (Fig. 9)", 0, kLast},
    {LetGo::kRolling, "thumb gone, rigid ball rolls and slips", kFirst, kEarly},
    {LetGo::kPrinted, "thumb gone, Eqs. (21), (22) as printed", kFirst, kEarly},
    {LetGo::kGently, "thumb faded out, elastic ball", kFirst, kEarly},
    {LetGo::kElastic, "thumb opens under its grip, elastic ball", kFirst, kLast},
};

std::vector<double> errorsOf(const Way& way) {
  std::vector<double> errors;
  for (int k = 0; way.from + k * kStep <= way.to + kStep / 2; ++k)
    errors.push_back(way.from + k * kStep);
  return errors;
}

/// Landing of every way, less that of a ball simply let go without error.
Table landings(const PlannedRelease& release) {
  Table table{{"error (ms)"}, {}};
  for (const Way& way : kWays) {
    table.columns.push_back(fmt::format("to the right (mm); {}", way.name));
    table.columns.push_back(fmt::format("up (mm); {}", way.name));
  }
  for (std::string& column : table.columns)
    for (std::size_t comma; (comma = column.find(',')) != std::string::npos;)
      column.erase(comma, 1);
  const Eigen::Vector2d aim = landing(release, LetGo::kFreely, 0);
  for (int k = 0; kFirst + k * kStep <= kLast + kStep / 2; ++k) {
    const double error = kFirst + k * kStep;
    std::vector<double> row{kMilli * error};
    for (const Way& way : kWays) {
      const bool shown = error > way.from - kStep / 2 && error < way.to + kStep / 2;
      Eigen::Vector2d off = Eigen::Vector2d::Constant(kNoNumber);
      if (shown)
        off = landing(release, way.how, error) - aim;
      row.insert(row.end(), {kMilli * off.x(), kMilli * off.y()});
    }
    table.rows.push_back(row);
  }
  return table;
}

Table shiftsTable(const std::vector<Eigen::Vector2d>& shifts) {
  Table table{{"way (in the order of the landings)", "from error (ms)", "to error (ms)",
               "to the right (mm/ms)", "up (mm/ms)", "together (mm/ms)"},
              {}};
  for (std::size_t i = 0; i < shifts.size(); ++i) {
    table.rows.push_back({static_cast<double>(i + 1), kMilli * kWays[i].from, kMilli * kWays[i].to,
                          shifts[i].x(), shifts[i].y(), shifts[i].norm()});
  }
  return table;
}

/// What the fingers feel of the hand about t = 0: its push along y', Eq. (24), and its drive along x', Eq. (25).
Table drives(const PlannedRelease& release) {
  Table table{
      {"t (ms)", "push alpha0y' - gy' (m/s^2)", "drive -alpha0x' + gx' (m/s^2)", "v0x' (m/s)"}, {}};
  for (double t = 2 * kFirst; t <= 2 * kLast; t += kStep) {
    const model::FingerFrameMotion f =
        model::fingerFrameMotion(release.fingers, release.hand_at(t));
    const Eigen::Vector3d g =
        f.X_WF.linear().transpose() * Eigen::Vector3d(0, 0, -release.experiment.arm.gravity);
    table.rows.push_back({kMilli * t, f.a_F.y() - g.y(), g.x() - f.a_F.x(), f.v_F.x()});
  }
  return table;
}

constexpr const char* kLooks[] = {"lw 5 lc rgb '#b0b0b0'",   "lw 2.5 dt 2 lc rgb '#000000'",
                                  "lw 2.5 lc rgb '#0072B2'", "lw 1.5 dt 4 lc rgb '#56B4E9'",
                                  "lw 2.5 lc rgb '#009E73'", "lw 2.5 lc rgb '#D55E00'"};

std::string landingPanel(int coordinate) {
  std::string plot = "plot 0 w l lw 1 lc rgb '#404040'";
  for (std::size_t i = 0; i < kWays.size(); ++i)
    plot += fmt::format(", $l u 1:{} w l {}", 2 + 2 * i + coordinate, kLooks[i]);
  return plot + "\n";
}

/// A panel without anything but the names of the ways.
std::string legend() {
  std::string plot =
      "unset border; unset tics; unset grid; unset xlabel; unset ylabel; unset title\n"
      "set key center left spacing 1.8\nset yrange [0:1]\nplot";
  for (std::size_t i = 0; i < kWays.size(); ++i)
    plot += fmt::format("{} NaN w l {} title {}", i ? "," : "", kLooks[i], quoted(kWays[i].name));
  return plot + "\n";
}

std::string commandsOf(const std::string& profile) {
  return kStyle +
         fmt::format(R"gp(set multiplot layout 2,2 margins 0.065,0.975,0.08,0.9 spacing 0.09,0.16 \
  title 'What an error in letting go does to the landing, planned throw, arm {}' font ',15'
set xlabel 'let go after the planned moment by (ms)'
set ylabel 'landing to the right (mm)'
set xrange [{}:{}]
set title 'across' font ',12'
{}set title 'upwards' font ',12'; set ylabel 'landing above (mm)'
{}set title "the hand in the fingers' frame" font ',12'
set xlabel 'time from Eq. (24) (ms)'; set ylabel 'acceleration (m/s²)'
set xrange [{}:{}]; set key center right
plot 0 w l lw 1 lc rgb '#404040', \
  $d u 1:2 w l lw 2.5 lc rgb {} title "push α'_{{0y}} - g'_y", \
  $d u 1:3 w l lw 2.5 lc rgb {} title "drive -α'_{{0x}} + g'_x"
{}unset multiplot
)gp",
                     profile, kMilli * kFirst, kMilli * kLast, landingPanel(0), landingPanel(1),
                     2 * kMilli * kFirst, 2 * kMilli * kLast, kColours[0], kColours[1], legend());
}

std::string shiftWords(const Eigen::Vector2d& shift, const Eigen::Vector2d& free) {
  return fmt::format("{:.1f} mm/ms ({:.0f} %)", shift.norm(), 100 * shift.norm() / free.norm());
}

/// Whether a rigid ball whose thumb is late leaves as if all fingers were gone.
bool lateIsFree(const PlannedRelease& release) {
  return (landing(release, LetGo::kRolling, kLate) - landing(release, LetGo::kFreely, kLate))
             .norm() < 1e-6;
}

/// Where the early thumb's ball comes off.
std::string fingertipWords(const PlannedRelease& release) {
  int at_tip = 0, all = 0;
  double longest = 0;
  for (double error = kFirst; error < kEarly + kStep / 2; error += kStep, ++all) {
    at_tip += rigidRoll(release, error, false).rolled_off;
    longest = std::max(longest, rigidRoll(release, error, true).samples.back().p_FBall.x());
  }
  return fmt::format(
      "In {} of these {} throws of the rigid ball it comes off at the fingertips, {:.0f} mm along, "
      "which section 3.1 excludes; on longer fingers it would roll up to {:.0f} mm, because "
      "rolling "
      "itself, 2 omega_z' dx' in Eq. (22), presses the ball on. ",
      at_tip, all, kMilli * release.fingertip, kMilli * longest);
}

std::string captionOf(const PlannedRelease& release, const std::vector<Eigen::Vector2d>& s) {
  const model::BallParameters& ball = release.experiment.ball;
  const double h = release.fingers.rollingHeight(ball.radius);
  const double share = 1 / (1 + ball.inertia() / (ball.mass * h * h));
  return fmt::format(
             "A ball simply let go moves its landing by {:.1f} mm for each millisecond of error "
             "({:+.1f} to the right, {:+.1f} up). One that comes off its fingers late and rolls on "
             "them until then (Fig. 9) moves it by {}: the 5/7 of Eq. (21) leave 2/7 = 29 % of the "
             "drive, the groove of these fingers would leave {:.0f} %. ",
             s[0].norm(), s[0].x(), s[0].y(), shiftWords(s[1], s[0]), 100 * (1 - share)) +
         fmt::format(
             "With contact forces that can only push, this happens where the thumb is early and "
             "gives no squeeze along: {} for the rigid ball with slip ({} by the equations as "
             "printed), {} for the elastic one. ",
             shiftWords(s[2], s[0]), shiftWords(s[3], s[0]), shiftWords(s[4], s[0])) +
         fingertipWords(release) +
         (lateIsFree(release)
              ? fmt::format("A thumb that is late by {:.0f} ms finds a hand that no longer pushes, "
                            "Eq. (24): nothing rolls, and the ball is simply let go. ",
                            kMilli * kLate)
              : "") +
         fmt::format(
             "A thumb that opens under its full grip lets the squeeze throw the ball off before it "
             "has rolled: {}.",
             shiftWords(s[5], s[0]));
}

}  // namespace

std::string drawReleaseShift(const FigureTask& task) {
  const PlannedRelease release =
      plannedRelease(task.experiment, planner::loadConfig(task.config), planPaperThrow(task));
  std::vector<Eigen::Vector2d> shifts;
  for (const Way& way : kWays)
    shifts.push_back(landingShift(release, way.how, errorsOf(way)));
  const Table landing_table = landings(release), drive_table = drives(release);
  const std::string stem = task.folder + "/fig09";
  writeCsv(landing_table, stem + "-landings.csv");
  writeCsv(shiftsTable(shifts), stem + "-shifts.csv");
  writeCsv(drive_table, stem + "-hand.csv");
  drawPicture(stem, 1400, 950,
              dataBlock("l", plotData(landing_table)) + dataBlock("d", plotData(drive_table)),
              commandsOf(task.experiment.arm.profile));
  return captionOf(release, shifts);
}

}  // namespace fastball::launch
