#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <filesystem>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <thread>

#include "config/experiment.h"
#include "launch/atlas_setup.h"
#include "launch/campaign/cases.h"
#include "launch/campaign/engine.h"
#include "launch/campaign/part.h"
#include "launch/campaign/summary.h"
#include "launch/commands.h"
#include "launch/progress.h"
#include "launch/results.h"
#include "launch/run_config.h"
#include "launch/run_setup.h"
#include "messaging/clock.h"
#include "messaging/process.h"
#include "messaging/stop_signals.h"
#include "messaging/version.h"
#include "planner/atlas_file.h"
#include "planner/config.h"

namespace fastball::launch {
namespace {

namespace fs = std::filesystem;

struct Options {
  Campaign campaign;
  StudyRequest study;
  std::string folder, json, csv;
  int jobs = 1;
  std::string engine = "local";
  SlurmOptions slurm;
};

constexpr int kMostThrows = 1000000;
constexpr int kDefaultParts = 16;
constexpr int64_t kCountIntervalUs = 1000000;

std::string timeLeft(double seconds) {
  const auto s = static_cast<long>(seconds);
  return s >= 3600 ? fmt::format("{} h {:02} min", s / 3600, s / 60 % 60)
                   : fmt::format("{} min {:02} s", s / 60, s % 60);
}

/// "[#####.....] 2000 of 4000 throws, 3 min 20 s left: paper 40.1 %, robust 98.9 %"
std::string progressText(const Campaign& campaign,
                         const std::map<Unit, UnitResult>& record,
                         int throws_before,
                         double seconds) {
  const int all = campaign.throws * static_cast<int>(campaign.cases.size());
  int done = 0;
  for (const auto& [unit, result] : record)
    done += static_cast<int>(result.throws.size());
  const int made = done - throws_before;
  constexpr int kWidth = 20;
  std::string text = fmt::format("[{:.<{}}] {} of {} throws",
                                 std::string(static_cast<std::size_t>(kWidth * done / all), '#'),
                                 kWidth, done, all);
  if (made > 0)
    text += fmt::format(", {} left", timeLeft(seconds / made * (all - done)));
  for (std::size_t i = 0; i < campaign.cases.size() && i < 4; ++i)
    text += fmt::format("{} {} {:.1f} %", i == 0 ? ":" : ",", campaign.cases[i].name,
                        100 * summarise(record, static_cast<int>(i)).hits.value());
  return text;
}

int throwsIn(const std::map<Unit, UnitResult>& record) {
  int count = 0;
  for (const auto& [unit, result] : record)
    count += static_cast<int>(result.throws.size());
  return count;
}

/// Works until nothing is left to do or a signal comes. @return throws per minute; 0: there was nothing to do.
double work(const Options& options, const Campaign& campaign, Progress& progress) {
  const std::string todo = writeTodo(options.folder, campaign);
  if (todo.empty())
    return 0;
  const messaging::StopSignals signals;
  const messaging::SystemClock clock;
  const int before = throwsIn(readRecord(options.folder));
  const int64_t begun_us = clock.monotonicUs();
  int64_t next_us = begun_us;
  const auto seconds = [&] { return 1e-6 * static_cast<double>(clock.monotonicUs() - begun_us); };
  const auto watch = [&] {
    if (clock.monotonicUs() >= next_us) {
      progress.status(progressText(campaign, readRecord(options.folder), before, seconds()),
                      clock.monotonicUs());
      next_us = clock.monotonicUs() + kCountIntervalUs;
    }
    return !signals.received();
  };
  const std::vector<std::string> faults =
      options.engine == "slurm"
          ? workWithSlurm(options.folder, todo, options.slurm, watch,
                          [&](const std::string& text) { progress.line(text); })
          : workLocally(options.folder, todo, options.jobs, watch);
  if (signals.received())
    throw std::runtime_error(fmt::format(
        "interrupted; the same command with --folder {} goes on from here", options.folder));
  if (!faults.empty())
    throw std::runtime_error(faults.front());
  return 60 * (throwsIn(readRecord(options.folder)) - before) / seconds();
}

void writeFiles(const Options& options,
                const Campaign& campaign,
                const std::map<Unit, UnitResult>& record,
                double throws_per_minute) {
  const nlohmann::json object = campaignJson(campaign, record, throws_per_minute);
  writeJson(object, (fs::path(options.folder) / "summary.json").string());
  writeThrowsCsv(campaign, record, (fs::path(options.folder) / "throws.csv").string());
  if (!options.json.empty())
    writeJson(object, options.json);
  if (!options.csv.empty())
    writeThrowsCsv(campaign, record, options.csv);
}

std::string workersText(const Options& options) {
  if (options.engine == "slurm")
    return "by Slurm";
  return fmt::format("{} job{}", options.jobs, options.jobs == 1 ? "" : "s");
}

std::string defaultUncertainty() {
  return (fs::path(config::defaultExperimentPath()).parent_path() / "uncertainty" / "paper.yaml")
      .string();
}

int conduct(Options options) {
  Progress progress;
  StudyRequest& study = options.study;
  study.config = fs::absolute(config::experimentPath(study.config)).lexically_normal().string();
  study.uncertainty =
      fs::absolute(study.uncertainty.empty() ? defaultUncertainty() : study.uncertainty)
          .lexically_normal()
          .string();
  if (options.folder.empty())
    options.folder = fmt::format("campaigns/{}-seed{}-{}", study.study, options.campaign.seed,
                                 options.campaign.throws);
  for (const std::string& path : {options.json, options.csv}) {
    if (!path.empty())
      requireWritable("--json or --csv", path);
  }
  Campaign campaign = options.campaign;
  campaign.version = messaging::version();
  study.seed = campaign.seed;
  campaign.cases = casesOf(study, options.folder);
  for (const Case& one : campaign.cases) {
    RunOptions check;
    check.strategy = one.strategy;
    check.config = one.config;
    check.uncertainty = one.uncertainty;
    check.no_network = true;
    prepareRun(check);
    if (one.config == campaign.cases.front().config && &one != &campaign.cases.front())
      continue;
    if (study.study != "speed")
      ensureAtlas(planner::loadConfig(one.config), planner::atlasFolder(), false, progress);
  }
  beginCampaign(options.folder, campaign);
  progress.line(fmt::format("fastball {}: {} throws of {} case{}, seed {}, {}, in {}",
                            campaign.version, campaign.throws, campaign.cases.size(),
                            campaign.cases.size() == 1 ? "" : "s", campaign.seed,
                            workersText(options), options.folder));
  const double throws_per_minute = work(options, campaign, progress);
  const std::map<Unit, UnitResult> record = readRecord(options.folder);
  writeFiles(options, campaign, record, throws_per_minute);
  progress.line(campaignTable(campaign, record));
  if (throws_per_minute > 0)
    progress.line(fmt::format("{:.0f} throws a minute", throws_per_minute));
  return messaging::kExitDone;
}

void addPartCommand(CLI::App& app, int& exit_status) {
  struct Part {
    std::string folder, todo;
    int part = 0, parts = 1;
  };
  auto options = std::make_shared<Part>();
  CLI::App* command =
      app.add_subcommand("campaign-part", "Makes a share of a campaign's throws")->group("");
  command->add_option("FOLDER", options->folder)->required();
  command->add_option("--todo", options->todo)->required();
  command->add_option("--part", options->part)->required();
  command->add_option("--parts", options->parts)->required()->check(CLI::PositiveNumber);
  command->callback([options, &exit_status] {
    const bool done = runPart(options->folder, options->todo, options->part, options->parts);
    exit_status = done ? messaging::kExitDone : messaging::kExitFailed;
  });
}

}  // namespace

void addCampaignCommand(CLI::App& app, int& exit_status) {
  addPartCommand(app, exit_status);
  CLI::App* command = app.add_subcommand(
      "campaign", "Makes many throws with errors, without a network, and counts the hits");
  auto options = std::make_shared<Options>();
  Campaign& campaign = options->campaign;
  StudyRequest& study = options->study;
  campaign.throws = 200;
  campaign.set_up_throws = 10;
  study.study = "none";
  study.strategies = kStrategies;
  options->jobs = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  options->slurm.parts = kDefaultParts;
  command->add_option("--throws", campaign.throws, "Of each strategy (and case of a study)")
      ->check(CLI::Range(1, kMostThrows))
      ->capture_default_str();
  command
      ->add_option("--set-up-throws", campaign.set_up_throws,
                   "Throws in a set-up: its fixed errors are the same for all of them")
      ->check(CLI::Range(1, 10000))
      ->capture_default_str();
  command
      ->add_option("--seed", campaign.seed,
                   "Set-up i = 0, 1, ... throws as 'fastball run --seed (seed + i)' does")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  command->add_option("--strategy", study.strategies, "One or several, with commas; default: all")
      ->delimiter(',')
      ->check(CLI::IsMember(kStrategies))
      ->allow_extra_args(false);
  command->add_option("--study", study.study, "What is varied beside the strategy")
      ->check(CLI::IsMember(studyNames()))
      ->capture_default_str();
  command->add_option("--config", study.config,
                      "Experiment file (default: config/experiment.yaml)");
  command->add_option("--arm", study.arm, "Profile of the arm in place of the experiment's")
      ->check(CLI::IsMember({"wam4-48v", "wam4-90v"}));
  command
      ->add_option("--uncertainty", study.uncertainty,
                   "File of errors (default: config/uncertainty/paper.yaml)")
      ->check(CLI::ExistingFile);
  command->add_flag("--images", campaign.images,
                    "With cameras and tracker; else a light curtain in the ring measures");
  command->add_option("--jobs", options->jobs, "Processes at work at once; default: one each core")
      ->check(CLI::Range(1, 1024));
  command
      ->add_option("--engine", options->engine,
                   "Who works: this machine's processes, or an array job of Slurm")
      ->check(CLI::IsMember({"local", "slurm"}))
      ->capture_default_str();
  command->add_option("--parts", options->slurm.parts, "Parts of Slurm's job, a core each")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  command->add_option("--sbatch-args", options->slurm.sbatch_arguments,
                      "More words for sbatch, such as \"--partition=short --time=1:00:00\"");
  command->add_option("--folder", options->folder,
                      "For everything the campaign leaves; one that was interrupted goes on there "
                      "(default: campaigns/...)");
  command->add_option("--json", options->json, "File for the results as one JSON object");
  command->add_option("--csv", options->csv, "File for every throw, one a line");
  command->callback([options, &exit_status] { exit_status = conduct(*options); });
}

}  // namespace fastball::launch
