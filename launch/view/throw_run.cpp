#include "launch/view/throw_run.h"

#include <fmt/format.h>

#include <csignal>
#include <regex>
#include <stdexcept>

namespace fastball::view {
namespace {

constexpr const char* kName = "run";
/// [s] for the run to end its own processes.
constexpr double kGrace = 5;

}  // namespace

ThrowRun::~ThrowRun() {
  if (processes_)
    processes_->stop(kGrace);
}

void ThrowRun::start(const ThrowOrder& order) {
  if (order.throws < 1 || order.throws > kMostThrows || order.seed < 0)
    throw std::invalid_argument(fmt::format(
        "{} throws with seed {} cannot be ordered here: 1 to {} throws, seed 0 or greater",
        order.throws, order.seed, kMostThrows));
  if (goesOn())
    return;
  launch::ProcessCommand command{kName,
                                 launch::programFolder() + "/fastball",
                                 {"run", "--throws", std::to_string(order.throws), "--seed",
                                  std::to_string(order.seed), "--lcm-url", place_.lcm_url}};
  if (order.realtime)
    command.arguments.emplace_back("--realtime");
  if (!place_.config.empty())
    command.arguments.insert(command.arguments.end(), {"--config", place_.config});
  if (!place_.key.empty())
    command.arguments.insert(command.arguments.end(), {"--key", place_.key});
  words_.clear();
  failed_ = false;
  processes_ = std::make_unique<launch::Processes>();
  processes_->start(command);
}

void ThrowRun::stop() {
  if (goesOn())
    ::kill(processes_->pid(kName), SIGINT);
}

bool ThrowRun::goesOn() {
  if (!processes_)
    return false;
  words_ = processes_->lastOutput(kName);
  const int status = processes_->exitStatus(kName);
  if (status < 0)
    return true;
  failed_ = status != 0;
  processes_.reset();
  // Who says the lines is clear.
  words_ = std::regex_replace(words_, std::regex("\\[run\\] "), "");
  return false;
}

}  // namespace fastball::view
