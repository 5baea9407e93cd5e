#include <CLI/CLI.hpp>
#include <string>

#include "messaging/process.h"
#include "sim_bullet/node.h"

int main(int argc, char** argv) {
  namespace messaging = fastball::messaging;
  std::string uncertainty;
  bool no_images = false;
  const auto add_flags = [&](CLI::App& app) {
    app.add_option("--uncertainty", uncertainty, "File of errors to inject; default: none")
        ->check(CLI::ExistingFile)
        ->type_name("FILE");
    app.add_flag(
        "--no-images", no_images,
        "No cameras: a light curtain in the net's ring says LANDING in the tracker's place");
  };
  const auto make_node = [&](messaging::LcmEndpoint& endpoint, const messaging::Clock& clock,
                             messaging::ProcessOptions options) {
    options.uncertainty = uncertainty;
    options.images = !no_images;
    return fastball::sim_bullet::makeNode(endpoint, clock, options);
  };
  return messaging::processMain(
      argc, argv, "fastball-sim-bullet",
      "Simulates the arm, the hand, the ball, the net and the cameras, tick by tick.", make_node,
      add_flags);
}
