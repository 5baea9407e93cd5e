// What the experiment says of itself: its state, its progress, and whom it waits for.
#include <fmt/format.h>

#include <algorithm>

#include "launch/experiment_node.h"

namespace fastball::launch {
namespace {

constexpr double kMicro = 1e6;

const char* phaseName(ExperimentNode::Phase phase) {
  switch (phase) {
    case ExperimentNode::Phase::kPlanning:
      return "planning";
    case ExperimentNode::Phase::kArming:
      return "arming";
    case ExperimentNode::Phase::kStarting:
      return "starting";
    case ExperimentNode::Phase::kThrowing:
      return "throwing";
    case ExperimentNode::Phase::kDone:
      return "done";
    case ExperimentNode::Phase::kFailed:
      return "failed";
  }
  return "failed";
}

const char* armPhaseName(int8_t phase) {
  switch (phase) {
    case arm_command_t::APPROACH:
      return "approach";
    case arm_command_t::READY:
      return "ready";
    case arm_command_t::SWING:
      return "swing";
    case arm_command_t::FOLLOW_THROUGH:
      return "follow-through";
    case arm_command_t::HOLD:
      return "hold";
    case arm_command_t::BRAKE:
      return "brake";
    default:
      return "rest";
  }
}

}  // namespace

std::string ExperimentNode::missing(const std::vector<std::string>& names,
                                    const std::string& state) const {
  std::string list;
  for (const std::string& process : names) {
    if (roster_.holds(process, id(), state))
      continue;
    const heartbeat_t* heartbeat = roster_.newest(process);
    if (!list.empty())
      list += ", ";
    list += process;
    if (heartbeat == nullptr) {
      list += " (never heard)";
    } else if (!heartbeat->detail.empty()) {
      list += " (" + heartbeat->detail + ")";
    } else {
      list += " (" + heartbeat->state + ")";
    }
  }
  return list;
}

std::string ExperimentNode::withoutPlan() const {
  std::vector<std::string> names = {"controller", "hand_server"};
  if (settings_.images)
    names.emplace_back("vision_tracker");
  return missing(names, "");
}

std::string ExperimentNode::withoutOrder() const {
  return missing({"controller", "hand_server"}, "armed");
}

std::string ExperimentNode::waitingFor() const {
  // Why somebody does not answer is often what it says: that it refuses what it hears, for example.
  const auto words = [this](const std::string& name) {
    const heartbeat_t* heartbeat = roster_.newest(name);
    const bool speaks = heartbeat != nullptr && !heartbeat->detail.empty();
    return speaks ? fmt::format(" ({}: {})", name, heartbeat->detail) : "";
  };
  switch (phase_) {
    case Phase::kPlanning:
      return plan_ ? "the plan was not taken by " + withoutPlan()
                   : "the planner did not answer PLAN_REQUEST" + words("planner");
    case Phase::kArming:
      return "THROW_START was not taken by " + withoutOrder();
    case Phase::kStarting:
      return "sim_bullet did not answer SCENE" + words("sim_bullet");
    default:
      return fmt::format(
          "the scene stopped at {:.3f} s{}",
          static_cast<double>(status_.utime - sceneUtime(settings_, number_)) / kMicro,
          words("sim_bullet"));
  }
}

messaging::NodeState ExperimentNode::state() const {
  return {phaseName(phase_), error_, id()};
}

std::string ExperimentNode::progress() const {
  std::string text = fmt::format("throw {} of {}, ", number_, settings_.throws);
  if (phase_ != Phase::kThrowing)
    return text + phaseName(phase_);
  if (sceneFinished())
    return text + "measuring";
  const auto scene_us = static_cast<double>(status_.utime - sceneUtime(settings_, number_));
  return text +
         fmt::format("{}, {:.2f} s", armPhaseName(status_.phase), std::max(0.0, scene_us / kMicro));
}

}  // namespace fastball::launch
