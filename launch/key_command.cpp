#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "launch/commands.h"
#include "messaging/command_key.h"
#include "messaging/process.h"

namespace fastball::launch {

void addKeyCommand(CLI::App& app, int& exit_status) {
  CLI::App* command = app.add_subcommand(
      "key", "Make a key for --key: 32 random bytes in a new file that only its owner can read");
  auto path = std::make_shared<std::string>();
  command->add_option("FILE", *path, "File to make; one that is there is not overwritten")
      ->required();
  command->callback([path, &exit_status] {
    const auto key = messaging::CommandKey::make(*path);
    fmt::print("key {} in {}; copy it to every machine, readable by its owner only\n", key.id(),
               *path);
    exit_status = messaging::kExitDone;
  });
}

}  // namespace fastball::launch
