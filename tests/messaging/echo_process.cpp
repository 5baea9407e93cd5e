// A process of its own for process_test: answers every ARM_STATE with an ARM_COMMAND, and does what its flags say.
#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <stdexcept>

#include "messaging/process.h"

namespace {

using namespace fastball;
using namespace fastball::messaging;

class EchoNode : public Node {
 public:
  EchoNode(Endpoint& endpoint, std::string failure)
      : publisher_(endpoint, kArmCommand), failure_(std::move(failure)) {
    endpoint.subscribe<arm_state_t>(kArmState, [this](const auto& state) {
      arm_command_t command{};
      command.tick = state.tick;
      publisher_.publish(command);
    });
  }
  std::string name() const override { return "echo"; }
  void step() override {
    if (failure_ == "throw")
      throw std::runtime_error("the step failed");
  }
  NodeState state() const override {
    return failure_ == "state" ? NodeState{"failed", "the arm is gone", 0} : NodeState{};
  }
  bool finished() const override { return failure_ == "state"; }
  void shutDown() override {
    fmt::print("shut down\n");
    std::fflush(stdout);
  }

 private:
  Publisher<arm_command_t> publisher_;
  std::string failure_;
};

}  // namespace

int main(int argc, char** argv) {
  std::string failure;
  const auto make_node = [&](LcmEndpoint& endpoint, const Clock&, const ProcessOptions&) {
    if (failure == "usage")
      throw std::invalid_argument("experiment.yaml:3: radius is -1, must be above 0");
    if (failure == "slow start")
      sleep(1);
    return std::make_unique<EchoNode>(endpoint, failure);
  };
  return processMain(argc, argv, "echo", "Answers states with commands.", make_node,
                     [&](CLI::App& app) { app.add_option("--fail", failure, "How to fail"); });
}
