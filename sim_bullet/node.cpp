#include "sim_bullet/node.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace fastball::sim_bullet {
namespace {

constexpr int64_t kTickUs = 1000;
/// Lockstep: an answer later than this [us of wall time] may have been lost.
constexpr int64_t kRepeatUs = 20000;
constexpr int64_t kEventRepeatUs = 200000;  // wall time
constexpr int kEventRepeats = 10;
/// SIM_TRUTH and CAMERA_INFO, in ticks.
constexpr int64_t kTruthTicks = 10;
constexpr int64_t kCameraInfoTicks = 1000;
/// Real time: a simulator further behind than this [us] lets the wall time go instead of running after it.
constexpr int64_t kMostBehindUs = 100000;

constexpr double kLongestScene = 600;     // [s]
constexpr int64_t kLatestUs = 1LL << 60;  // leaves room for the scene's own time
constexpr double kLeastUpright = 0.05;    // horizontal part of the net's normal
constexpr double kLargestRing = 10;       // [m]

/// A message may be well formed and still no scene. @throw std::invalid_argument
void requireRealScene(const scene_t& message) {
  if (message.duration > kLongestScene)
    throw std::invalid_argument(fmt::format("scene {} would last {} s; the longest lasts {} s",
                                            message.scene_id, message.duration, kLongestScene));
  if (message.utime > kLatestUs)
    throw std::invalid_argument(
        fmt::format("scene {} would begin at {} us; the latest begins at {} us", message.scene_id,
                    message.utime, kLatestUs));
  if (std::hypot(message.n_WTarget[0], message.n_WTarget[1]) < kLeastUpright)
    throw std::invalid_argument(
        fmt::format("the net of scene {} lies flat: its normal is ({}, {}, {})", message.scene_id,
                    message.n_WTarget[0], message.n_WTarget[1], message.n_WTarget[2]));
  if (message.target_radius > kLargestRing)
    throw std::invalid_argument(
        fmt::format("the net of scene {} has a radius of {} m; the largest has {} m",
                    message.scene_id, message.target_radius, kLargestRing));
}

}  // namespace

SimulatorSetup loadSetup(const messaging::ProcessOptions& options) {
  const std::string path = config::experimentPath(options.config);
  SimulatorSetup setup;
  setup.experiment = config::loadExperiment(path);
  setup.settings = loadSimulationSettings(path);
  if (!options.uncertainty.empty())
    setup.uncertainty = loadUncertainty(options.uncertainty);
  if (options.images)
    setup.cameras = readCameraRig(path);
  if (options.one_thread && setup.cameras)
    setup.cameras->workers = 0;
  setup.realtime = options.realtime;
  return setup;
}

SimNode::SimNode(messaging::Endpoint& endpoint,
                 const messaging::Clock& clock,
                 const SimulatorSetup& setup)
    : endpoint_(endpoint),
      clock_(clock),
      setup_(setup),
      arm_states_(endpoint, messaging::kArmState),
      hand_states_(endpoint, messaging::kHandState),
      truths_(endpoint, messaging::kSimTruth) {
  if (setup_.cameras) {
    cameras_.emplace(endpoint, clock, !setup_.realtime, *setup_.cameras, setup_.experiment,
                     setup_.uncertainty);
  } else {
    landings_.emplace(endpoint, messaging::kLanding);
  }
  endpoint.subscribe<scene_t>(messaging::kScene, [this](const scene_t& m) { take(m); });
  // A command answers the tick that was said last; in real time it may answer any tick since the one before it.
  endpoint.subscribe<arm_command_t>(messaging::kArmCommand, [this](const arm_command_t& m) {
    take(m, arm_watch_, &arm_command_);
  });
  endpoint.subscribe<hand_command_t>(messaging::kHandCommand, [this](const hand_command_t& m) {
    take(m, hand_watch_, &hand_command_);
  });
}

void SimNode::take(const scene_t& message) {
  if (message.scene_id > message_.scene_id) {
    next_scene_ = message;
  } else if (message.scene_id == message_.scene_id && curtain_landing_) {
    landings_->publish(*curtain_landing_);  // it was lost on the way
  }
}

template <class Command>
void SimNode::take(const Command& message, CommandWatch& watch, std::optional<Command>* newest) {
  const bool one_sender = watch.accepts(message, [this] { return endpoint_.sender(); });
  const bool this_scene = running() && message.scene_id == message_.scene_id;
  const int64_t tick = this_scene ? scene_->tick() : 0;
  const bool fits = setup_.realtime
                        ? message.tick <= tick && (!*newest || message.tick > (*newest)->tick)
                        : message.tick == tick;
  if (one_sender && this_scene && fits)
    *newest = message;
  else
    ++stray_commands_;
}

messaging::NodeState SimNode::state() const {
  messaging::NodeState state = state_;
  for (const CommandWatch* watch : {&arm_watch_, &hand_watch_}) {
    const bool both = !state.detail.empty() && !watch->sentence().empty();
    state.detail += (both ? "; " : "") + watch->sentence();
  }
  return state;
}

void SimNode::step() {
  if (next_scene_) {
    const scene_t message = *next_scene_;
    next_scene_.reset();
    begin(message);
  }
  if (repeats_ > 0 && clock_.monotonicUs() >= next_repeat_us_)
    repeatEvents();
  if (!running())
    return;
  if (setup_.realtime)
    stepRealtime();
  else
    stepLockstep();
  // The images of a scene that has just ended have been said.
  if (cameras_ && running())
    cameras_->sayImages();
}

int64_t SimNode::wakeUs() const {
  if (next_scene_)
    return clock_.monotonicUs();
  const int64_t repeat_us = repeats_ > 0 ? next_repeat_us_ : INT64_MAX;
  if (!running())
    return repeat_us;
  return std::min(repeat_us, setup_.realtime ? start_us_ + (scene_->tick() + 1) * kTickUs
                                             : said_us_ + kRepeatUs);
}

void SimNode::begin(const scene_t& message) {
  if (running())
    end("finished", fmt::format("given up for scene {}", message.scene_id));
  message_ = message;
  arm_command_.reset();
  hand_command_.reset();
  arm_watch_.beginScene(message.scene_id);
  hand_watch_.beginScene(message.scene_id);
  stray_commands_ = 0;
  braking_ = false;
  curtain_landing_.reset();
  try {
    requireRealScene(message);
    scene_ = std::make_unique<Scene>(setup_.experiment, setup_.settings, setup_.uncertainty,
                                     sceneStart(message));
  } catch (const std::exception& error) {
    state_ = {"failed", error.what(), message.scene_id};
    return;
  }
  last_tick_ = std::max<int64_t>(1, std::llround(message.duration / kTick));
  state_ = {"running", "", message.scene_id};
  start_us_ = clock_.monotonicUs();
  if (cameras_) {
    cameras_->beginScene(message, *scene_);
    cameras_->sayInfo(message.utime);
  }
  say(sim_truth_t::SAMPLE);
  sayStates();
}

void SimNode::stepLockstep() {
  const bool last_tick = scene_->tick() + 1 >= last_tick_;
  const bool braking = arm_command_ && arm_command_->phase == arm_command_t::BRAKE;
  // A braking arm waits for no image; by the last tick it rests.
  const bool held_up = cameras_ && (last_tick || !braking) && cameras_->holdUp(last_tick);
  if (arm_command_ && hand_command_ && !held_up) {
    scene_->advance(armTorque(*arm_command_), heldCommand());
    arm_command_.reset();
    hand_command_.reset();
    afterTick();
  } else if (clock_.monotonicUs() - said_us_ >= kRepeatUs) {
    sayStates();
  }
}

void SimNode::stepRealtime() {
  const int64_t now_us = clock_.monotonicUs();
  start_us_ = std::max(start_us_, now_us - kMostBehindUs - scene_->tick() * kTickUs);
  while (running() && start_us_ + (scene_->tick() + 1) * kTickUs <= now_us)
    tickRealtime();
}

void SimNode::tickRealtime() {
  const HandCommand hand = heldCommand();
  const int64_t limit = std::llround(setup_.settings.watchdog / kTick);
  const bool alive = arm_command_ && scene_->tick() - arm_command_->tick <= limit;
  if (alive)
    scene_->advance(armTorque(*arm_command_), hand);
  else
    scene_->brake(hand);
  if (alive == braking_ || scene_->tick() == 1)
    state_.detail = alive ? "" : fmt::format("braking: no ARM_COMMAND for more than {} ms", limit);
  braking_ = !alive;
  afterTick();
}

HandCommand SimNode::heldCommand() {
  if (!hand_command_)
    return scene_->openHand();
  const HandCommand hand = handCommand(*hand_command_);
  constexpr int kFingerJoints = model::kHandJoints - model::kSpreadA;
  int joint = 0;
  const double fastest = hand.qd.tail<kFingerJoints>().cwiseAbs().maxCoeff(&joint);
  const double speed_max = setup_.experiment.hand.joint_speed_max;
  if (fastest > speed_max && state_.detail.empty()) {
    state_.detail = fmt::format(
        "saturated: HAND_COMMAND asks for {:.4g} rad/s of hand joint {} at tick {}, its drive does "
        "{:.4g} rad/s",
        fastest, model::kSpreadA + joint, scene_->tick(), speed_max);
  }
  return hand;
}

void SimNode::afterTick() {
  if (!scene_->healthy()) {
    end("failed", fmt::format("the state of scene {} is no longer finite at tick {}",
                              message_.scene_id, scene_->tick()));
    return;
  }
  for (const SceneEvent& event : scene_->events()) {
    sayEvent(truth(event, message_.utime, message_.scene_id, scene_->state().q.arm));
    if (event.kind == SceneEvent::Kind::kLanded)
      sayLanding(&event);
  }
  if (cameras_)
    cameras_->add(scene_->snapshot(message_.utime));
  if (scene_->tick() >= last_tick_) {
    end("finished", fmt::format("scene {} has run its {} s", message_.scene_id, message_.duration));
    return;
  }
  if (scene_->tick() % kTruthTicks == 0)
    say(sim_truth_t::SAMPLE);
  if (cameras_ && scene_->tick() % kCameraInfoTicks == 0)
    cameras_->sayInfo(stamp().utime);
  sayStates();
}

TickStamp SimNode::stamp() const {
  return {message_.utime + scene_->tick() * kTickUs, message_.scene_id, scene_->tick()};
}

void SimNode::sayStates() {
  arm_state_t arm = armState(stamp(), scene_->state());
  hand_state_t hand = handState(stamp(), scene_->state());
  arm_states_.publish(arm);
  hand_states_.publish(hand);
  arm_watch_.stateSaid(scene_->tick());
  hand_watch_.stateSaid(scene_->tick());
  said_us_ = clock_.monotonicUs();
}

void SimNode::say(int8_t event) {
  sim_truth_t message = truth(stamp(), event, scene_->ball(), scene_->state().q.arm);
  truths_.publish(message);
}

void SimNode::sayEvent(sim_truth_t message) {
  message.event_index = static_cast<int32_t>(events_.size()) + 1;
  events_.push_back(message);
  truths_.publish(message);
}

void SimNode::repeatEvents() {
  for (sim_truth_t message : last_events_)
    truths_.publish(message);
  --repeats_;
  next_repeat_us_ = clock_.monotonicUs() + kEventRepeatUs;
}

void SimNode::sayLanding(const SceneEvent* landed) {
  if (!landings_ || curtain_landing_)
    return;
  curtain_landing_ = curtainLanding(stamp(), landed, setup_.settings.light_curtain, message_.seed);
  landings_->publish(*curtain_landing_);
}

void SimNode::end(const std::string& state, const std::string& note) {
  if (cameras_)
    cameras_->finish();
  if (scene_->healthy()) {
    sim_truth_t message =
        truth(stamp(), sim_truth_t::FINISHED, scene_->ball(), scene_->state().q.arm);
    message.note = note;
    sayEvent(message);
  }
  sayLanding(nullptr);
  last_events_ = std::move(events_);
  events_.clear();
  repeats_ = kEventRepeats;
  next_repeat_us_ = clock_.monotonicUs() + kEventRepeatUs;
  scene_.reset();
  state_ = {state, note, message_.scene_id};
}

std::unique_ptr<messaging::Node> makeNode(messaging::Endpoint& endpoint,
                                          const messaging::Clock& clock,
                                          const messaging::ProcessOptions& options) {
  return std::make_unique<SimNode>(endpoint, clock, loadSetup(options));
}

}  // namespace fastball::sim_bullet
