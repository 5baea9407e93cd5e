#include "messaging/channels.h"
#include "messaging/validation_check.h"

namespace fastball::messaging {
namespace {

constexpr int32_t kMostEvents = 1000000;
constexpr int32_t kMaxPixels = 8192;  // of an image's side

}  // namespace

std::optional<std::string> fault(const image_t& m) {
  Check check("image");
  check.stamp(m)
      .within<int32_t>("width", m.width, 1, kMaxPixels)
      .within<int32_t>("height", m.height, 1, kMaxPixels)
      .within<int32_t>("row_stride", m.row_stride, m.width, 4 * kMaxPixels)
      .within<int32_t>("size", m.size, 1, int32_t{kDatagramBytes})
      .length("data", m.data.size(), "size", m.size);
  const bool gray = m.pixelformat == image_t::GRAY;
  if (check.good() && !gray && m.pixelformat != image_t::MJPEG) {
    check.fail("pixelformat is {}, neither GRAY nor MJPEG", m.pixelformat);
  }
  if (check.good() && gray && m.size != int64_t{m.row_stride} * m.height) {
    check.fail("size is {}, but {} rows of {} bytes are {}", m.size, m.height, m.row_stride,
               int64_t{m.row_stride} * m.height);
  }
  return check.fault();
}

std::optional<std::string> fault(const camera_info_t& m) {
  return Check("CAMERA_INFO")
      .stamp(m)
      .name("channel", m.channel)
      .within<int32_t>("width", m.width, 1, kMaxPixels)
      .within<int32_t>("height", m.height, 1, kMaxPixels)
      .finite("K", m.K)
      .finite("D", m.D)
      .finite("R_CW", m.R_CW)
      .finite("p_CW", m.p_CW)
      .positive("rate", m.rate)
      .positiveOrZero("exposure", m.exposure)
      .fault();
}

std::optional<std::string> fault(const sim_truth_t& m) {
  Check check("SIM_TRUTH");
  check.stamp(m);
  check.notNegative("scene_id", m.scene_id);
  check.enumeration("event", m.event, sim_truth_t::SAMPLE, sim_truth_t::FINISHED);
  check.within<int32_t>("event_index", m.event_index, m.event == sim_truth_t::SAMPLE ? 0 : 1,
                        kMostEvents);
  return check.finite("p_WBall", m.p_WBall)
      .finite("v_WBall", m.v_WBall)
      .finite("w_WBall", m.w_WBall)
      .finite("q_arm", m.q_arm)
      .finite("landing", m.landing)
      .sentence("note", m.note)
      .fault();
}

std::optional<std::string> fault(const ball_observation_t& m) {
  Check check("BALL_OBSERVATION");
  check.stamp(m);
  check.notNegative("request_id", m.request_id);
  check.notNegative("frame", m.frame);
  check.enumeration("found", m.found, 0, 1);
  return check.name("channel", m.channel)
      .finite("u", m.u)
      .finite("v", m.v)
      .positiveOrZero("radius", m.radius)
      .covariance("cov_uv", m.cov_uv)
      .fault();
}

std::optional<std::string> fault(const ball_track_t& m) {
  Check check("BALL_TRACK");
  check.stamp(m);
  check.notNegative("request_id", m.request_id);
  check.notNegative("n_observations", m.n_observations);
  check.notNegative("landing_utime", m.landing_utime);
  return check.finite("p_WBall", m.p_WBall)
      .finite("v_WBall", m.v_WBall)
      .finite("drag", m.drag)
      .finite("landing", m.landing)
      .covariance("cov_landing", m.cov_landing)
      .fault();
}

std::optional<std::string> fault(const landing_t& m) {
  Check check("LANDING");
  check.stamp(m);
  check.notNegative("request_id", m.request_id);
  check.notNegative("n_observations", m.n_observations);
  check.enumeration("measured", m.measured, 0, 1);
  return check.finite("landing", m.landing)
      .covariance("cov_landing", m.cov_landing)
      .finite("v_WBall", m.v_WBall)
      .positiveOrZero("residual_px", m.residual_px)
      .sentence("message", m.message)
      .fault();
}

std::optional<std::string> fault(const logger_status_t& m) {
  Check check("LOGGER_STATUS");
  check.stamp(m);
  check.notNegative("messages", m.messages);
  check.notNegative("bytes", m.bytes);
  check.notNegative("lost", m.lost);
  return check.sentence("path", m.path).sentence("message", m.message).fault();
}

std::optional<std::string> fault(const heartbeat_t& m) {
  Check check("HEARTBEAT");
  check.stamp(m)
      .name("name", m.name)
      .name("host", m.host)
      .atLeast<int32_t>("pid", m.pid, 0)
      .name("version", m.version)
      .name("state", m.state)
      .sentence("detail", m.detail);
  check.notNegative("plan_id", m.plan_id);
  check.notNegative("received", m.received);
  check.notNegative("lost", m.lost);
  check.notNegative("invalid", m.invalid);
  return check.positiveOrZero("loop_mean_us", m.loop_mean_us)
      .positiveOrZero("loop_max_us", m.loop_max_us)
      .fault();
}

std::optional<std::string> fault(const clock_probe_t& m) {
  Check check("CLOCK");
  check.stamp(m).name("name", m.name).name("host", m.host).atLeast<int32_t>("pid", m.pid, 0);
  check.shortText("asker_host", m.asker_host).atLeast<int32_t>("asker_pid", m.asker_pid, 0);
  return check.notNegative("asked_utime", m.asked_utime)
      .notNegative("heard_utime", m.heard_utime)
      .fault();
}

}  // namespace fastball::messaging
