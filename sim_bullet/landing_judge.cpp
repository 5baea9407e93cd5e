#include "sim_bullet/landing_judge.h"

#include <algorithm>

namespace fastball::sim_bullet {
namespace {

/// A ball that nothing has touched for this long [s] has left: contacts chatter for less.
constexpr double kReleaseTime = 3e-3;

constexpr std::array<const char*, 4> kHandParts{"finger A", "thumb", "finger B", "palm"};

}  // namespace

LandingJudge::LandingJudge(const model::Target& target, double drag_per_metre, double gravity)
    : target_(target), drag_per_metre_(drag_per_metre), gravity_(gravity) {}

void LandingJudge::step(const JudgedStep& step, std::vector<SceneEvent>* events) {
  watchHand(step, events);
  if (!landed_ && !spoilt_)
    watchPlane(step, events);
}

void LandingJudge::watchHand(const JudgedStep& step, std::vector<SceneEvent>* events) {
  if (!begun_) {  // until something else touches the ball, it was let go at the beginning
    last_touch_.time = step.time - step.dt;
    last_touch_.ball = step.before;
    begun_ = true;
  }
  const auto toucher = std::find(step.hand_touches.begin(), step.hand_touches.end(), true);
  const bool touched = toucher != step.hand_touches.end();
  if (step.held || touched) {
    last_touch_.time = step.time;
    last_touch_.ball = step.after;
    last_touch_.w_WBall = step.w_WBall;
    if (free_ && touched) {
      SceneEvent event = last_touch_;
      event.kind = SceneEvent::Kind::kTouched;
      event.note = kHandParts[toucher - step.hand_touches.begin()];
      events->push_back(event);
    }
    free_ = false;
    return;
  }
  if (free_ || step.time - last_touch_.time < kReleaseTime)
    return;
  free_ = true;
  if (!released_)
    events->push_back(last_touch_);
  released_ = true;
}

void LandingJudge::watchPlane(const JudgedStep& step, std::vector<SceneEvent>* events) {
  const double before = target_.distance(step.before.p_WBall);
  const double after = target_.distance(step.after.p_WBall);
  if (before > 0 && after <= 0) {
    const double share = before / (before - after);
    model::BallState ball;
    ball.p_WBall = step.before.p_WBall + share * (step.after.p_WBall - step.before.p_WBall);
    ball.v_WBall = step.before.v_WBall + share * (step.after.v_WBall - step.before.v_WBall);
    land(step, step.time - (1 - share) * step.dt, ball, events);
  } else if (step.ring_touches && before > 0) {
    const auto landing = model::land(step.before, target_, drag_per_metre_, gravity_);
    if (landing)
      land(step, step.time - step.dt + landing->time, landing->state, events);
    spoilt_ = !landing;
  } else if (step.floor_touches) {
    spoilt_ = true;
  }
}

void LandingJudge::land(const JudgedStep& step,
                        double time,
                        const model::BallState& ball,
                        std::vector<SceneEvent>* events) {
  SceneEvent event;
  event.kind = SceneEvent::Kind::kLanded;
  event.time = time;
  event.ball = ball;
  event.w_WBall = step.w_WBall;
  event.landing = target_.planeCoordinates(ball.p_WBall);
  events->push_back(event);
  landed_ = true;
}

}  // namespace fastball::sim_bullet
