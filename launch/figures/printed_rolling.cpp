#include "launch/figures/printed_rolling.h"

#include <Eigen/Core>

#include "launch/figures/table.h"
#include "model/event_integration.h"

namespace fastball::launch {
namespace {

using Eigen::Vector3d;

struct Printed {
  double ddx, normal;
};

Printed printed(const model::FingerFrameMotion& frame,
                double mass,
                double gravity,
                const Eigen::VectorXd& state) {
  const Vector3d g = frame.X_WF.linear().transpose() * Vector3d(0, 0, -gravity);
  const Vector3d &w = frame.w_F, &dw = frame.dw_F, &a0 = frame.a_F;
  const double x = state[0], dx = state[1];
  return {5.0 / 7 * (-a0.x() + g.x() + (w.y() * w.y() + w.z() * w.z()) * x),
          mass * (a0.y() - g.y() + 2 * w.z() * dx + (dw.z() + w.x() * w.x()) * x)};
}

}  // namespace

model::RollingMotion rollAsPrinted(const model::BallParameters& ball,
                                   const model::FingerPair& fingers,
                                   const model::HandPath& hand_at,
                                   const model::RollingTask& task) {
  model::requireRolling(ball, task);
  const auto at = [&](double t, const Eigen::VectorXd& y) {
    return printed(model::fingerFrameMotion(fingers, hand_at(t)), ball.mass, task.gravity, y);
  };
  model::RollingMotion motion;
  const auto sample = [&](double t, const Eigen::VectorXd& y) {
    motion.samples.push_back(
        {t, {y[0], 0, 0}, {y[1], 0, 0}, {kNoNumber, at(t, y).normal, kNoNumber}, false});
  };
  model::EventTask equations;
  equations.derivative = [&](double t, const Eigen::VectorXd& y) -> Eigen::VectorXd {
    return Eigen::Vector2d(y[1], at(t, y).ddx);
  };
  equations.events = {[&](double t, const Eigen::VectorXd& y) { return at(t, y).normal; }};
  equations.sample = sample;
  equations.sample_step = task.sample_step;
  equations.tolerance = task.tolerance;
  const Eigen::VectorXd start = Eigen::Vector2d::Zero();
  model::EventEnd end{task.t_start, start, 0};
  if (at(task.t_start, start).normal > 0)
    end = model::integrateToEvent(equations, task.t_start, start, task.t_end);
  sample(end.t, end.y);
  const model::FingerFrameMotion frame = model::fingerFrameMotion(fingers, hand_at(end.t));
  const Vector3d r_F(end.y[0], 0, 0), v_F(end.y[1], 0, 0);
  motion.released = end.event == 0;
  motion.t_release = end.t;
  motion.ball = {frame.X_WF * r_F, model::releaseVelocity(frame, r_F, v_F)};
  const Vector3d spin_F(frame.w_F.x(), frame.w_F.y(), frame.w_F.z() - end.y[1] / ball.radius);
  motion.w_WBall = frame.X_WF.linear() * spin_F;
  return motion;
}

}  // namespace fastball::launch
