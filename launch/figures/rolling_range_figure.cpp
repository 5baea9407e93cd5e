#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "launch/figures/figure.h"
#include "launch/figures/printed_rolling.h"
#include "launch/figures/rolling_range.h"
#include "launch/figures/style.h"
#include "launch/figures/table.h"
#include "launch/gnuplot.h"

namespace fastball::launch {
namespace {

constexpr double kDegree = M_PI / 180, kMilli = 1e3;
constexpr double kLongest = 0.2;  // [s], on the fingers
// Of the map: the hand's acceleration [m/s^2] and the fingers' lean [degrees].
constexpr int kLeast = 10, kMost = 120, kPart = 5;
constexpr int kLeastLean = -40, kMostLean = 80, kPartLean = 5;
const std::vector<double> kSpeeds = {1, 2, 3, 4, 5, 6, 7, 8, 10, 12, 15, 18};  // [m/s]

/// The three swings whose courses are drawn: acceleration [m/s^2] and lean [degrees].
struct Course {
  const char* name;
  double acceleration, lean;
};
constexpr Course kCourses[] = {{"fingers along the arm", 50, 0},
                               {"fingers leaning forwards", 100, 70},
                               {"fingers leaning back", 10, -40}};

CircleSwing swing(double acceleration, double lean_degrees) {
  CircleSwing result;
  result.acceleration = acceleration;
  result.lean = lean_degrees * kDegree;
  return result;
}

/// The ball on the fingers of this hand, in swings.
struct Roller {
  model::BallParameters ball;
  model::FingerPair fingers;
  double gravity;
  model::RollingTask task() const { return {0, kLongest, gravity}; }
  model::RollingMotion roll(const CircleSwing& s, double longest = kLongest) const {
    model::RollingTask long_task = task();
    long_task.t_end = longest;
    return model::rollOnFingers(ball, fingers, s, long_task);
  }
  model::RollingMotion printed(const CircleSwing& s) const {
    return rollAsPrinted(ball, fingers, s, task());
  }
};

/// All that the figure shows.
struct Content {
  Table courses, map, speeds;
  std::vector<RollOutcome> outcomes, printed;  // of kCourses
  double fingertip = 0, palm = 0;              // [m], x' at which the ball comes to them
  double largest_difference = 0;               // [m], of the printed equations' distance on the map
  double slip_share = 0;  // of the map's throws that roll: slips before the release
};

Table coursesTable(const Roller& roller, Content* content) {
  Table table{{"t (ms)"}, {}};
  std::vector<std::vector<model::RollingSample>> columns;
  std::size_t rows = 0;
  for (const Course& course : kCourses) {
    const CircleSwing s = swing(course.acceleration, course.lean);
    const model::RollingMotion motion = roller.roll(s), printed = roller.printed(s);
    content->outcomes.push_back(outcomeOf(motion));
    content->printed.push_back(outcomeOf(printed));
    for (const auto* m : {&motion, &printed}) {
      const char* who = m == &motion ? "" : " as printed";
      table.columns.push_back(fmt::format("x' (mm){}; {}", who, course.name));
      table.columns.push_back(fmt::format("F'y (N){}; {}", who, course.name));
      columns.push_back(m->samples);
      rows = std::max(rows, m->samples.size());
    }
  }
  // The last sample of each is its release, off the grid of the others.
  for (std::size_t k = 0; k < rows; k += 2) {
    std::vector<double> row{kMilli * 1e-4 * static_cast<double>(k)};
    for (const auto& samples : columns) {
      const bool on = k + 1 < samples.size();
      row.push_back(on ? kMilli * samples[k].p_FBall.x() : kNoNumber);
      row.push_back(on ? samples[k].force_F.y() : kNoNumber);
    }
    table.rows.push_back(row);
  }
  return table;
}

Table mapTable(const Roller& roller, Content* content) {
  Table table{{"acceleration (m/s^2)", "lean (degrees)", "x' at the release (mm)", "release (ms)",
               "slips from (ms)", "x' as printed (mm)"},
              {}};
  int rolled = 0, slipped = 0;
  for (int lean = kLeastLean; lean <= kMostLean; lean += kPartLean) {
    for (int a = kLeast; a <= kMost; a += kPart) {
      const CircleSwing s = swing(a, lean);
      const model::RollingMotion motion = roller.roll(s);
      const RollOutcome outcome = outcomeOf(motion), printed = outcomeOf(roller.printed(s));
      const bool rolls = outcome.kind != RollKind::kNone;
      const bool slips = motion.t_slip >= 0 && rolls;
      rolled += rolls;
      slipped += slips;
      if (motion.released && std::abs(outcome.distance) < content->fingertip) {
        content->largest_difference =
            std::max(content->largest_difference, std::abs(printed.distance - outcome.distance));
      }
      table.rows.push_back({static_cast<double>(a), static_cast<double>(lean),
                            rolls ? kMilli * outcome.distance : kNoNumber, kMilli * outcome.time,
                            slips ? kMilli * motion.t_slip : kNoNumber, kMilli * printed.distance});
    }
  }
  content->slip_share = rolled > 0 ? static_cast<double>(slipped) / rolled : 0;
  return table;
}

/// The first course at other speeds.
Table speedsTable(const Roller& roller) {
  Table table{{"speed (m/s)", "x' at the release (mm)", "release (ms)",
               "x' at the release without gravity and drag (mm)"},
              {}};
  Roller weightless = roller;
  weightless.gravity = 0;
  weightless.ball.drag_coefficient = 0;
  const CircleSwing first = swing(kCourses[0].acceleration, kCourses[0].lean);
  for (const double speed : kSpeeds) {
    const CircleSwing s = first.faster(speed / first.speed);
    const double longest = kLongest * std::max(1.0, first.speed / speed);
    const RollOutcome outcome = outcomeOf(roller.roll(s, longest)),
                      free = outcomeOf(weightless.roll(s, longest));
    table.rows.push_back(
        {speed, kMilli * outcome.distance, kMilli * outcome.time, kMilli * free.distance});
  }
  return table;
}

std::string coursePanels(const Content& c) {
  std::string x = "plot 0 w l lw 1 lc rgb '#404040'", force = x;
  for (int i = 0; i < 3; ++i) {
    const int at = 2 + 4 * i;
    x += fmt::format(", $c u 1:{} w l lw 2.5 lc rgb {} title '{}, {} m/s²'", at, kColours[i],
                     kCourses[i].name, kCourses[i].acceleration);
    force += fmt::format(", $c u 1:{} w l lw 2.5 lc rgb {}", at + 1, kColours[i]);
    x += fmt::format(", $c u 1:{} w l lw 1.5 dt 2 lc rgb {}", at + 2, kColours[i]);
    force += fmt::format(", $c u 1:{} w l lw 1.5 dt 2 lc rgb {}", at + 3, kColours[i]);
  }
  x += ", NaN w l lw 1.5 dt 2 lc rgb '#404040' title 'Eqs. (21), (22) as printed'";
  x += fmt::format(
      ", {:.2f} w l dt 3 lw 1.5 lc rgb {} title 'fingertip, palm', {:.2f} w l dt 3 lw 1.5 lc rgb "
      "{}",
      kMilli * c.fingertip, kGrey, kMilli * c.palm, kGrey);
  return fmt::format(R"gp(set xlabel 'time from the opening of the grasping finger (ms)'
set xrange [0:100]
set key top left
set title 'rolling distance until the release' font ',12'
set ylabel "x' (mm)"; set yrange [-50:105]
{}
set title 'normal force' font ',12'
set ylabel "F'_y (N)"; set yrange [0:*]
{}
)gp",
                     x, force);
}

std::string commandsOf(const Content& c) {
  return kStyle +
         std::string(R"gp(set multiplot layout 2,2 margins 0.065,0.93,0.08,0.9 spacing 0.12,0.15 \
  title 'Rolling on the two fingers after the grasping finger has opened (section 3.1), 6 m/s' font ',15'
)gp") + coursePanels(c) +
         fmt::format(
             R"gp(set title 'rolling distance at the release; hatched: gone at once; dots: drawn above' font ',12'
set xlabel 'acceleration of the hand as the finger opens (m/s²)'
set ylabel 'lean of the fingers forwards (°)'
set xrange [{}:{}]; set yrange [{}:{}]
set palette defined (-60 '#0072B2', 0 '#ffffff', 60 '#D55E00')
set cbrange [-60:60]; set cblabel "x' (mm)" offset 0.5,0
set object 1 rectangle from graph 0,0 to graph 1,1 behind fc rgb '#909090' fs pattern 4 noborder
unset grid
plot $m u 1:2:3 w image, \
  $o u 1:2 w p pt 7 ps 1.6 lc rgb '#000000'
unset object 1; set grid lc rgb '#e4e4e4'
set title 'the first swing at other speeds along the same path' font ',12'
set xlabel 'speed of the hand (m/s)'; set ylabel "x' at the release (mm)"
set xrange [0:{}]; set yrange [-15:75]; set key top right at graph 0.98,0.41
plot 0 w l lw 1 lc rgb '#404040', \
  {:.2f} w l dt 3 lw 1.5 lc rgb {} title 'fingertip', \
  $s u 1:4 w l dt 2 lw 1.5 lc rgb {} title 'without gravity and drag', \
  $s u 1:2 w lp pt 7 lw 2.5 lc rgb {} title 'this ball'
unset multiplot
)gp",
             kLeast - kPart / 2.0, kMost + kPart / 2.0, kLeastLean - kPartLean / 2.0,
             kMostLean + kPartLean / 2.0, kSpeeds.back() + 1, kMilli * c.fingertip, kGrey, kGrey,
             kColours[0]);
}

std::string courseWords(const Content& c) {
  std::string words;
  for (std::size_t i = 0; i < c.outcomes.size(); ++i) {
    const RollOutcome &o = c.outcomes[i], &p = c.printed[i];
    const std::string how =
        o.kind == RollKind::kNone
            ? "the ball is gone as soon as the finger opens"
            : fmt::format(
                  "it rolls {:+.1f} mm in {:.1f} ms (by the printed equations {:+.1f} mm in "
                  "{:.1f} ms)",
                  kMilli * o.distance, kMilli * o.time, kMilli * p.distance, kMilli * p.time);
    words += fmt::format("{}{}, at {:g} m/s^2, {}", i ? "; " : "", kCourses[i].name,
                         kCourses[i].acceleration, how);
  }
  return words + ". ";
}

std::string captionOf(const Content& c) {
  const auto& slow = c.speeds.rows.front();
  const auto& fast = c.speeds.rows.back();
  return "Whether the ball rolls to the fingertips, to the palm or not at all is decided by the "
         "hand's acceleration and the fingers' posture: " +
         courseWords(c) +
         fmt::format(
             "The equations know no hand: the ball would meet this one's palm at {:+.0f} and roll "
             "off "
             "its fingers at {:+.0f} mm. ",
             kMilli * c.palm, kMilli * c.fingertip) +
         fmt::format(
             "From {:g} to {:g} m/s on the same path the distance at the release goes from {:+.0f} "
             "to {:+.0f} mm and no further, because without gravity and drag it does not depend on "
             "the speed at all ({:.0f} mm): the time on the fingers shrinks as the accelerations "
             "grow. ",
             slow[0], fast[0], slow[1], fast[1], fast[3]) +
         fmt::format(
             "Of the throws of the map that roll, {:.0f} % slip before the release, which Eq. (19) "
             "excludes; the printed equations (5/7 for a plane although the ball lies in a groove, "
             "no angular acceleration of the hand, no slip, no drag) are up to {:.1f} mm off among "
             "the throws that stay within the {:.0f} mm to the fingertip.",
             100 * c.slip_share, kMilli * c.largest_difference, kMilli * c.fingertip);
}

}  // namespace

std::string drawRollingRange(const FigureTask& task) {
  const config::Experiment& e = task.experiment;
  Roller roller{e.ball, model::fingersBehind(e.hand, e.ball.radius), e.arm.gravity};
  roller.fingers.X_HF.setIdentity();
  Content content;
  content.fingertip = fingertipPastBall(e.hand, e.ball.radius);
  content.palm = e.hand.palm_distance + e.ball.radius - e.hand.p_HBall.z();
  content.courses = coursesTable(roller, &content);
  content.map = mapTable(roller, &content);
  content.speeds = speedsTable(roller);
  const std::string stem = task.folder + "/fig08";
  writeCsv(content.courses, stem + "-courses.csv");
  writeCsv(content.map, stem + "-map.csv");
  writeCsv(content.speeds, stem + "-speeds.csv");
  std::string shown;
  for (const Course& course : kCourses)
    shown += fmt::format("{} {}\n", course.acceleration, course.lean);
  drawPicture(stem, 1400, 950,
              dataBlock("c", plotData(content.courses)) + dataBlock("m", plotData(content.map)) +
                  dataBlock("s", plotData(content.speeds)) + dataBlock("o", shown),
              commandsOf(content));
  return captionOf(content);
}

}  // namespace fastball::launch
