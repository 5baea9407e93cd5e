#include "launch/recorded_configuration.h"

#include <fmt/format.h>
#include <unistd.h>

#include "config/experiment.h"
#include "logger/run_record.h"

namespace fastball::launch {

RecordedConfiguration::RecordedConfiguration(const std::string& log, const std::string& named)
    : folder_(std::filesystem::temp_directory_path() /
              fmt::format("fastball-configuration-{}", getpid())) {
  if (named.empty())
    experiment_ = logger::restoreConfiguration(log, folder_.string());
  is_recorded_ = !experiment_.empty();
  if (!is_recorded_)
    experiment_ = config::experimentPath(named);
}

RecordedConfiguration::~RecordedConfiguration() {
  std::error_code ignored;
  std::filesystem::remove_all(folder_, ignored);
}

}  // namespace fastball::launch
