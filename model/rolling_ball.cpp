#include "model/rolling_ball.h"

#include <cmath>
#include <sstream>
#include <stdexcept>

#include "model/event_integration.h"

namespace fastball::model {
namespace {

using Eigen::Vector3d;

/// Entries of the state: rolling distance [m], its rate [m/s], the ball's spin about z' [rad/s].
enum { kX, kDx, kSpin, kEntries };
enum class Contact { kRolls, kSlides };

/// Eq. (18) for r' = (x, 0, 0), one time.
struct Balance {
  double drive;   ///< D [m/s^2], along x'
  double normal;  ///< F'y [N]
  double side;    ///< F'z [N], what keeps z' zero
  double w_z, dw_z;
};

class RollingBall {
 public:
  RollingBall(const BallParameters& ball,
              const FingerPair& fingers,
              const HandPath& hand_at,
              const RollingTask& task)
      : ball_(ball),
        fingers_(fingers),
        hand_at_(hand_at),
        task_(task),
        cos_beta_(fingers.cosBeta(ball.radius)),
        height_(fingers.rollingHeight(ball.radius)) {}

  RollingMotion run() {
    double t = task_.t_start;
    Eigen::VectorXd y = Eigen::VectorXd::Zero(kEntries);
    y[kSpin] = balance(t, y).w_z;
    bool on = balance(t, y).normal > 0;
    begin(t, y);
    while (on && t < task_.t_end) {
      const EventEnd end = integrateToEvent(piece(), t, y, task_.t_end);
      t = end.t;
      y = end.y;
      on = end.event < 0 || end.event == 1;
      motion_.rolled_off = end.event == 2;
      if (end.event == 1)
        begin(t, y);
    }
    motion_.released = !on;
    motion_.t_release = t;
    motion_.samples.push_back(sampleAt(t, y));
    const FingerFrameMotion frame = frameAt(t);
    motion_.ball.p_WBall = frame.X_WF * place(y);
    motion_.ball.v_WBall = releaseVelocity(frame, place(y), velocity(y));
    motion_.w_WBall = frame.X_WF.linear() * Vector3d(frame.w_F.x(), frame.w_F.y(), y[kSpin]);
    return std::move(motion_);
  }

 private:
  static Vector3d place(const Eigen::VectorXd& y) { return {y[kX], 0, 0}; }
  static Vector3d velocity(const Eigen::VectorXd& y) { return {y[kDx], 0, 0}; }
  FingerFrameMotion frameAt(double t) const { return fingerFrameMotion(fingers_, hand_at_(t)); }

  Balance balance(double t, const Eigen::VectorXd& y) const {
    const FingerFrameMotion frame = frameAt(t);
    const Vector3d v_W = releaseVelocity(frame, place(y), velocity(y));
    const Vector3d g = frame.X_WF.linear().transpose() *
                       flightAcceleration(v_W, ball_.dragPerMetre(), task_.gravity);
    const Vector3d &w = frame.w_F, &dw = frame.dw_F, &a0 = frame.a_F;
    const double x = y[kX], dx = y[kDx], m = ball_.mass;
    return {-a0.x() + g.x() + (w.y() * w.y() + w.z() * w.z()) * x,
            m * (a0.y() - g.y() + 2 * w.z() * dx + (dw.z() + w.x() * w.y()) * x),
            m * (a0.z() - g.z() - 2 * w.y() * dx + (w.x() * w.z() - dw.y()) * x), w.z(), dw.z()};
  }

  /// F'x [N] that rolling needs (Eqs. 19 and 21).
  double rollingFriction(const Balance& b) const {
    const double I = ball_.inertia(), h = height_, m = ball_.mass;
    const double ddx = (b.drive + I / (m * h) * b.dw_z) / (1 + I / (m * h * h));
    return I / h * (b.dw_z - ddx / h);
  }
  /// F'x [N] at the Coulomb limit.
  double limit(const Balance& b) const { return ball_.friction * b.normal / cos_beta_; }
  double friction(const Balance& b) const {
    return contact_ == Contact::kRolls ? rollingFriction(b) : -slip_sign_ * limit(b);
  }
  /// Velocity [m/s] of the ball's surface on the fingers.
  double slip(const Balance& b, const Eigen::VectorXd& y) const {
    return y[kDx] + height_ * (y[kSpin] - b.w_z);
  }

  /// Rolls if the friction allows, or begins to slide the way in which the friction gives in.
  void begin(double t, const Eigen::VectorXd& y) {
    const Balance b = balance(t, y);
    const double needed = rollingFriction(b);
    contact_ = std::abs(needed) < limit(b) ? Contact::kRolls : Contact::kSlides;
    slip_sign_ = needed > 0 ? -1 : 1;
    if (contact_ == Contact::kSlides && motion_.t_slip < 0)
      motion_.t_slip = t;
  }

  Eigen::VectorXd rate(double t, const Eigen::VectorXd& y) const {
    const Balance b = balance(t, y);
    const double F_x = friction(b);
    Eigen::VectorXd dy(kEntries);
    dy[kX] = y[kDx];
    dy[kDx] = b.drive + F_x / ball_.mass;
    dy[kSpin] = height_ * F_x / ball_.inertia();
    return dy;
  }

  /// Until the ball leaves (event 0), slips or stops slipping (event 1), or comes to the fingertips (event 2).
  EventTask piece() {
    EventTask piece;
    piece.derivative = [this](double t, const Eigen::VectorXd& y) { return rate(t, y); };
    piece.events = {[this](double t, const Eigen::VectorXd& y) { return balance(t, y).normal; },
                    [this](double t, const Eigen::VectorXd& y) {
                      const Balance b = balance(t, y);
                      return contact_ == Contact::kRolls ? limit(b) - std::abs(rollingFriction(b))
                                                         : slip_sign_ * slip(b, y);
                    },
                    [this](double, const Eigen::VectorXd& y) { return task_.fingertip - y[kX]; }};
    piece.sample = [this](double t, const Eigen::VectorXd& y) {
      motion_.samples.push_back(sampleAt(t, y));
    };
    piece.sample_step = task_.sample_step;
    piece.tolerance = task_.tolerance;
    return piece;
  }

  RollingSample sampleAt(double t, const Eigen::VectorXd& y) const {
    const Balance b = balance(t, y);
    return {
        t, place(y), velocity(y), {friction(b), b.normal, b.side}, contact_ == Contact::kSlides};
  }

  const BallParameters& ball_;
  const FingerPair& fingers_;
  const HandPath& hand_at_;
  const RollingTask& task_;
  double cos_beta_, height_;
  Contact contact_ = Contact::kRolls;
  int slip_sign_ = 1;
  RollingMotion motion_;
};

void requirePositive(double value, const char* name) {
  if (value > 0 && std::isfinite(value))
    return;
  std::ostringstream message;
  message << "a ball that rolls on fingers: " << name << " is " << value
          << ", it must be positive and finite";
  throw std::invalid_argument(message.str());
}

}  // namespace

void requireRolling(const BallParameters& ball, const RollingTask& task) {
  requirePositive(ball.mass, "its mass [kg]");
  requirePositive(ball.radius, "its radius [m]");
  requirePositive(task.sample_step, "the sample step [s]");
  requirePositive(task.tolerance, "the tolerance");
  if (!(ball.friction >= 0 && std::isfinite(ball.friction))) {
    std::ostringstream message;
    message << "a ball that rolls on fingers: the friction is " << ball.friction
            << ", it must be 0 or more and finite";
    throw std::invalid_argument(message.str());
  }
}

Vector3d releaseVelocity(const FingerFrameMotion& fingers,
                         const Vector3d& r_F,
                         const Vector3d& v_F) {
  return fingers.X_WF.linear() * (fingers.v_F + v_F + fingers.w_F.cross(r_F));
}

RollingMotion rollOnFingers(const BallParameters& ball,
                            const FingerPair& fingers,
                            const HandPath& hand_at,
                            const RollingTask& task) {
  requireRolling(ball, task);
  return RollingBall(ball, fingers, hand_at, task).run();
}

}  // namespace fastball::model
