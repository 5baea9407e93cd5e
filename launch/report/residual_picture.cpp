// What the tracker saw less what its last fit says.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "launch/figures/style.h"
#include "launch/figures/table.h"
#include "launch/gnuplot.h"
#include "launch/report/throw_pictures.h"
#include "launch/report/throw_times.h"
#include "launch/track_flight.h"
#include "vision_tracker/camera_message.h"
#include "vision_tracker/sphere_outline.h"

namespace fastball::launch {
namespace {

/// Residuals of one camera's images.
struct CameraResiduals {
  std::string channel;
  Table table{{"t from departure (s)", "right (px)", "down (px)"}, {}};
  double squares = 0;  ///< [px^2], of both axes
  double rms() const { return std::sqrt(squares / (2.0 * static_cast<double>(table.rows.size()))); }
};

/// Of the images from the first on that its fit used until the ball crosses the target plane.
CameraResiduals residualsOf(const LoggedThrow& thrown,
                            const std::string& channel,
                            const model::Camera& camera,
                            const config::Experiment& experiment,
                            const ThrowTimes& times) {
  CameraResiduals residuals{channel};
  const ball_track_t& fit = thrown.record.track.back();
  for (const ball_observation_t& seen : thrown.observations) {
    if (seen.channel != channel || seen.found != 1 || seen.utime > fit.landing_utime ||
        seen.utime < times.origin)
      continue;
    const Eigen::Vector3d p_WBall = flightAt(fit, seen.utime, experiment.arm.gravity).p_WBall;
    if (!(camera.toCamera(p_WBall).z() > 3 * experiment.ball.radius))
      continue;
    const Eigen::Vector2d r =
        Eigen::Vector2d(seen.u, seen.v) -
        vision_tracker::outlineCentre(camera, p_WBall, experiment.ball.radius);
    residuals.table.rows.push_back({times.at(seen.utime), r.x(), r.y()});
    residuals.squares += r.squaredNorm();
  }
  return residuals;
}

double farthest(const std::vector<CameraResiduals>& cameras) {
  double most = 1e-3;
  for (const CameraResiduals& camera : cameras) {
    for (const std::vector<double>& row : camera.table.rows)
      most = std::max({most, std::abs(row[1]), std::abs(row[2])});
  }
  return most;
}

std::string commandsOf(const std::vector<CameraResiduals>& cameras, const ThrowTimes& times) {
  std::string plots[2];
  for (int axis = 0; axis < 2; ++axis) {
    for (std::size_t i = 0; i < cameras.size(); ++i)
      plots[axis] +=
          fmt::format("{} $c{} u 1:{} w p pt {} ps 0.6 lc rgb {} title {}", i == 0 ? "plot" : ",",
                      i, axis + 2, kMarks[i % 4], kColours[i % 4], quoted(cameras[i].channel));
  }
  return kStyle +
         fmt::format(
             "set multiplot\nset termoption noenhanced\nset xzeroaxis lw 1 lc rgb '#404040'\n"
             "set tmargin at screen 0.87; set bmargin at screen 0.2; set xrange [0:*]\n"
             "set yrange [-{0:.4f}:{0:.4f}]; set xlabel {1} offset 0,0.4\n"
             "set lmargin at screen 0.085; set rmargin at screen 0.49\n"
             "set ylabel 'seen - fit, to the right (px)' offset 0.8,0\n"
             "set key at screen 0.985,0.99 top right horizontal samplen 1 width 2 maxrows 1\n{2}\n"
             "set lmargin at screen 0.58; set rmargin at screen 0.985; set key off\n"
             "set ylabel 'seen - fit, down (px)' offset 0.8,0\n{3}\nunset multiplot\n",
             1.08 * farthest(cameras), quoted("time from " + times.of_origin + " (s)"), plots[0],
             plots[1]);
}

Table allOf(const std::vector<CameraResiduals>& cameras) {
  Table all{{"camera"}, {}};
  const auto& columns = cameras.front().table.columns;
  all.columns.insert(all.columns.end(), columns.begin(), columns.end());
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    for (const std::vector<double>& row : cameras[i].table.rows) {
      all.rows.push_back({static_cast<double>(i + 1)});
      all.rows.back().insert(all.rows.back().end(), row.begin(), row.end());
    }
  }
  return all;
}

}  // namespace

std::string drawResiduals(const LoggedThrow& thrown,
                          const std::map<std::string, camera_info_t>& cameras,
                          const config::Experiment& experiment,
                          const std::string& path_stem) {
  const ThrowRecord& record = thrown.record;
  if (thrown.observations.empty() || record.track.empty())
    throw std::runtime_error(fmt::format(
        "the log has no {}", thrown.observations.empty() ? "BALL_OBSERVATION" : "BALL_TRACK"));
  if (cameras.empty())
    throw std::runtime_error("the log has no CAMERA_INFO");
  const ThrowTimes times = timesOf(record);
  std::vector<CameraResiduals> residuals;
  for (const auto& [channel, info] : cameras) {
    if (!vision_tracker::cameraFault(info).empty())
      continue;
    CameraResiduals one =
        residualsOf(thrown, channel, vision_tracker::cameraSetup(info).camera, experiment, times);
    if (!one.table.rows.empty())
      residuals.push_back(std::move(one));
  }
  if (residuals.empty())
    throw std::runtime_error("no BALL_OBSERVATION belongs to a camera of CAMERA_INFO");
  std::string data, caption =
                        "Centre of the ball in each image less that of the last BALL_TRACK, also "
                        "where the tracker left "
                        "the image out as too far off.";
  for (std::size_t i = 0; i < residuals.size(); ++i) {
    data += dataBlock(fmt::format("c{}", i), plotData(residuals[i].table));
    caption += fmt::format(" {} (camera {}): {} images, rms {:.3f} px.", residuals[i].channel,
                           i + 1, residuals[i].table.rows.size(), residuals[i].rms());
  }
  writeCsv(allOf(residuals), path_stem + ".csv");
  drawPicture(path_stem, 1000, 270, data, commandsOf(residuals, times));
  if (record.landing)
    caption +=
        fmt::format(" The tracker says {:.3f} px of those it used.", record.landing->residual_px);
  return caption;
}

}  // namespace fastball::launch
