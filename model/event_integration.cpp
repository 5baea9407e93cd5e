#include "model/event_integration.h"

#include <algorithm>
#include <boost/numeric/odeint.hpp>
#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>

namespace fastball::model {
namespace {

namespace ode = boost::numeric::odeint;
using State = std::vector<double>;

constexpr double kFirstStep = 1e-6;  // [s]
constexpr int kLooks = 4;            // at the events within a step
constexpr int kHalvings = 60;

Eigen::Map<const Eigen::VectorXd> view(const State& x) {
  return {x.data(), static_cast<Eigen::Index>(x.size())};
}

class Integration {
 public:
  Integration(const EventTask& task, double t, const Eigen::VectorXd& y)
      : task_(task),
        stepper_(ode::make_dense_output(task.tolerance,
                                        task.tolerance,
                                        task.max_step,
                                        ode::runge_kutta_dopri5<State>())),
        interpolated_(y.data(), y.data() + y.size()),
        values_(task.events.size()) {
    stepper_.initialize(interpolated_, t, std::min(kFirstStep, task.max_step));
    next_sample_ = std::ceil(t / task.sample_step - 1e-9);
    for (std::size_t i = 0; i < values_.size(); ++i)
      values_[i] = task.events[i](t, y);
  }

  EventEnd run(double t, double t_end) {
    EventEnd end{t, view(interpolated_), -1};
    if (t == t_end)
      return end;
    while (end.event < 0 && end.t < t_end) {
      const auto [from, to] = step();
      for (int k = 1; k <= kLooks && end.event < 0 && end.t < t_end; ++k) {
        const double before = end.t;
        end.t = std::min(t_end, from + (to - from) * k / kLooks);
        look(before, &end);
      }
      sampleUpTo(end.t);
    }
    end.y = at(end.t);
    return end;
  }

 private:
  Eigen::VectorXd at(double t) {
    stepper_.calc_state(t, interpolated_);
    return view(interpolated_);
  }

  std::pair<double, double> step() {
    const auto rate = [this](const State& x, State& dx, double time) {
      dx.resize(x.size());
      Eigen::Map<Eigen::VectorXd>(dx.data(), static_cast<Eigen::Index>(dx.size())) =
          task_.derivative(time, view(x));
    };
    const std::pair<double, double> span = stepper_.do_step(rate);
    if (!view(stepper_.current_state()).allFinite()) {
      std::ostringstream message;
      message << "the motion does not stay finite at t = " << span.second << " s";
      throw std::runtime_error(message.str());
    }
    return span;
  }

  /// Whether one of the events has happened since `before`; then end is the first of them.
  void look(double before, EventEnd* end) {
    double first = std::numeric_limits<double>::infinity();
    const double now = end->t;
    for (std::size_t i = 0; i < values_.size(); ++i) {
      const double value = task_.events[i](now, at(now));
      if (values_[i] > 0 && value <= 0) {
        const double time = zero(i, before, now);
        if (time < first) {
          first = time;
          *end = {time, {}, static_cast<int>(i)};
        }
      }
      values_[i] = value;
    }
  }

  double zero(std::size_t event, double above, double below) {
    for (int i = 0; i < kHalvings && below - above > 1e-15; ++i) {
      const double middle = (above + below) / 2;
      (task_.events[event](middle, at(middle)) > 0 ? above : below) = middle;
    }
    return below;
  }

  void sampleUpTo(double t) {
    for (; task_.sample && next_sample_ * task_.sample_step < t; ++next_sample_) {
      const double time = next_sample_ * task_.sample_step;
      task_.sample(time, at(time));
    }
  }

  const EventTask& task_;
  ode::result_of::make_dense_output<ode::runge_kutta_dopri5<State>>::type stepper_;
  State interpolated_;
  std::vector<double> values_;  // of the events, when last looked at
  double next_sample_ = 0;
};

}  // namespace

EventEnd integrateToEvent(const EventTask& task, double t, const Eigen::VectorXd& y, double t_end) {
  if (!y.allFinite() || !(t_end >= t)) {
    std::ostringstream message;
    message << "a motion from t = " << t << " to " << t_end
            << " s needs a finite start and an end after it";
    throw std::runtime_error(message.str());
  }
  return Integration(task, t, y).run(t, t_end);
}

}  // namespace fastball::model
