#include "sim_bullet/scene_messages.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <random>

namespace fastball::sim_bullet {
namespace {

/// A copy of a message's array as an Eigen vector.
template <int n>
Eigen::Matrix<double, n, 1> vector(const double (&values)[n]) {
  return Eigen::Map<const Eigen::Matrix<double, n, 1>>(values);
}

template <int n>
void copyTo(double (&values)[n], const Eigen::Matrix<double, n, 1>& vector) {
  Eigen::Map<Eigen::Matrix<double, n, 1>>{values} = vector;
}

/// The curtain's noise must not follow the other random numbers of a scene, which begin with the same seed.
constexpr uint64_t kCurtainStream = 0x6375727461696e;

}  // namespace

arm_state_t armState(const TickStamp& stamp, const RobotState& state) {
  arm_state_t message{};
  message.utime = stamp.utime;
  message.scene_id = stamp.scene_id;
  message.tick = stamp.tick;
  copyTo(message.q, state.q_arm);
  copyTo(message.qd, state.qd_arm);
  copyTo(message.tau, state.tau_arm);
  return message;
}

hand_state_t handState(const TickStamp& stamp, const RobotState& state) {
  hand_state_t message{};
  message.utime = stamp.utime;
  message.scene_id = stamp.scene_id;
  message.tick = stamp.tick;
  copyTo(message.q, state.q.hand);
  copyTo(message.qd, state.qd.hand);
  copyTo(message.tau, state.tau_hand);
  for (int i = 0; i < model::kFingers; ++i) {
    message.f_normal[i] = state.felt[i].normal;
    copyTo(message.f_tangential[i], state.felt[i].tangential);
  }
  return message;
}

sim_truth_t truth(const TickStamp& stamp,
                  int8_t event,
                  const BallMotion& ball,
                  const Eigen::Vector4d& q_arm) {
  sim_truth_t message{};
  message.utime = stamp.utime;
  message.scene_id = stamp.scene_id;
  message.event = event;
  copyTo(message.p_WBall, ball.p_WBall);
  copyTo(message.v_WBall, ball.v_WBall);
  copyTo(message.w_WBall, ball.w_WBall);
  copyTo(message.q_arm, q_arm);
  return message;
}

sim_truth_t truth(const SceneEvent& event,
                  int64_t start_utime,
                  int64_t scene_id,
                  const Eigen::Vector4d& q_arm) {
  sim_truth_t message{};
  message.utime = start_utime + std::llround(event.time * 1e6);
  message.scene_id = scene_id;
  switch (event.kind) {
    case SceneEvent::Kind::kReleased:
      message.event = sim_truth_t::RELEASED;
      break;
    case SceneEvent::Kind::kTouched:
      message.event = sim_truth_t::TOUCHED;
      break;
    case SceneEvent::Kind::kLanded:
      message.event = sim_truth_t::LANDED;
      break;
  }
  copyTo(message.p_WBall, event.ball.p_WBall);
  copyTo(message.v_WBall, event.ball.v_WBall);
  copyTo(message.w_WBall, event.w_WBall);
  copyTo(message.q_arm, q_arm);
  copyTo(message.landing, event.landing);
  message.note = event.note;
  return message;
}

landing_t curtainLanding(const TickStamp& stamp,
                         const SceneEvent* landed,
                         const CurtainSettings& curtain,
                         int64_t seed) {
  landing_t message{};
  message.utime = stamp.utime;
  message.request_id = stamp.scene_id;
  if (landed == nullptr) {
    message.message = "no ball crossed the light curtain";
    return message;
  }
  message.measured = 1;
  std::mt19937_64 engine(static_cast<uint64_t>(seed) ^ kCurtainStream);
  std::normal_distribution<double> normal;
  for (int axis = 0; axis < 2; ++axis)
    message.landing[axis] = landed->landing[axis] + curtain.noise * normal(engine);
  message.cov_landing[0] = message.cov_landing[2] = curtain.noise * curtain.noise;
  Eigen::Map<Eigen::Vector3d>(message.v_WBall) = landed->ball.v_WBall;
  message.n_observations = 1;
  return message;
}

camera_info_t cameraInfo(const RigCamera& rig, int64_t utime) {
  const model::Camera& camera = rig.camera;
  camera_info_t message{};
  message.utime = utime;
  message.channel = rig.channel;
  message.width = camera.width;
  message.height = camera.height;
  const std::array<double, 9> K{camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1};
  std::copy(K.begin(), K.end(), message.K);
  copyTo(message.D, camera.distortion);
  Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>{message.R_CW} = camera.R_CW;
  copyTo(message.p_CW, camera.p_CW);
  message.rate = rig.rate;
  message.exposure = rig.exposure;
  return message;
}

image_t image(const RenderedImage& rendered) {
  image_t message{};
  message.utime = rendered.utime;
  message.width = rendered.width;
  message.height = rendered.height;
  message.row_stride = rendered.width;
  message.pixelformat = image_t::MJPEG;
  message.size = static_cast<int32_t>(rendered.jpeg.size());
  message.data = rendered.jpeg;
  return message;
}

Eigen::Vector4d armTorque(const arm_command_t& message) {
  return vector(message.tau);
}

HandCommand handCommand(const hand_command_t& message) {
  return {vector(message.q), vector(message.qd), vector(message.tau), vector(message.kp),
          vector(message.kd)};
}

SceneStart sceneStart(const scene_t& message) {
  SceneStart start;
  start.seeds = {message.set_up_seed, message.seed};
  start.q_arm = vector(message.q_arm);
  start.target.p_WTarget = vector(message.p_WTarget);
  start.target.n_WTarget = vector(message.n_WTarget).normalized();
  start.target.radius = message.target_radius;
  return start;
}

}  // namespace fastball::sim_bullet
