#include "planner/window_cost.h"

#include <algorithm>
#include <cmath>

#include "model/arm_derivatives.h"

namespace fastball::planner {
namespace {

// Samples of the motion at which limits are looked at.
constexpr int kWindowSteps = 4, kRampSamples = 3, kRunUpSamples = 15, kBrakeSamples = 11;
constexpr double kLongestRunUp = 0.7, kLongestBrake = 0.6;  // [s]
// A limit weighs so much that what remains of a violation is below 1e-4 of it.
constexpr double kLimitWeight = 100;
constexpr double kReserve = 0.002;    // of a limit, kept for what happens between samples
constexpr double kErrorScale = 0.05;  // [m], a landing so far off counts 1
constexpr double kPaceWeight =
    0.45;  // a push of 20 m/s^2 counts 1: it is pace * dv/dT, and dv/dT is about 9 m/s^2
constexpr double kSlow = 0.1;        // [m/s] too slow, counts 1
constexpr double kOutOfReach = 1e8;  // of the sum, where the arm cannot follow
constexpr double kUnreachable = 10;  // violation there

using ByWindowRow = Eigen::Matrix<double, 1, kWindowParameters>;

/// Of the variables that the problem leaves free.
WindowVector scaleOf(const WindowProblem& problem) {
  WindowVector scale = windowBounds().scale;
  if (problem.free_flight)
    scale.segment<2>(kPace).setZero();
  return scale;
}

double square(double x) {
  return x * x;
}

SwingTask limitTask(const WindowProblem& problem) {
  SwingTask task;
  task.arm = problem.task.arm;
  task.hand = problem.hand;
  task.settings = problem.settings;
  task.settings.elbow_margin = -1;  // a matter of the swing models only
  task.limit_factor = problem.limit_factor;
  return task;
}

WindowCost::Slope byThrow(const ByWindowRow& by_window) {
  WindowCost::Slope slope = WindowCost::Slope::Zero();
  slope.head<kWindowParameters>() = by_window;
  return slope;
}

/// How far a joint's speed moves the point P, d|J_j|/dq: d(J_j)/dq_i is axis_i x J_j for i <= j, and axis_j x J_i behind it.
Eigen::RowVector4d leverSlope(const model::Jacobian& J, const model::Jacobian& axes, int j) {
  Eigen::RowVector4d slope;
  for (int i = 0; i < model::kArmJoints; ++i) {
    const Eigen::Vector3d change =
        i <= j ? axes.col(i).cross(J.col(j)) : axes.col(j).cross(J.col(i));
    slope[i] = change.dot(J.col(j)) / J.col(j).norm();
  }
  return slope;
}

/// dw/dq of the tool frame's angular velocity.
Eigen::Matrix<double, 3, 4> turnSlope(const model::Jacobian& axes, const Eigen::Vector4d& qd) {
  Eigen::Matrix<double, 3, 4> slope = Eigen::Matrix<double, 3, 4>::Zero();
  for (int i = 0; i < model::kArmJoints; ++i) {
    for (int j = i + 1; j < model::kArmJoints; ++j)
      slope.col(i) += axes.col(i).cross(axes.col(j)) * qd[j];
  }
  return slope;
}

}  // namespace

const WindowBounds& windowBounds() {
  static const WindowBounds bounds = [] {
    const auto fill = [](double angle, double time_to_go, const Eigen::Vector3d& joint3,
                         double pace, double run_up, double brake, double acceleration) {
      WindowThrow x;
      x.window.q_start.setConstant(angle);
      x.window.time_to_go = time_to_go;
      x.window.joint3 = joint3;
      x.window.pace.setConstant(pace);
      x.run_up.setConstant(run_up);
      x.brake.setConstant(brake);
      x.qdd_before.setConstant(acceleration);
      x.qdd_after.setConstant(acceleration);
      return toVector(x);
    };
    // A hand that pushes the ball more (pace below zero) would catch up with a ball that leaves it at 0.25 m/s within 70 ms.
    return WindowBounds{fill(-10, 0.2, {-8, -150, -4000}, -0.8, 0.12, 0.15, -200),
                        fill(10, 1.3, {8, 150, 4000}, 8, kLongestRunUp, kLongestBrake, 200),
                        fill(0.3, 0.1, {1, 10, 300}, 0.3, 0.1, 0.1, 10)};
  }();
  return bounds;
}

void WindowCost::Sum::add(double row, const Slope& slope) {
  value += row * row;
  if (!with_slopes)
    return;
  const WindowVector by_u = slope.transpose().cwiseProduct(scale);
  half_gradient += row * by_u;
  half_hessian.selfadjointView<Eigen::Lower>().rankUpdate(by_u);
}

WindowCost::WindowCost(const WindowProblem& problem)
    : problem_(problem),
      limit_task_(limitTask(problem)),
      limits_(limit_task_, 1),
      held_(*problem.hand, 0, 0) {}

WindowCost::Sum WindowCost::at(const WindowVector& v, bool with_slopes) {
  ++evaluations_;
  Sum sum;
  sum.with_slopes = with_slopes;
  sum.scale = scaleOf(problem_);
  violation_ = kUnreachable;
  motion_ = {};
  addBounds(v, sum);
  WindowThrow x = fromVector(v, problem_.length);
  if (problem_.free_flight)
    x.window.pace.setZero();
  if (x.run_up.minCoeff() <= 0 || x.brake.minCoeff() <= 0 ||
      !windowMotion(problem_.task, x.window, kWindowSteps, motion_,
                    with_slopes ? &slopes_ : nullptr)) {
    motion_ = {};
    sum.value += kOutOfReach;
    return sum;
  }
  const WindowBounds& bounds = windowBounds();
  violation_ = (bounds.low - v).cwiseMax(v - bounds.high).cwiseQuotient(bounds.scale).maxCoeff();
  addLimits(x, sum);
  addArrival(sum);
  addErrors(x, sum);
  addPush(x, sum);
  addSlowness(sum);
  if (problem_.nearness > 0)
    addNearness(v, sum);
  return sum;
}

void WindowCost::addBounds(const WindowVector& x, Sum& sum) {
  const WindowBounds& bounds = windowBounds();
  for (int i = 0; i < kWindowVariables; ++i) {
    const double off = std::min(x[i] - bounds.low[i], 0.0) + std::max(x[i] - bounds.high[i], 0.0);
    if (off == 0)
      continue;
    const double weight = kLimitWeight / bounds.scale[i];
    Slope slope = Slope::Zero();
    slope[i] = weight;
    sum.add(weight * off, slope);
  }
}

void WindowCost::addLimits(const WindowThrow& x, Sum& sum) {
  ByThrow slopes = ByThrow::Zero();
  for (int k = 0; k <= kWindowSteps; ++k) {
    if (sum.with_slopes)
      slopes.leftCols<kWindowParameters>() = slopes_.samples[k];
    addSample(motion_.samples[k], slopes, sum);
  }
  addSide(WindowSide(x, true), true, sum);
  addSide(WindowSide(x, false), false, sum);
}

void WindowCost::addSide(const WindowSide& side, bool before, Sum& sum) {
  const model::ArmMotion& edge = before ? motion_.samples.front() : motion_.samples.back();
  const ByWindow* edge_slopes = nullptr;
  if (sum.with_slopes)
    edge_slopes = before ? &slopes_.samples.front() : &slopes_.samples.back();
  const double longest = before ? kLongestRunUp : kLongestBrake;
  const int rest_samples = before ? kRunUpSamples : kBrakeSamples;
  ByThrow slopes = ByThrow::Zero();
  for (int i = 1; i <= kRampSamples + rest_samples; ++i) {
    // The times do not move with the durations; they are dense near the window, where speeds peak.
    const double t =
        i <= kRampSamples
            ? kWindowRamp * i / kRampSamples
            : kWindowRamp + longest * square(static_cast<double>(i - kRampSamples) / rest_samples);
    const model::ArmMotion sample =
        side.at(edge, t, edge_slopes, sum.with_slopes ? &slopes : nullptr);
    addSample(sample, slopes, sum);
  }
}

void WindowCost::addSample(const model::ArmMotion& sample, const ByThrow& slopes, Sum& sum) {
  const SwingLimits::Values values = limits_.at(sample, held_.p_TBall);
  for (int i = 0; i < kSwingLimits; ++i) {
    if (i == kElbow)
      continue;
    violation_ = std::max(violation_, values[i]);
    const double over = values[i] + kReserve;
    if (!(over > 0))
      continue;
    Slope slope = Slope::Zero();
    if (sum.with_slopes) {
      const MotionGradient g = limits_.gradient(static_cast<SwingLimit>(i), sample, held_).motion;
      slope = kLimitWeight *
              (g.q.transpose() * slopes.topRows<4>() + g.qd.transpose() * slopes.middleRows<4>(4) +
               g.qdd.transpose() * slopes.bottomRows<4>());
    }
    sum.add(kLimitWeight * over, slope);
  }
}

/// The ball must come through the ring from its front.
void WindowCost::addArrival(Sum& sum) {
  const WindowTask& task = problem_.task;
  const model::FlightDerivatives flight = model::flyWithDerivatives(
      motion_.ball.back(), motion_.time_to_go, task.drag_per_metre, task.gravity);
  const Eigen::Vector3d& v_land = flight.state.v_WBall;
  const double over = kLeastSteepness + problem_.n_WTarget.dot(v_land.normalized());
  violation_ = std::max(violation_, over);
  if (!(over > 0))
    return;
  ByWindowRow slope = ByWindowRow::Zero();
  if (sum.with_slopes) {
    const Eigen::Vector3d e = v_land.normalized(), n = problem_.n_WTarget;
    const Eigen::RowVector3d by_v = (n - n.dot(e) * e).transpose() / v_land.norm();
    const Eigen::Vector3d a_land =
        model::flightAcceleration(v_land, task.drag_per_metre, task.gravity);
    slope =
        kLimitWeight * by_v * (flight.dv_dv * slopes_.v_WBall.back() + a_land * slopes_.time_to_go);
  }
  sum.add(kLimitWeight * over, byThrow(slope));
}

/// First order: an error of the velocity at the release flies for the time to go.
void WindowCost::addErrors(const WindowThrow& x, Sum& sum) {
  const WindowTask& task = problem_.task;
  const model::ArmMotion& sample = motion_.samples.front();
  const double T = x.window.time_to_go;
  const model::Jacobian J = task.arm->pointJacobian(sample.q, task.p_TBall);
  const model::Jacobian axes = task.arm->rotationJacobian(sample.q);
  ByWindow at_start = ByWindow::Zero();
  Eigen::Matrix<double, 3, kWindowParameters> v_slope =
      Eigen::Matrix<double, 3, kWindowParameters>::Zero();
  if (sum.with_slopes) {
    at_start = slopes_.samples.front();
    v_slope = slopes_.v_WBall.front();
  }
  ByWindowRow T_slope = ByWindowRow::Zero();
  T_slope[kTimeToGo] = 1;
  const auto add = [&](double deviation, const ByWindowRow& slope) {
    sum.add(deviation / kErrorScale, byThrow(slope / kErrorScale));
  };
  for (int j = 0; j < model::kArmJoints; ++j) {
    const double lever = J.col(j).norm(), sd = problem_.errors.joint_speed;
    add(sd * lever * T,
        sd * (T * leverSlope(J, axes, j) * at_start.topRows<4>() + lever * T_slope));
  }
  // The hand turns: a ball that lies beside its place has another velocity. Two of three directions count.
  const Eigen::Vector3d w = axes * sample.qd;
  const double grasp = problem_.errors.grasp * std::sqrt(2.0 / 3);
  const Eigen::Matrix<double, 3, kWindowParameters> w_slope =
      turnSlope(axes, sample.qd) * at_start.topRows<4>() + axes * at_start.middleRows<4>(4);
  add(grasp * w.norm() * T,
      grasp * (T * w.normalized().transpose() * w_slope + w.norm() * T_slope));
  const Eigen::Vector3d& v = motion_.ball.front().v_WBall;
  const double drag = problem_.errors.drag * task.drag_per_metre / 2;
  add(drag * v.squaredNorm() * T * T,
      drag * 2 * T * (T * v.transpose() * v_slope + v.squaredNorm() * T_slope));
}

void WindowCost::addNearness(const WindowVector& v, Sum& sum) {
  const double weight = std::sqrt(problem_.nearness);
  for (int i = 0; i < kWindowVariables; ++i) {
    Slope slope = Slope::Zero();
    slope[i] = weight / windowBounds().scale[i];
    sum.add(slope[i] * (v[i] - problem_.near[i]), slope);
  }
}

void WindowCost::addPush(const WindowThrow& x, Sum& sum) {
  for (int k = 0; k <= kWindowSteps; ++k) {
    const double share = static_cast<double>(k) / kWindowSteps;
    Slope slope = Slope::Zero();
    slope[kPace] = (1 - share) * kPaceWeight;
    slope[kPace + 1] = share * kPaceWeight;
    sum.add(slope[kPace] * x.window.pace[0] + slope[kPace + 1] * x.window.pace[1], slope);
  }
}

void WindowCost::addSlowness(Sum& sum) {
  const Eigen::Vector3d& v = motion_.ball.front().v_WBall;
  const double missing = problem_.wanted_speed - v.norm();
  if (!(missing > 0))
    return;
  ByWindowRow slope = ByWindowRow::Zero();
  if (sum.with_slopes)
    slope = -v.normalized().transpose() * slopes_.v_WBall.front() / kSlow;
  sum.add(missing / kSlow, byThrow(slope));
}

}  // namespace fastball::planner
