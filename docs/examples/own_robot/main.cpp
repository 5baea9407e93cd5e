// A robot of one's own in the simulator's place: a rigid arm, ideal fingers, a ball, a light curtain.
// A driver has the same messages, and its hardware in place of moveArm(), moveHand() and moveBall().
#include <config/experiment.h>
#include <messaging/process.h>
#include <model/arm.h>
#include <model/ball_flight.h>
#include <model/contact.h>
#include <model/hand.h>
using namespace fastball;
using Eigen::Map, Eigen::Vector3d, Eigen::Vector4d;
constexpr double kTick = 1e-3, kStep = 1e-4, kGravity = 9.81;
class StandInRobot : public messaging::Node {
 public:
  StandInRobot(messaging::Endpoint& endpoint,
               const messaging::Clock& clock,
               const config::Experiment& experiment)
      : endpoint_(endpoint), clock_(clock), experiment_(experiment) {
    endpoint.subscribe<scene_t>(messaging::kScene, [this](const scene_t& m) { begin(m); });
  }
  std::string name() const override { return "sim_bullet"; }  // whose place it takes
  messaging::NodeState state() const override {
    return {running_ ? "running" : scene_.scene_id > 0 ? "finished" : "idle", "", scene_.scene_id};
  }
  int64_t wakeUs() const override { return running_ ? said_us_ + 20000 : INT64_MAX; }
  void step() override {
    const auto answers = [this](const auto* command) {
      return command && command->scene_id == scene_.scene_id && command->tick == now_.tick;
    };
    if (running_ && answers(arm_command_.get()) && answers(hand_command_.get()))
      advance();
    else if (running_ && clock_.monotonicUs() >= wakeUs())
      sayStates();
  }

 private:
  struct Robot {  // and its ball, anew in each scene
    Vector4d q, qd = Vector4d::Zero();
    model::HandVector q_hand = model::HandVector::Zero();
    std::array<double, model::kFingers> force{};
    bool released = false;
    model::BallState ball;
    std::optional<model::Landing> landing;
    int64_t tick = 0;
    int32_t events = 0;
  };
  void begin(const scene_t& scene) {
    if (scene.scene_id <= scene_.scene_id)
      return;
    scene_ = scene;
    now_ = {Vector4d(scene.q_arm)};
    now_.q_hand = hand_.posture(0, 0, {0.1, 0.1, 0.1});
    running_ = true;
    sayStates();
  }
  void advance() {
    moveArm(arm_.clipTorque(Vector4d(arm_command_.get()->tau)));
    moveHand(model::HandVector(hand_command_.get()->q));
    ++now_.tick;
    if (!now_.released)
      moveBall();
    running_ = static_cast<double>(now_.tick) * kTick < scene_.duration;
    running_ ? sayStates() : sayLanding();
  }
  void moveArm(const Vector4d& tau) {
    for (double t = 0; t < kTick - kStep / 2; t += kStep) {
      now_.qd += kStep * arm_.forwardDynamics(now_.q, now_.qd, tau - arm_.frictionTorque(now_.qd));
      now_.q += kStep * now_.qd;
    }
  }
  // A finger that dents the ball presses with Eq. (27).
  void moveHand(const model::HandVector& to) {
    now_.q_hand = to;
    for (const model::Finger finger : {model::kFingerA, model::kThumb, model::kFingerB}) {
      const model::Segment distal = hand_.phalanges(finger, now_.q_hand)[1];
      const double distance = (distal.p_start + distal.p_end).head<2>().norm() / 2;
      const double y = experiment_.ball.radius + hand_.parameters().finger_radius - distance;
      now_.force[finger] = model::elasticForce(experiment_.ball, y);
    }
  }
  void moveBall() {
    const Vector3d p_T = hand_.X_TH(now_.q_hand[0], now_.q_hand[1]) * hand_.parameters().p_HBall;
    now_.ball = {arm_.p_WPoint(now_.q, p_T), arm_.pointJacobian(now_.q, p_T) * now_.qd};
    now_.released = hand_command_.get()->phase >= hand_command_t::RELEASE &&
                    now_.force[0] + now_.force[1] + now_.force[2] == 0;
    if (!now_.released)
      return;
    const model::Target target{Vector3d(scene_.p_WTarget), Vector3d(scene_.n_WTarget)};
    now_.landing = model::land(now_.ball, target, experiment_.ball.dragPerMetre(), kGravity);
    sayTruth(sim_truth_t::RELEASED);
  }
  int64_t utime() const { return scene_.utime + 1000 * now_.tick; }
  void sayStates() {
    arm_state_t arm{utime(), 0, scene_.scene_id, now_.tick, {}, {}, {}};
    Map<Vector4d>{arm.q} = now_.q;
    Map<Vector4d>{arm.qd} = now_.qd;
    hand_state_t hand{utime(), 0, scene_.scene_id, now_.tick, {}, {}, {}, {}, {}};
    Map<model::HandVector>{hand.q} = now_.q_hand;
    std::copy(now_.force.begin(), now_.force.end(), hand.f_normal);
    arm_states_.publish(arm);
    hand_states_.publish(hand);
    said_us_ = clock_.monotonicUs();
  }
  void sayLanding() {
    landing_t said{utime(), 0, scene_.scene_id};
    if (!now_.landing) {
      said.message = "no ball crossed the light curtain";
    } else {
      said.measured = 1;
      Map<Eigen::Vector2d>{said.landing} = now_.landing->landing;
      now_.ball = now_.landing->state;
      sayTruth(sim_truth_t::LANDED);
    }
    sayTruth(sim_truth_t::FINISHED);
    landings_.publish(said);
  }
  // Only a simulator can: a real robot leaves it out, and its throws are judged by LANDING.
  void sayTruth(int8_t event) {
    sim_truth_t truth{utime(), 0, scene_.scene_id, event, ++now_.events};
    Map<Vector3d>{truth.p_WBall} = now_.ball.p_WBall;
    Map<Vector3d>{truth.v_WBall} = now_.ball.v_WBall;
    if (now_.landing)
      Map<Eigen::Vector2d>{truth.landing} = now_.landing->landing;
    truths_.publish(truth);
  }
  messaging::Endpoint& endpoint_;
  const messaging::Clock& clock_;
  config::Experiment experiment_;
  model::Arm arm_{experiment_.arm, experiment_.hand.payload};
  model::Hand hand_{experiment_.hand};
  messaging::Latest<arm_command_t> arm_command_{endpoint_, messaging::kArmCommand};
  messaging::Latest<hand_command_t> hand_command_{endpoint_, messaging::kHandCommand};
  messaging::Publisher<arm_state_t> arm_states_{endpoint_, messaging::kArmState};
  messaging::Publisher<hand_state_t> hand_states_{endpoint_, messaging::kHandState};
  messaging::Publisher<landing_t> landings_{endpoint_, messaging::kLanding};
  messaging::Publisher<sim_truth_t> truths_{endpoint_, messaging::kSimTruth};
  scene_t scene_{};
  Robot now_;
  bool running_ = false;
  int64_t said_us_ = 0;
};

int main(int argc, char** argv) {
  return messaging::processMain(
      argc, argv, "stand-in-robot", "A robot without Bullet, in the simulator's place.",
      [](auto& endpoint, const auto& clock, const messaging::ProcessOptions& options) {
        const std::string file = config::experimentPath(options.config);
        return std::make_unique<StandInRobot>(endpoint, clock, config::loadExperiment(file));
      });
}
