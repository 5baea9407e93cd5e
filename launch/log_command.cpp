#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <fstream>
#include <iostream>
#include <memory>

#include "launch/commands.h"
#include "logger/log_edit.h"
#include "logger/log_export.h"
#include "logger/log_summary.h"
#include "messaging/process.h"

namespace fastball::launch {
namespace {

struct Options {
  std::vector<std::string> logs;
  std::string output;
  std::vector<std::string> types;
  logger::LogPart part;
  logger::ExportOptions table;
  double reversal_ms = 10;
};

messaging::TypeLibrary typeLibrary(const std::vector<std::string>& paths) {
  messaging::TypeLibrary types;
  for (const std::string& path : paths)
    types.load(path);
  return types;
}

int info(const Options& options) {
  const auto types = typeLibrary(options.types);
  for (const std::string& log : options.logs)
    std::cout << logger::summaryText(logger::summarise(log, types));
  return messaging::kExitDone;
}

int check(const Options& options) {
  const auto types = typeLibrary(options.types);
  bool sound = true;
  for (const std::string& log : options.logs) {
    const auto summary = logger::summarise(log, types);
    const auto faults = summary.faults(static_cast<int64_t>(1e3 * options.reversal_ms));
    sound = sound && faults.empty();
    std::cout << fmt::format("{}: {} messages on {} channels{}\n", log, summary.messages,
                             summary.channels.size(), faults.empty() ? ", nothing wrong" : "");
    for (const std::string& fault : faults)
      std::cout << "  " << fault << '\n';
  }
  return sound ? messaging::kExitDone : messaging::kExitFailed;
}

int copied(const Options& options, const logger::CopyResult& result) {
  std::cout << fmt::format("wrote {} messages to {}", result.messages, options.output);
  if (result.damages > 0)
    std::cout << fmt::format("; {} bytes in {} places were no record", result.damaged_bytes,
                             result.damages);
  std::cout << '\n';
  return messaging::kExitDone;
}

int cut(const Options& options) {
  return copied(options, logger::copyLog(options.logs.at(0), options.output, options.part));
}

int merge(const Options& options) {
  return copied(options, logger::mergeLogs(options.logs, options.output));
}

int exportTable(const Options& options) {
  const auto types = typeLibrary(options.types);
  std::ofstream file;
  if (!options.output.empty()) {
    file.open(options.output);
    if (!file)
      throw std::invalid_argument(fmt::format("cannot write '{}'", options.output));
  }
  std::ostream& csv = options.output.empty() ? std::cout : file;
  const auto result = logger::exportCsv(options.logs.at(0), options.table, types, csv);
  if (!csv.flush())
    throw std::runtime_error(fmt::format("cannot write all of '{}'", options.output));
  if (result.undecodable > 0)
    std::cerr << fmt::format("{} messages on {} do not decode and are not in the table\n",
                             result.undecodable, options.table.channel);
  return messaging::kExitDone;
}

/// What the subcommands of `fastball log` share: one or several logs, and a function that does it.
struct LogCommand {
  CLI::App& group;
  std::shared_ptr<Options> options;
  int& exit_status;

  CLI::App* add(const char* name,
                const char* description,
                bool several,
                int (*act)(const Options&)) const {
    CLI::App* command = group.add_subcommand(name, description);
    auto* logs = command->add_option("LOG", options->logs, "LCM log file")->required();
    if (!several)
      logs->expected(1);
    command->callback([own = options, act, &status = exit_status] { status = act(*own); });
    return command;
  }
  void addOutput(CLI::App* command) const {
    command->add_option("-o,--output", options->output, "Log to write; must not exist yet")
        ->required();
  }
  void addTypes(CLI::App* command) const {
    command
        ->add_option("--types", options->types,
                     "Library of further message types (cmake/TypeLibrary.cmake)")
        ->option_text("LIB.so");
  }
};

void addTime(CLI::App* command, double& from, double& to) {
  command->add_option("--from", from, "Seconds from the first message")->capture_default_str();
  command->add_option("--to", to, "Seconds from the first message");
}

}  // namespace

void addLogCommand(CLI::App& app, int& exit_status) {
  CLI::App* group =
      app.add_subcommand("log", "Look into LCM logs, check, repair, cut, merge and export them");
  group->require_subcommand(1);
  const LogCommand log{*group, std::make_shared<Options>(), exit_status};
  Options& options = *log.options;
  log.addTypes(log.add("info", "What is in it: channels, types, rates, pauses", true, info));
  CLI::App* faults = log.add(
      "check",
      "Missing messages, times that go back, bytes that are no record, messages that do not "
      "decode; exit status 1 if there are any",
      true, check);
  log.addTypes(faults);
  faults
      ->add_option("--reversal-ms", options.reversal_ms,
                   "Receive times that go back by no more than this are no fault")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  log.addOutput(log.add("repair", "Copy every whole record, past any damage", false, cut));
  CLI::App* part = log.add("cut", "Copy a part", false, cut);
  log.addOutput(part);
  addTime(part, options.part.from, options.part.to);
  part->add_option("--channel", options.part.channels, "Only channels that match this")
      ->option_text("REGEX");
  part->add_option("--exclude", options.part.excluded, "No channel that matches this")
      ->option_text("REGEX");
  log.addOutput(log.add("merge", "Merge logs by receive time", true, merge));
  CLI::App* table =
      log.add("export", "The messages of a channel as a table (CSV)", false, exportTable);
  table->add_option("--channel", options.table.channel, "Channel")->required();
  table
      ->add_option("--field", options.table.fields,
                   "Value (q[0]) or array (q), again for more; default: all")
      ->expected(1)
      ->take_all();
  addTime(table, options.table.from, options.table.to);
  table->add_option("-o,--output", options.output, "File to write; default: standard output");
  log.addTypes(table);
}

}  // namespace fastball::launch
