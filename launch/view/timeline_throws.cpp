// What a timeline makes of the messages about throws.
#include <algorithm>

#include "launch/view/timeline.h"
#include "model/ball_flight.h"

namespace fastball::view {
namespace {

constexpr int kPlannedPoints = 40;
constexpr int64_t kPathStepUs = 5'000;

}  // namespace

ViewedThrow& Timeline::newThrow(int64_t id) {
  ViewedThrow viewed;
  viewed.number = ++throw_count_;
  viewed.id = id;
  viewed.t = now();
  throws_.push_back(std::move(viewed));
  if (throws_.size() > limits_.throws)
    throws_.pop_front();
  changed(throws_.back());
  return throws_.back();
}

ViewedThrow& Timeline::throwOf(int64_t id) {
  const auto found = std::find_if(throws_.rbegin(), throws_.rend(),
                                  [id](const ViewedThrow& viewed) { return viewed.id == id; });
  return found == throws_.rend() ? newThrow(id) : *found;
}

void Timeline::note(ViewedThrow& viewed, const std::string& sentence) {
  if (sentence.empty() || viewed.note == sentence)
    return;
  viewed.note = sentence;
  viewed.t_note = now();
  changed(viewed);
}

double Timeline::timeOf(const ViewedThrow& viewed, int64_t utime) const {
  return viewed.offset ? 1e-6 * static_cast<double>(utime) + *viewed.offset : now();
}

void Timeline::hear(const plan_request_t& request) {
  ViewedThrow* viewed = &throwOf(request.request_id);
  // The number of a throw that has been made: another run.
  if (viewed->offset)
    viewed = &newThrow(request.request_id);
  if (viewed->target)
    return;  // said once more
  viewed->target = targetOf(request);
  viewed->strategy = request.strategy;
  changed(*viewed);
}

void Timeline::hear(const swing_plan_t& plan) {
  ViewedThrow& viewed = throwOf(plan.plan_id);
  if (viewed.plan)
    return;
  viewed.t_plan = now();
  viewed.plan = plan;
  viewed.plan->q.clear();
  viewed.plan->qd.clear();
  viewed.plan->qdd.clear();
  changed(viewed);
  if (plan.status != swing_plan_t::OK) {
    note(viewed, plan.message);
    return;
  }
  const model::BallState release{Eigen::Map<const Eigen::Vector3d>(plan.p_WBall_release),
                                 Eigen::Map<const Eigen::Vector3d>(plan.v_WBall_release)};
  for (int i = 0; i <= kPlannedPoints; ++i)
    viewed.planned_flight.push_back(model::fly(release, plan.flight_time * i / kPlannedPoints,
                                               experiment_.ball.dragPerMetre(),
                                               experiment_.arm.gravity)
                                        .p_WBall);
}

void Timeline::hear(const throw_start_t& start) {
  ViewedThrow& viewed = throwOf(start.scene_id);
  if (viewed.start)
    return;
  viewed.start = start;
  changed(viewed);
}

void Timeline::hear(const release_t& release) {
  ViewedThrow& viewed = throwOf(release.scene_id);
  (release.event == release_t::DEPARTED ? viewed.departed : viewed.commanded) = release;
  changed(viewed);
}

void Timeline::addPathToFirstFit(const ViewedThrow& viewed, const ball_track_t& first) {
  const model::BallState ball{Eigen::Map<const Eigen::Vector3d>(first.p_WBall),
                              Eigen::Map<const Eigen::Vector3d>(first.v_WBall)};
  for (int64_t utime = viewed.departed->utime; utime < first.utime; utime += kPathStepUs) {
    const auto p = model::fly(ball, 1e-6 * static_cast<double>(utime - first.utime), first.drag,
                              experiment_.arm.gravity)
                       .p_WBall;
    track_.push({timeOf(viewed, utime), viewed.number, p, false});
  }
}

void Timeline::hear(const ball_track_t& track) {
  ViewedThrow& viewed = throwOf(track.request_id);
  if (viewed.track_points++ == 0 && viewed.departed && viewed.offset)
    addPathToFirstFit(viewed, track);
  track_.push({timeOf(viewed, track.utime), viewed.number,
               Eigen::Map<const Eigen::Vector3d>(track.p_WBall), true});
}

void Timeline::hear(const landing_t& landing) {
  ViewedThrow& viewed = throwOf(landing.request_id);
  viewed.landing = landing;
  viewed.t_landing = now();
  changed(viewed);
  if (landing.measured == 0)
    note(viewed, landing.message);
}

void Timeline::hear(const controller_status_t& status) {
  if (!status.message.empty() && status.scene_id != 0)
    note(throwOf(status.scene_id), status.message);
}

void Timeline::hear(const estop_t& estop) {
  if (!throws_.empty())
    note(throws_.back(), "emergency stop: " + estop.reason);
}

}  // namespace fastball::view
