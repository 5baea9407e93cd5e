#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <stdexcept>

#include "launch/commands.h"
#include "launch/docs/documents.h"
#include "messaging/process.h"

namespace fastball::launch {

void addDocsCommand(CLI::App& app, int& exit_status) {
  struct Options : DocumentOptions {
    std::vector<std::string> parts;
  };
  auto options = std::make_shared<Options>();
  options->tree = ".";
  std::string what = "Parts, default all:";
  std::vector<std::string> names;
  for (const DocumentPart& part : documentParts()) {
    what += fmt::format(" {} ({});", part.name, part.what);
    names.push_back(part.name);
  }
  what.pop_back();
  CLI::App* command = app.add_subcommand(
      "docs", "Make the documents' numbers, tables and pictures again, from this program");
  command->add_option("PART", options->parts, what)->check(CLI::IsMember(names));
  command->add_option("--tree", options->tree, "The source tree (default: this folder)")
      ->check(CLI::ExistingDirectory);
  command->add_option(
      "--campaigns", options->campaigns,
      "Folder for campaigns, which go on where they were (default: TREE/campaigns/docs)");
  command->add_option("--throws", options->throws, "Of each strategy")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command->add_option("--study-throws", options->study_throws, "Of each case of a study")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command->callback([options, &exit_status] {
    if (!std::filesystem::exists(options->tree / "lcmtypes"))
      throw std::invalid_argument(fmt::format(
          "--tree {}: is no source tree of fastball, it has no lcmtypes/", options->tree.string()));
    options->tree = std::filesystem::absolute(options->tree);
    if (options->campaigns.empty())
      options->campaigns = options->tree / "campaigns/docs";
    for (const DocumentPart& part : documentParts()) {
      const auto& asked = options->parts;
      if (asked.empty() || std::find(asked.begin(), asked.end(), part.name) != asked.end()) {
        fmt::print("{}: {}\n", part.name, part.what);
        part.make(*options);
      }
    }
    exit_status = messaging::kExitDone;
  });
}

}  // namespace fastball::launch
