#include "vision_tracker/result_messages.h"

namespace fastball::vision_tracker {
namespace {

void copyCovariance(const Eigen::Matrix2d& cov, double (&out)[3]) {
  out[0] = cov(0, 0);
  out[1] = cov(0, 1);
  out[2] = cov(1, 1);
}

void copyVector(const Eigen::Vector3d& v, double (&out)[3]) {
  Eigen::Map<Eigen::Vector3d>{out} = v;
}

}  // namespace

ball_observation_t observationMessage(const Sighting& sighting) {
  ball_observation_t m{};
  if (!sighting.found)
    return m;
  m.found = 1;
  m.u = sighting.fit.centre.x();
  m.v = sighting.fit.centre.y();
  m.radius = sighting.fit.radius;
  copyCovariance(sighting.fit.cov, m.cov_uv);
  return m;
}

ball_track_t trackMessage(const TrackReport& report) {
  ball_track_t m{};
  m.utime = report.utime;
  m.n_observations = report.observations;
  copyVector(report.state.p_WBall, m.p_WBall);
  copyVector(report.state.v_WBall, m.v_WBall);
  m.drag = report.drag;
  Eigen::Map<Eigen::Vector2d>{m.landing} = report.landing.landing;
  copyCovariance(report.landing.cov, m.cov_landing);
  m.landing_utime = report.landing.utime;
  return m;
}

landing_t landingMessage(const LandingReport& report) {
  landing_t m{};
  m.measured = report.measured ? 1 : 0;
  m.message = report.message;
  if (!report.measured)
    return m;
  m.utime = report.landing.utime;
  Eigen::Map<Eigen::Vector2d>{m.landing} = report.landing.landing;
  copyCovariance(report.landing.cov, m.cov_landing);
  copyVector(report.landing.state.v_WBall, m.v_WBall);
  m.n_observations = report.observations;
  m.residual_px = report.residual_px;
  return m;
}

}  // namespace fastball::vision_tracker
