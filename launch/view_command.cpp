#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <boost/process/child.hpp>
#include <boost/process/io.hpp>
#include <boost/process/search_path.hpp>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <optional>

#include "config/experiment.h"
#include "launch/commands.h"
#include "launch/recorded_configuration.h"
#include "launch/view/view_server.h"
#include "messaging/process.h"
#include "messaging/stop_signals.h"

namespace fastball::launch {
namespace {

struct Options {
  view::ViewOptions view;
  std::string config, key;
  bool no_throws = false;
  bool no_browser = false;
};

/// True if there is somebody before a screen of this machine.
bool onDesktop() {
  const auto set = [](const char* name) {
    const char* value = std::getenv(name);  // NOLINT(concurrency-mt-unsafe): no thread yet
    return value != nullptr && *value != '\0';
  };
  return isatty(STDOUT_FILENO) == 1 && (set("DISPLAY") || set("WAYLAND_DISPLAY"));
}

void openBrowser(const std::string& url) {
  namespace bp = boost::process;
  const auto opener = bp::search_path("xdg-open");
  if (opener.empty())
    return;
  std::error_code ignored;
  bp::child(opener.string(), url, bp::std_in<bp::null, bp::std_out> bp::null,
            bp::std_err > bp::null, ignored)
      .detach();
}

/// The experiment file of a log: named, else recorded with the log, else the default one. One that this version cannot read any
/// more does not keep the log from being shown.
void chooseConfiguration(Options& options, std::optional<RecordedConfiguration>& recorded) {
  options.view.config = config::experimentPath(options.config);
  if (options.view.log.empty() || !options.config.empty())
    return;
  recorded.emplace(options.view.log, "");
  if (!recorded->isRecorded())
    return;
  try {
    config::loadExperiment(recorded->experiment());
    options.view.config = recorded->experiment();
  } catch (const config::ConfigError& e) {
    options.view.remark = fmt::format(
        "The configuration recorded with the log is not one of this version ({}): arm, hand and "
        "limits are those of {}.",
        e.what(), options.view.config);
  }
}

int serve(Options options) {
  const messaging::StopSignals signals;
  const bool desktop = onDesktop() && !options.no_browser;
  std::optional<RecordedConfiguration> recorded;
  chooseConfiguration(options, recorded);
  options.view.page_folder = view::pageFolder();
  options.view.may_throw = !options.no_throws;
  options.view.run = {options.view.lcm_url, options.config, options.key};
  view::ViewServer server(options.view);
  fmt::print(
      "fastball view: {}\nshows {}; Ctrl-C ends it\n", server.url(),
      options.view.log.empty() ? "what is said on " + options.view.lcm_url : options.view.log);
  std::fflush(stdout);
  if (desktop)
    openBrowser(server.url());
  server.run([&signals] { return signals.received(); });
  return messaging::kExitDone;
}

}  // namespace

void addViewCommand(CLI::App& app, int& exit_status) {
  auto options = std::make_shared<Options>();
  options->view.lcm_url = messaging::defaultLcmUrl();
  CLI::App* command = app.add_subcommand(
      "view",
      "Show an experiment in a browser, live or from a log: arm, hand and ball in 3-D, cameras, "
      "plots, processes, landings; a click makes a throw");
  command->add_option("LOG", options->view.log,
                      "LCM log file; default: what is said on the network");
  command->add_option("--lcm-url", options->view.lcm_url, "LCM network")->capture_default_str();
  command->add_option("--port", options->view.port, "Of the page; 0: any that is free")
      ->capture_default_str();
  command
      ->add_option("--host", options->view.host,
                   "Address to serve on; with another than this machine's own, others can look on, "
                   "and no throws can be started from the page")
      ->capture_default_str();
  command->add_option("--config", options->config,
                      "Experiment file (default: that recorded with the log, else "
                      "config/experiment.yaml)");
  command->add_option("--key", options->key, "File of the key for throws started from the page")
      ->option_text("FILE");
  command->add_flag("--no-throws", options->no_throws, "No throws can be started from the page");
  command->add_flag("--no-browser", options->no_browser,
                    "Do not open the page in the desktop's browser");
  command->callback([options, &exit_status] { exit_status = serve(*options); });
}

}  // namespace fastball::launch
