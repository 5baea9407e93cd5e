#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "model/ball_flight.h"
#include "model/target.h"

namespace fastball::sim_bullet {

/// What happened to the ball, as SIM_TRUTH tells it.
struct SceneEvent {
  enum class Kind { kReleased, kTouched, kLanded };
  Kind kind = Kind::kReleased;
  double time = 0;                                    ///< [s] of the scene
  model::BallState ball;                              ///< at that time
  Eigen::Vector3d w_WBall = Eigen::Vector3d::Zero();  ///< [rad/s]
  Eigen::Vector2d landing = Eigen::Vector2d::Zero();  ///< [m], kLanded: in the target plane
  const char* note = "";                              ///< kTouched: what touched it
};

/// One physics step as the judge sees it.
struct JudgedStep {
  double time = 0;  ///< [s], end of the step
  double dt = 0;    ///< [s]
  model::BallState before, after;
  Eigen::Vector3d w_WBall = Eigen::Vector3d::Zero();  ///< [rad/s], after
  bool held = false;                                  ///< the feeder has the ball
  std::array<bool, 4> hand_touches{};                 ///< finger A, thumb, finger B, palm
  bool ring_touches = false;
  bool floor_touches = false;
};

/// Decides when the ball is released, what touches it afterwards, and where it lands.
///
/// Released: no part of the hand has touched the ball for 3 ms; the event carries time and state of
/// the last touch. Landed: the centre crosses the target plane from its front, interpolated in the
/// step. A ball that meets the ring before its centre reaches the plane has landed where its free
/// flight would have gone on to; one that meets the floor before does not land.
class LandingJudge {
 public:
  /// @param drag_per_metre [1/m]. @param gravity [m/s^2].
  LandingJudge(const model::Target& target, double drag_per_metre, double gravity);

  /// Takes the next step; appends at most one event of each kind.
  void step(const JudgedStep& step, std::vector<SceneEvent>* events);
  bool released() const { return released_; }

 private:
  void watchHand(const JudgedStep& step, std::vector<SceneEvent>* events);
  void watchPlane(const JudgedStep& step, std::vector<SceneEvent>* events);
  void land(const JudgedStep& step,
            double time,
            const model::BallState& ball,
            std::vector<SceneEvent>* events);

  model::Target target_;
  double drag_per_metre_;
  double gravity_;
  SceneEvent last_touch_;
  bool begun_ = false;
  bool free_ = false;  ///< nothing has touched the ball for 3 ms
  bool released_ = false;
  bool landed_ = false;
  bool spoilt_ = false;  ///< the ball met the floor first: it cannot land any more
};

}  // namespace fastball::sim_bullet
