// Arm and ball at even times, and the landing.
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "launch/figures/style.h"
#include "launch/gnuplot.h"
#include "launch/report/target_face.h"
#include "launch/report/throw_pictures.h"
#include "launch/report/throw_times.h"
#include "launch/track_flight.h"
#include "model/arm.h"

namespace fastball::launch {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kStrobe = 0.05;       ///< [s], between two poses
constexpr double kHalfTick = 0.5e-3;   ///< [s]
constexpr double kBefore = 0.4;        ///< [s], the picture begins so long before the ball leaves
constexpr double kAfter = 0.05;        ///< [s], the arm is shown so long after it
constexpr double kLongestFlight = 10;  ///< [s], that is drawn
constexpr double kUpperArm = 0.55;     ///< [m], end of the upper arm's centre line, for drawing
constexpr double kMargin = 0.08;       ///< [m], about what is seen
constexpr int kWidth = 1000, kLeft = 66, kRight = 12, kTop = 40;                 ///< [px]
constexpr int kFace = 206, kBetween = 84, kBelow = 60, kLabels = 72, kKey = 30;  ///< [px]
constexpr const char *kBefores = "'#0072B2'", *kAfters = "'#D55E00'";

/// Coordinates of a throw: level towards the net, to the left, up.
class ThrowFrame {
 public:
  explicit ThrowFrame(const model::Target& target) : along_(target.p_WTarget) {
    along_.z() = 0;
    along_ = along_.norm() > 1e-6 ? Vector3d(along_.normalized()) : Vector3d::UnitX();
  }
  Vector3d of(const Vector3d& p_W) const {
    return {along_.dot(p_W), Vector3d::UnitZ().cross(along_).dot(p_W), p_W.z()};
  }

 private:
  Vector3d along_;
};

/// The arm's centre line from the shoulder to the ball in the hand.
std::vector<Vector3d> centreLine(const model::Arm& arm,
                                 const Eigen::Vector4d& q,
                                 const Vector3d& p_TBall) {
  return {Vector3d::Zero(),
          arm.X_WLink(q, 2) * Vector3d(0, 0, kUpperArm),
          arm.X_WLink(q, 3).translation(),
          arm.X_WLink(q, 4).translation(),
          arm.X_WT(q).translation(),
          arm.p_WPoint(q, p_TBall)};
}

/// What is drawn, for gnuplot: coordinates of the throw's frame [m].
struct Strobe {
  std::string arms_before, arms_after, balls_before, balls_after;
  std::string times;                  ///< of some balls, with words
  std::optional<Vector3d> departure;  ///< of the ball
  Eigen::AlignedBox3d box;
};

std::string line(const Vector3d& p) {
  return fmt::format("{:.4f} {:.4f} {:.4f}\n", p.x(), p.y(), p.z());
}

void addArm(const std::vector<Vector3d>& centre_line,
            const ThrowFrame& frame,
            bool is_before,
            bool has_ball,
            Strobe& strobe) {
  std::string& arms = is_before ? strobe.arms_before : strobe.arms_after;
  for (const Vector3d& p_W : centre_line) {
    arms += line(frame.of(p_W));
    strobe.box.extend(frame.of(p_W));
  }
  arms += "\n";
  if (has_ball)
    strobe.balls_before += line(frame.of(centre_line.back()));
}

void addArms(const ThrowRecord& record,
             const config::Experiment& experiment,
             const ThrowTimes& times,
             const ThrowFrame& frame,
             Strobe& strobe) {
  const model::Arm arm(experiment.arm, experiment.hand.payload);
  double next = -kBefore;
  for (const arm_state_t& state : record.arm) {
    const double t = times.at(state.utime);
    if (t < next - kHalfTick || t > kAfter + 2 * kHalfTick)
      continue;
    next += kStrobe * std::ceil((t + 2 * kHalfTick - next) / kStrobe);
    const bool is_before = t <= kHalfTick;
    const auto centre_line =
        centreLine(arm, Eigen::Map<const Eigen::Vector4d>(state.q), experiment.hand.p_HBall);
    if (times.departure && std::abs(t) <= kHalfTick)
      strobe.departure = frame.of(centre_line.back());
    addArm(centre_line, frame, is_before, is_before, strobe);
  }
}

void addBall(const Vector3d& p_W, double t, const ThrowFrame& frame, Strobe& strobe) {
  const Vector3d p = frame.of(p_W);
  strobe.balls_after += line(p);
  strobe.box.extend(p);
  const auto ms = std::lround(1e3 * t);
  if (ms % 200 == 0)
    strobe.times += fmt::format("{:.4f} {:.4f} \"{:+.1f} s\"\n", p.x(), p.z(), t);
}

/// From the tracker's last fit, which has seen the whole flight.
void addTrackedFlight(const ThrowRecord& record,
                      double gravity,
                      const ThrowTimes& times,
                      const ThrowFrame& frame,
                      Strobe& strobe) {
  const ball_track_t& fit = record.track.back();
  const double last = std::min(times.at(fit.landing_utime), kLongestFlight);
  for (int k = 1; k * kStrobe < last; ++k) {
    const auto utime = times.origin + static_cast<int64_t>(1e6 * kStrobe * k);
    addBall(flightAt(fit, utime, gravity).p_WBall, kStrobe * k, frame, strobe);
  }
}

void addTrueFlight(const LoggedThrow& thrown,
                   const model::Target& target,
                   const ThrowTimes& times,
                   const ThrowFrame& frame,
                   Strobe& strobe) {
  double next = kStrobe;
  for (const sim_truth_t& sample : thrown.flight) {
    const double t = times.at(sample.utime);
    const Eigen::Map<const Vector3d> p_W(sample.p_WBall);
    if (t < next - 1e-3 || target.distance(p_W) < 0 || t > kLongestFlight)
      continue;
    addBall(p_W, kStrobe * std::round(t / kStrobe), frame, strobe);
    next = t + kStrobe;
  }
}

std::string ringOutline(const model::Target& target, const ThrowFrame& frame, Strobe& strobe) {
  std::string outline;
  for (int i = 0; i <= 72; ++i) {
    const double angle = i * M_PI / 36;
    const Vector3d p =
        frame.of(target.p_WTarget + target.radius * (std::cos(angle) * target.rightAxis() +
                                                     std::sin(angle) * target.upAxis()));
    outline += line(p);
    strobe.box.extend(p);
  }
  return outline;
}

/// A picture's panels in pixels from the upper left corner.
class Sheet {
 public:
  explicit Sheet(const Eigen::AlignedBox3d& box) : box_(box) {
    const Vector3d size = box.sizes();
    side_ = static_cast<int>((kWidth - kLeft - kRight) * size.z() / size.x());
    above_width_ = kWidth - kLeft - kRight - 2 * (kFace + kBetween);
    above_ = static_cast<int>(above_width_ * size.y() / size.x());
    lower_ = std::max(above_ + kBelow + kKey, kFace);
  }
  int height() const { return kTop + side_ + kLabels + 24 + lower_ + kBelow; }
  std::string sidePanel() const {
    return margins(kLeft, kTop, kWidth - kLeft - kRight, side_) + ranges(2);
  }
  std::string abovePanel() const {
    return margins(kLeft, lowerTop(), above_width_, above_) + ranges(1);
  }
  /// 0: the whole net; 1: the landing enlarged.
  std::string facePanel(int i) const {
    return margins(kLeft + above_width_ + kBetween + i * (kFace + kBetween), lowerTop(), kFace,
                   kFace);
  }

  /// Below the view from above.
  std::string key() const {
    return fmt::format("set key at screen {:.5f},{:.5f} left bottom Left reverse vertical\n",
                       0.3 * kLeft / kWidth, static_cast<double>(kBelow) / height());
  }

 private:
  int lowerTop() const { return kTop + side_ + kLabels + 24; }
  std::string margins(int left, int top, int width, int height_of_panel) const {
    const double h = height();
    return fmt::format(
        "set lmargin at screen {:.5f}; set rmargin at screen {:.5f}\n"
        "set tmargin at screen {:.5f}; set bmargin at screen {:.5f}\n",
        static_cast<double>(left) / kWidth, static_cast<double>(left + width) / kWidth, 1 - top / h,
        1 - (top + height_of_panel) / h);
  }
  std::string ranges(int axis) const {
    return fmt::format("set xrange [{:.4f}:{:.4f}]; set yrange [{:.4f}:{:.4f}]\n", box_.min().x(),
                       box_.max().x(), box_.min()[axis], box_.max()[axis]);
  }
  Eigen::AlignedBox3d box_;
  int side_ = 0, above_ = 0, above_width_ = 0, lower_ = 0;
};

/// gnuplot clauses of arms, balls and ring in the columns 1 and `column`; what is not there is left out.
std::string strobePlot(const Strobe& strobe, int column, double radius) {
  std::string plot = fmt::format("plot $ring u 1:{} w l lw 4 lc rgb '#222222'", column);
  const auto add = [&](const std::string& data, const char* block, const char* colour,
                       const std::string& style) {
    if (!data.empty())
      plot += fmt::format(", ${} u 1:{}{} lc rgb {}", block, column, style, colour);
  };
  const auto circles = [radius](const char* colour) {
    return fmt::format(":({}) w circles fs transparent solid 0.35 border lc rgb {}", radius,
                       colour);
  };
  add(strobe.arms_before, "arms_before", kBefores, " w l lw 2");
  add(strobe.arms_after, "arms_after", kAfters, " w l lw 2");
  add(strobe.balls_before, "balls_before", kBefores, circles(kBefores));
  add(strobe.balls_after, "balls_after", kAfters, circles(kAfters));
  return plot;
}

std::string timeLabels(const Strobe& strobe) {
  return strobe.times.empty() ? "" : ", $times u 1:2:3 w labels offset 0,1.6 font ',10'";
}

/// At the foot of the panel, where no ball is, with a line from there to the ball that leaves.
std::string departureLabel(const Strobe& strobe, double radius) {
  if (!strobe.departure)
    return "";
  return fmt::format(
      "set arrow 1 from {0:.4f},{1:.4f} to {0:.4f}, graph 0.085 nohead lw 1 dt 3 lc rgb {2}\n"
      "set label 1 'leaves the hand' at {0:.4f}, graph 0.045 center font ',10'\n",
      strobe.departure->x(), strobe.departure->z() - radius, kGrey);
}

std::string blocksOf(const Strobe& strobe, const std::string& ring) {
  return dataBlock("arms_before", strobe.arms_before) + dataBlock("arms_after", strobe.arms_after) +
         dataBlock("balls_before", strobe.balls_before) +
         dataBlock("balls_after", strobe.balls_after) + dataBlock("times", strobe.times) +
         dataBlock("ring", ring);
}

std::string captionOf(const LoggedThrow& thrown, const ThrowTimes& times, bool tracked) {
  std::string caption = fmt::format(
      "Arm and ball every {:.0f} ms, in their true proportions: blue until {}, orange after it",
      1e3 * kStrobe, times.of_origin);
  caption += tracked                 ? "; the flight is the tracker's."
             : thrown.flight.empty() ? "; nobody says where the ball flew."
                                     : "; the flight is the simulator's, for no tracker saw it.";
  caption += " In the net's face: ring and, dashed, the ring for the whole ball";
  if (thrown.isMeasured())
    caption += fmt::format(
        "; orange: the landing measured, ({:+.2f}, {:+.2f}) mm, with its 95 % ellipse",
        1e3 * thrown.record.landing->landing[0], 1e3 * thrown.record.landing->landing[1]);
  if (thrown.truth.landing)
    caption += fmt::format("; black cross: the true one, ({:+.2f}, {:+.2f}) mm",
                           1e3 * thrown.truth.landing->x(), 1e3 * thrown.truth.landing->y());
  return caption + ".";
}

}  // namespace

std::string drawThrow(const LoggedThrow& thrown,
                      const config::Experiment& experiment,
                      const std::string& path_stem) {
  const ThrowRecord& record = thrown.record;
  if (record.arm.empty())
    throw std::runtime_error("the log has no ARM_STATE");
  const ThrowTimes times = timesOf(record);
  const model::Target target = targetOf(thrown, experiment);
  const ThrowFrame frame(target);
  Strobe strobe;
  addArms(record, experiment, times, frame, strobe);
  const bool tracked = !record.track.empty() && record.departed;
  if (tracked)
    addTrackedFlight(record, experiment.arm.gravity, times, frame, strobe);
  else
    addTrueFlight(thrown, target, times, frame, strobe);
  const std::string ring = ringOutline(target, frame, strobe);
  const double room = experiment.ball.radius + kMargin;
  strobe.box =
      Eigen::AlignedBox3d(strobe.box.min().array() - room, strobe.box.max().array() + room);
  const Sheet sheet(strobe.box);
  const FacePanels faces = facePanels(thrown, target, experiment.ball.radius,
                                      sheet.facePanel(0) + sheet.key(), sheet.facePanel(1));
  const double radius = experiment.ball.radius;
  drawPicture(
      path_stem, kWidth, sheet.height(), blocksOf(strobe, ring) + faces.data,
      kStyle +
          fmt::format(
              "set termoption noenhanced\nset multiplot\nset key off\n"
              "set xlabel 'towards the net (m)' offset 0,0.5; set xtics 0.5\n"
              "{}set title 'Side view' offset 0,-0.6; set ylabel 'up (m)' offset 1.2,0\n"
              "set ytics 0.2\n{}{}{}\nunset label 1; unset arrow 1\n"
              "{}set title 'Seen from above' offset 0,-0.6; set ylabel 'left (m)' offset 1.2,0\n"
              "set ytics 0.5\n{}\n{}unset multiplot\n",
              sheet.sidePanel(), departureLabel(strobe, radius), strobePlot(strobe, 3, radius),
              timeLabels(strobe), sheet.abovePanel(), strobePlot(strobe, 2, radius),
              faces.commands));
  return captionOf(thrown, times, tracked);
}

}  // namespace fastball::launch
