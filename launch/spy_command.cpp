#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "launch/commands.h"
#include "launch/spy/spy_loop.h"
#include "launch/spy/stock_spy.h"
#include "launch/spy/terminal_view.h"
#include "messaging/lcm_endpoint.h"
#include "messaging/process.h"

namespace fastball::launch {
namespace {

constexpr double kTerminalRate = 10;
constexpr double kPrintRate = 1;

struct Options {
  SpyOptions spy;
  std::vector<std::string> types;
  double rate = 0;  ///< [Hz], 0: by the kind of output
  bool json = false;
  bool gui = false;
};

void listen(Options options) {
  messaging::TypeLibrary types;
  for (const std::string& path : options.types)
    types.load(path);
  const double terminal_s = 1 / (options.rate > 0 ? options.rate : kTerminalRate);
  const auto title = fmt::format("fastball spy  {}", options.spy.lcm_url);
  std::unique_ptr<SpyOutput> output;
  if (options.json)
    output = std::make_unique<JsonOutput>();
  else
    output = TerminalView::open(title, terminal_s);
  const bool on_terminal = output != nullptr && !options.json;
  if (!output)
    output = std::make_unique<TableOutput>();
  options.spy.interval_s =
      on_terminal ? terminal_s : 1 / (options.rate > 0 ? options.rate : kPrintRate);
  spy(options.spy, types, *output);
}

}  // namespace

void addSpyCommand(CLI::App& app, int& exit_status) {
  auto options = std::make_shared<Options>();
  options->spy.lcm_url = messaging::defaultLcmUrl();
  CLI::App* command = app.add_subcommand(
      "spy",
      "Show what is said on the network: channels, types, rates, losses, decoded messages; on a "
      "terminal live with plots, else a table once an interval");
  command->add_option("--lcm-url", options->spy.lcm_url, "LCM network")->capture_default_str();
  command->add_option("--channel", options->spy.channel, "Only channels that match this")
      ->option_text("REGEX");
  command
      ->add_option("--types", options->types,
                   "Library of further message types (cmake/TypeLibrary.cmake)")
      ->option_text("LIB.so");
  auto* json = command->add_flag("--json", options->json,
                                 "One JSON object a line for each channel, once an interval");
  command
      ->add_option("--duration", options->spy.duration_s,
                   "Seconds, then it ends; default: when it is told to")
      ->check(CLI::PositiveNumber);
  command
      ->add_option(
          "--rate", options->rate,
          "Intervals a second, and samples of the plots; default: 10 on a terminal, else 1")
      ->check(CLI::Range(0.01, 100.0));
  command
      ->add_flag("--gui", options->gui,
                 "Start LCM's own lcm-spy with the types of this project; needs Java and a display")
      ->excludes(json);
  command->footer(
      "Keys: up, down, j, k choose; Enter shows the members of a channel's newest message, and the "
      "one chosen as a plot; q or Esc goes back and quits.");
  command->callback([options, &exit_status] {
    if (options->gui)
      runStockSpy(options->spy.lcm_url);
    listen(*options);
    exit_status = messaging::kExitDone;
  });
}

}  // namespace fastball::launch
