#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <fstream>
#include <memory>
#include <stdexcept>

#include "launch/commands.h"
#include "launch/docs/manual.h"
#include "messaging/process.h"
#include "messaging/version.h"

namespace fastball::launch {
namespace {

void write(const std::string& path, const std::string& text) {
  std::ofstream file(path);
  if (!(file << text).flush())
    throw std::runtime_error(fmt::format("{}: cannot be written", path));
}

}  // namespace

void addManualCommand(CLI::App& app, int& exit_status) {
  CLI::App* command =
      app.add_subcommand("manual", "The manual page and bash's completion of this command");
  auto man = std::make_shared<std::string>();
  auto completion = std::make_shared<std::string>();
  command->add_option("--man", *man, "File for the manual page (troff); default: standard output");
  command->add_option("--completion", *completion, "File for bash's completion");
  command->callback([&app, man, completion, &exit_status] {
    const std::string page = manualPage(app, messaging::version());
    if (!man->empty())
      write(*man, page);
    if (!completion->empty())
      write(*completion, bashCompletion(app));
    if (man->empty() && completion->empty())
      fmt::print("{}", page);
    exit_status = messaging::kExitDone;
  });
}

}  // namespace fastball::launch
