#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <stdexcept>

#include "launch/gnuplot.h"
#include "launch/report.h"
#include "model/arm.h"
#include "model/ball_flight.h"
#include "model/target.h"

namespace fastball::launch {
namespace {

constexpr int64_t kStrobeUs = 50'000;   ///< time between two poses of the picture
constexpr int64_t kBeforeUs = 400'000;  ///< the picture begins so long before the ball leaves
constexpr double kUpperArm = 0.55;      ///< [m], end of the upper arm's centre line, for drawing

/// The arm's centre line from the shoulder to the ball in the hand.
std::vector<Eigen::Vector3d> centreLine(const model::Arm& arm,
                                        const Eigen::Vector4d& q,
                                        const Eigen::Vector3d& p_TBall) {
  return {Eigen::Vector3d::Zero(),         arm.X_WLink(q, 2) * Eigen::Vector3d(0, 0, kUpperArm),
          arm.X_WLink(q, 3).translation(), arm.X_WLink(q, 4).translation(),
          arm.X_WT(q).translation(),       arm.p_WPoint(q, p_TBall)};
}

struct Strobe {
  std::string arms;   ///< gnuplot data: x y z, time; poses apart by blank lines
  std::string balls;  ///< x y z radius time
};

/// Where the ball was at `utime`, at or before the time of a track's point. Seen backwards in time a flight is one with drag
/// of the other sign.
Eigen::Vector3d positionBefore(const ball_track_t& point, int64_t utime, double gravity) {
  const model::BallState backwards{Eigen::Map<const Eigen::Vector3d>(point.p_WBall),
                                   -Eigen::Map<const Eigen::Vector3d>(point.v_WBall)};
  return model::fly(backwards, 1e-6 * static_cast<double>(point.utime - utime), -point.drag,
                    gravity)
      .p_WBall;
}

Strobe strobe(const ThrowRecord& record, const config::Experiment& experiment) {
  const model::Arm arm(experiment.arm, experiment.hand.payload);
  const int64_t departure = record.departed->utime;
  Strobe data;
  int64_t next = departure - kBeforeUs;
  for (const arm_state_t& state : record.arm) {
    if (state.utime < next || state.utime > departure + kStrobeUs)
      continue;
    next += kStrobeUs;
    const double t = 1e-6 * static_cast<double>(state.utime - departure);
    const auto line =
        centreLine(arm, Eigen::Map<const Eigen::Vector4d>(state.q), experiment.hand.p_HBall);
    for (const Eigen::Vector3d& p : line)
      data.arms += fmt::format("{} {} {} {}\n", p.x(), p.y(), p.z(), t);
    data.arms += "\n";
    if (state.utime <= departure)
      data.balls += fmt::format("{} {} {} {} {}\n", line.back().x(), line.back().y(),
                                line.back().z(), experiment.ball.radius, t);
  }
  next = departure + kStrobeUs;
  for (const ball_track_t& point : record.track) {
    while (next <= point.utime) {
      const Eigen::Vector3d p = positionBefore(point, next, experiment.arm.gravity);
      data.balls += fmt::format("{} {} {} {} {}\n", p.x(), p.y(), p.z(), experiment.ball.radius,
                                1e-6 * static_cast<double>(next - departure));
      next += kStrobeUs;
    }
  }
  return data;
}

model::Target targetOf(const plan_request_t& request) {
  model::Target target;
  target.p_WTarget = Eigen::Map<const Eigen::Vector3d>(request.p_WTarget);
  target.n_WTarget = Eigen::Map<const Eigen::Vector3d>(request.n_WTarget);
  target.radius = request.target_radius;
  return target;
}

std::string ringOutline(const model::Target& target) {
  std::string outline;
  for (int i = 0; i <= 72; ++i) {
    const double angle = i * M_PI / 36;
    const Eigen::Vector3d p =
        target.p_WTarget +
        target.radius * (std::cos(angle) * target.rightAxis() + std::sin(angle) * target.upAxis());
    outline += fmt::format("{} {} {}\n", p.x(), p.y(), p.z());
  }
  return outline;
}

/// Outline [mm] of the 95 % region of a landing's covariance.
std::string ellipse(const landing_t& landing) {
  constexpr double kChiSquare95 = 5.991;  // of two degrees of freedom
  Eigen::Matrix2d covariance;
  covariance << landing.cov_landing[0], landing.cov_landing[1], landing.cov_landing[1],
      landing.cov_landing[2];
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(covariance);
  const Eigen::Matrix2d spread =
      axes.eigenvectors() *
      (kChiSquare95 * axes.eigenvalues().cwiseMax(0)).cwiseSqrt().asDiagonal();
  std::string outline;
  for (int i = 0; i <= 72; ++i) {
    const double angle = i * M_PI / 36;
    const Eigen::Vector2d p = spread * Eigen::Vector2d(std::cos(angle), std::sin(angle));
    outline += fmt::format("{} {}\n", 1e3 * (landing.landing[0] + p.x()),
                           1e3 * (landing.landing[1] + p.y()));
  }
  return outline;
}

const char* kPanels = R"(
set style fill transparent solid 0.55 border lc rgb '#40404080'
set palette defined (-0.4 '#9db4d6', -0.001 '#1f4e9c', 0 '#d1495b', 0.7 '#f2a65a')
set cbrange [-0.4:*]
unset colorbox
set grid lc rgb '#e4e4e4'
set size ratio -1
unset key
set origin 0.0,0.42; set size 0.70,0.53
set title 'Side view' offset 0,-0.7
set xlabel 'x (m)' offset 0,0.7; set ylabel 'z (m)' offset 1.2,0
set xrange [-0.4:3.2]; set yrange [-0.9:0.7]
plot $arms u 1:3:4 w l lw 2 lc palette, $balls u 1:3:4:5 w circles lc palette, $ring u 1:3 w l lw 4 lc rgb '#222222'
set origin 0.0,0.0; set size 0.70,0.46
set title 'Seen from above' offset 0,-0.7
set ylabel 'y (m)' offset 1.2,0
set yrange [-1.0:0.4]
plot $arms u 1:2:4 w l lw 2 lc palette, $balls u 1:2:4:5 w circles lc palette, $ring u 1:2 w l lw 4 lc rgb '#222222'
set origin 0.68,0.18; set size 0.32,0.64
set title 'The net, seen from the robot' offset 0,-0.5
set xlabel 'right (mm)'; set ylabel 'up (mm)'
set xrange [-140:140]; set yrange [-140:140]
)";

void requireMessages(const ThrowRecord& record) {
  const char* missing = !record.request      ? "PLAN_REQUEST"
                        : !record.departed   ? "RELEASE of the ball's departure"
                        : record.arm.empty() ? "ARM_STATE"
                        : !record.landing    ? "LANDING"
                                             : nullptr;
  if (missing)
    throw std::runtime_error(fmt::format("the log has no {}", missing));
}

}  // namespace

void drawThrow(const ThrowRecord& record,
               int64_t number,
               const config::Experiment& experiment,
               const std::string& path_stem) {
  requireMessages(record);
  const landing_t& landing = *record.landing;
  const model::Target target = targetOf(*record.request);
  const Strobe data = strobe(record, experiment);
  const double radius_mm = 1e3 * target.radius;
  std::string blocks = dataBlock("arms", data.arms) + dataBlock("balls", data.balls) +
                       dataBlock("ring", ringOutline(target));
  std::string target_plot = "plot NaN\n";
  std::string outcome = "landing not measured";
  if (landing.measured) {
    blocks += dataBlock("ellipse", ellipse(landing));
    const double right = 1e3 * landing.landing[0], up = 1e3 * landing.landing[1];
    target_plot = fmt::format(
        "set object 2 circle at {0},{1} size {2} fs transparent solid 0.25 noborder fc rgb "
        "'#d1495b'\n"
        "plot $ellipse w l lw 2 lc rgb '#d1495b', '+' u ({0}):({1}) every ::0::0 w p pt 1 ps 1.5 "
        "lw 2 lc rgb '#d1495b'\n",
        right, up, 1e3 * experiment.ball.radius);
    outcome =
        fmt::format("measured landing ({:+.1f}, {:+.1f}) mm from the net''s centre", right, up);
  }
  const std::string title =
      fmt::format("Throw {}: arm and ball every {} ms, {}", number, kStrobeUs / 1000, outcome);
  const std::string panels = fmt::format(
      "set multiplot title '{}' font ',14'\n{}set object 1 circle at 0,0 size {} fs empty border "
      "lc rgb '#222222' lw 4\n{}unset multiplot\n",
      title, kPanels, radius_mm, target_plot);
  drawPicture(path_stem, 1400, 900, blocks, panels);
}

}  // namespace fastball::launch
