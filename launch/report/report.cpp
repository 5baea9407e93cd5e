#include "launch/report/report.h"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "launch/campaign/campaign_drawing.h"
#include "launch/recorded_configuration.h"
#include "launch/report/run_page.h"

namespace fastball::launch {

ReportOutcome writeReport(const std::string& log_path,
                          const std::string& config,
                          const std::string& folder) {
  const LoggedRun run = readRun(log_path);
  const RecordedConfiguration configuration(log_path, config);
  const config::Experiment experiment = config::loadExperiment(configuration.experiment());
  std::filesystem::create_directories(folder);

  RunPageParts parts;
  parts.experiment = configuration.isRecorded()
                         ? run.record->config_path + ", as recorded beside the log"
                         : configuration.experiment() + (config.empty() ? ", the default" : "");
  parts.missing = missingOf(run);
  if (run.summary)
    parts.pictures = drawAll(picturesOf(run, experiment), folder);
  const auto failures = failuresOf(parts.pictures);
  parts.missing.faults.insert(parts.missing.faults.end(), failures.begin(), failures.end());
  writeText(throwsCsv(run, experiment), folder + "/throws.csv");
  writeText(runPage(run, experiment, parts), folder + "/index.html");
  return {run.summary.has_value(), parts.missing.faults};
}

}  // namespace fastball::launch
