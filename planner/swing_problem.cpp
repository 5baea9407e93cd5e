#include "planner/swing_problem.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace fastball::planner {
namespace {

/// [s] from the release: the windows of the swing and the grid in them. What happens near the release is fast.
struct Part {
  double end, step;
};
constexpr double kEarliest = -3.0;
constexpr Part kParts[] = {{-0.35, 0.025}, {-0.15, 0.0125}, {-0.04, 0.008}, {0, 0.008}};
constexpr double kLateStep = 0.008;  // from the release to the follow-through
constexpr int kBrakeWindows = 2, kBrakeGrid = 7;
// Peaks below are so far from their limit that they need no refinement, or not even a gradient.
constexpr double kNear = -0.1, kFar = -0.6;
constexpr int kRefinements = 3;
constexpr double kNarrowing = 5;  // of the time that is looked at

/// Three points of a function.
struct Parabola {
  double t[3], v[3];

  /// Where its highest point between the outer ones is.
  double peakTime() const {
    const double slope1 = (v[1] - v[0]) / (t[1] - t[0]), slope2 = (v[2] - v[1]) / (t[2] - t[1]);
    const double curvature = (slope2 - slope1) / (t[2] - t[0]);
    if (!(curvature < 0))
      return v[2] > v[0] ? t[2] : t[0];
    return std::clamp((t[0] + t[1]) / 2 - slope1 / (2 * curvature), t[0], t[2]);
  }
};

}  // namespace

double SwingProblem::Values::violation() const {
  if (!inequalities.allFinite() || !equalities.allFinite() || !std::isfinite(release_speed))
    return std::numeric_limits<double>::infinity();
  return std::max({0.0, inequalities.maxCoeff(), equalities.cwiseAbs().maxCoeff()});
}

/// The motion that x makes, swing and follow-through, and the limits on the grid.
class SwingProblem::Motion {
 public:
  Motion(const SwingProblem& problem, const SwingVector& x)
      : problem_(problem),
        curve_(x, problem.elbow_sign_),
        held_(*problem.task_.hand, x[kWristRoll], x[kWristFlexion]),
        q3_(problem.grid_.size()),
        values_(kSwingLimits, problem.grid_.size()) {
    const std::vector<double>& grid = problem.grid_;
    // The last point at rest counts.
    const auto after = std::upper_bound(grid.begin(), grid.end(), curve_.begin());
    first_ = after == grid.begin() ? 0 : static_cast<int>(after - grid.begin()) - 1;
    double q3_near = 0;
    for (int i = first_; i < static_cast<int>(grid.size()); ++i) {
      const model::ArmMotion motion = at(grid[i], q3_near);
      if (grid[i] == delay())
        brake_start_ = motion;
      q3_[i] = q3_near = motion.q[2];
      values_.col(i) = problem.limits_.at(motion, held_.p_TBall);
    }
  }

  const SwingCurve& curve() const { return curve_; }
  const HeldBall& held() const { return held_; }
  /// The first grid point that is looked at.
  int first() const { return first_; }
  double value(SwingLimit limit, int i) const { return values_(limit, i); }
  double q3(int i) const { return q3_[i]; }
  double delay() const { return follow().delay; }
  const FollowThrough& follow() const { return problem_.task_.settings.follow; }
  const model::ArmMotion& brakeStart() const { return brake_start_; }

  model::ArmMotion at(double t, double q3_near) const {
    return t <= delay() ? curve_.at(t, q3_near) : follow().braked(brake_start_, t - delay());
  }
  double valueAt(SwingLimit limit, double t, double q3_near) const {
    return problem_.limits_.at(limit, at(t, q3_near), held_.p_TBall);
  }

 private:
  const SwingProblem& problem_;
  SwingCurve curve_;
  HeldBall held_;
  int first_ = 0;
  std::vector<double> q3_;
  Eigen::Matrix<double, kSwingLimits, Eigen::Dynamic> values_;
  model::ArmMotion brake_start_;
};

SwingProblem::SwingProblem(const SwingTask& task, int elbow_sign)
    : task_(task), elbow_sign_(elbow_sign), limits_(task_, elbow_sign), release_(task_) {
  setBounds();
  grid_.push_back(kEarliest);
  for (const Part& part : kParts)
    addWindow(part.end, part.step);
  const FollowThrough& follow = task_.settings.follow;
  addWindow(follow.delay, kLateStep);
  const double longest = follow.brake_time.maxCoeff();
  for (int i = 1; i <= kBrakeWindows; ++i)
    addWindow(follow.delay + longest * i / kBrakeWindows, longest / (kBrakeWindows * kBrakeGrid));
  for (int w = 0; w < static_cast<int>(windows_.size()); ++w) {
    for (int k = 0; k < kSwingLimits; ++k) {
      // With joint 2 at rest both its motors turn alike.
      const bool held =
          (k == kRange2 || k == kDriveSpeed3) && task_.settings.shoulder == Shoulder::kHeld;
      // In the follow-through each joint brakes by itself: the map from the swing model is not used.
      if (!held && !(k == kElbow && braking(windows_[w])))
        rows_.push_back({static_cast<SwingLimit>(k), w});
    }
  }
}

void SwingProblem::addWindow(double end, double step) {
  const double begin = grid_.back();
  const int steps =
      std::max(2, static_cast<int>(std::ceil((end - begin) * task_.grid_density / step - 1e-9)));
  const int first = static_cast<int>(grid_.size()) - 1;
  for (int i = 1; i < steps; ++i)
    grid_.push_back(begin + (end - begin) * i / steps);
  grid_.push_back(end);
  windows_.push_back({first, first + steps});
}

void SwingProblem::setBounds() {
  const model::ArmParameters& arm = task_.arm->parameters();
  const SwingSettings& settings = task_.settings;
  // The constants of the base functions, which the joints' ranges bound.
  lower_.setConstant(-10);
  upper_.setConstant(10);
  const auto bound = [this](SwingVariable variable, double low, double high) {
    lower_[variable] = low;
    upper_[variable] = high;
  };
  bound(kAlpha1, -1.5, 1.5);
  bound(kOmega1, 1.5, settings.omega_max[0]);
  bound(kPhi1, -1.0, 0.8);
  bound(kAmplitude2, -1.5, 1.5);
  bound(kOmega2, 3, settings.omega_max[1]);
  bound(kSwitch2, -0.05, 0.05);
  bound(kAlpha3, -2.5, 2.5);
  bound(kOmega3, 2, settings.omega_max[2]);
  bound(kPhi3, -1.0, 0.8);
  const bool free = settings.shoulder == Shoulder::kFree;
  bound(kAlphaGamma, free ? -1.5 : 0, free ? 1.5 : 0);
  bound(kOmegaGamma, free ? 1.5 : 3, free ? settings.omega_max[0] : 3);
  bound(kPhiGamma, free ? -1.0 : 0, free ? 0.8 : 0);
  bound(kGamma, free ? -2 : 0.2, arm.q_max[1] - arm.position_margin - 1e-4);
  bound(kFlightTime, 0.15, 1.5);
  bound(kWristRoll, -4 * M_PI, 4 * M_PI);
  bound(kWristFlexion, -M_PI / 2, M_PI / 2);
}

double SwingProblem::rollLimit() const {
  // A wrist that turns all the way round has none: the same hand a turn further is within its stops.
  const double limit = task_.hand->parameters().wrist_limit;
  return limit >= M_PI ? std::numeric_limits<double>::infinity() : limit;
}

SwingProblem::Peak SwingProblem::peak(const Row& row, const Motion& motion) const {
  const Window& window = windows_[row.window];
  const int first = std::max(window.first, motion.first());
  Peak peak;
  if (first > window.last)
    return peak;  // at rest: the next window looks at that
  int highest = first;
  for (int i = first; i <= window.last; ++i) {
    if (!(motion.value(row.limit, i) <= motion.value(row.limit, highest)))
      highest = i;
  }
  peak = {motion.value(row.limit, highest), grid_[highest], motion.q3(highest)};
  if (!(peak.value > kNear) || window.last - first < 2)
    return peak;
  const int middle = std::clamp(highest, first + 1, window.last - 1);
  Parabola parabola;
  for (int i = 0; i < 3; ++i) {
    parabola.t[i] = grid_[middle - 1 + i];
    parabola.v[i] = motion.value(row.limit, middle - 1 + i);
  }
  const double begin = parabola.t[0], end = parabola.t[2];
  const auto look = [&](double t) {
    const double value = motion.valueAt(row.limit, t, peak.q3_near);
    if (value > peak.value)
      peak = {value, t, peak.q3_near};
    return value;
  };
  double half = (end - begin) / 2;
  for (int round = 0; round < kRefinements; ++round) {
    half /= kNarrowing;
    const double centre = std::clamp(parabola.peakTime(), begin + half, end - half);
    for (int i = 0; i < 3; ++i) {
      parabola.t[i] = centre + (i - 1) * half;
      parabola.v[i] = look(parabola.t[i]);
    }
  }
  look(parabola.peakTime());
  return peak;
}

SwingProblem::Values SwingProblem::evaluate(const SwingVector& x) const {
  const Motion motion(*this, x);
  Values values;
  values.inequalities.resize(inequalityCount());
  values.peaks.reserve(rows_.size());
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    values.peaks.push_back(peak(rows_[i], motion));
    values.inequalities[i] = values.peaks[i].value;
  }
  const ReleaseConditions::Values release = release_.values(x, motion.curve().at(0));
  values.release_speed = release.speed;
  values.inequalities.tail<3>() << release.hand_lead,
      std::max(std::abs(x[kWristRoll]) / rollLimit(),
               std::abs(x[kWristFlexion]) / task_.settings.flexion_limit) -
          1,
      release.grazing;
  values.equalities = release.equalities;
  values.q3_brake = motion.brakeStart().q[2];
  return values;
}

SwingProblem::Gradients SwingProblem::gradients(const SwingVector& x, const Values& values) const {
  const SwingCurve curve(x, elbow_sign_);
  const HeldBall held(*task_.hand, x[kWristRoll], x[kWristFlexion]);
  const FollowThrough& follow = task_.settings.follow;
  Gradients result;
  result.inequalities.setZero(inequalityCount(), kSwingVariables);
  const SwingDerivatives at_brake = curve.derivativesAt(follow.delay, values.q3_brake);
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const Peak& peak = values.peaks[i];
    if (!(peak.value > kFar))
      continue;
    SwingVector gradient = SwingVector::Zero();
    const auto add = [&](const model::ArmMotion& motion) {
      const SwingLimits::Gradient g = limits_.gradient(rows_[i].limit, motion, held);
      gradient[kWristRoll] = g.roll;
      gradient[kWristFlexion] = g.flexion;
      return g.motion;
    };
    if (peak.time > follow.delay) {
      const double since = peak.time - follow.delay;
      at_brake.pull(follow.beforeBraking(add(follow.braked(at_brake.motion(), since)), since),
                    gradient);
    } else {
      const SwingDerivatives at_peak = curve.derivativesAt(peak.time, peak.q3_near);
      at_peak.pull(add(at_peak.motion()), gradient);
    }
    result.inequalities.row(i) = gradient;
  }
  const ReleaseConditions::Gradients release = release_.gradients(x, curve.derivativesAt(0));
  result.release_speed = release.speed;
  result.inequalities.row(rows_.size()) = release.hand_lead;
  const double roll = x[kWristRoll] / rollLimit(),
               flexion = x[kWristFlexion] / task_.settings.flexion_limit;
  if (std::abs(roll) > std::abs(flexion)) {
    result.inequalities(rows_.size() + 1, kWristRoll) = std::copysign(1 / rollLimit(), roll);
  } else {
    result.inequalities(rows_.size() + 1, kWristFlexion) =
        std::copysign(1 / task_.settings.flexion_limit, flexion);
  }
  result.inequalities.row(rows_.size() + 2) = release.grazing;
  result.equalities = release.equalities;
  return result;
}

std::string SwingProblem::worstConstraint(const SwingVector& x) const {
  const Values values = evaluate(x);
  if (!std::isfinite(values.violation()))
    return "is no motion (its parameters give no finite numbers)";
  int worst = 0;
  const double violation = values.inequalities.maxCoeff(&worst);
  const double miss = values.equalities.tail<3>().norm();
  if (miss > violation)
    return fmt::format("misses it by {:.2g} m", miss);
  const int peaks = static_cast<int>(rows_.size());
  const std::string name = worst < peaks    ? SwingLimits::name(rows_[worst].limit)
                           : worst == peaks ? "Eq. (24): the hand must fall behind the ball"
                           : worst == peaks + 1
                               ? "the range of the wrist"
                               : "the least angle at which a ball may come through the ring";
  return fmt::format("breaks {} (by {:.2g} of it)", name, violation);
}

}  // namespace fastball::planner
