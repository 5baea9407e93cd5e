#include <CLI/CLI.hpp>
#include <string>

#include "messaging/process.h"
#include "sim_bullet/node.h"

int main(int argc, char** argv) {
  namespace messaging = fastball::messaging;
  std::string uncertainty;
  const auto add_flags = [&](CLI::App& app) {
    app.add_option("--uncertainty", uncertainty, "File of errors to inject; default: none")
        ->check(CLI::ExistingFile)
        ->type_name("FILE");
  };
  const auto make_node = [&](messaging::LcmEndpoint& endpoint, const messaging::Clock& clock,
                             messaging::ProcessOptions options) {
    options.uncertainty = uncertainty;
    return fastball::sim_bullet::makeNode(endpoint, clock, options);
  };
  return messaging::processMain(
      argc, argv, "fastball-sim-bullet",
      "Simulates the arm, the hand, the ball, the net and the cameras, tick by tick.", make_node,
      add_flags);
}
