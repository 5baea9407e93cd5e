#include "logger/run_record.h"

#include <fmt/format.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>

namespace fastball::logger {
namespace {

std::string hostName() {
  char name[256] = "";
  gethostname(name, sizeof name - 1);
  return name;
}

std::string readText(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::stringstream text;
  if (!file || !(text << file.rdbuf()))
    throw std::invalid_argument(
        fmt::format("cannot read the configuration file '{}'", path.string()));
  return text.str();
}

nlohmann::json configurationTexts(const std::filesystem::path& config_path) {
  nlohmann::json texts = nlohmann::json::object();
  if (config_path.empty())
    return texts;
  texts[config_path.filename().string()] = readText(config_path);
  const auto folder = std::filesystem::absolute(config_path).parent_path();
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file() && entry.path().extension() == ".yaml")
      texts[entry.path().lexically_relative(folder).string()] = readText(entry.path());
  }
  return texts;
}

}  // namespace

std::string runRecordPath(const std::string& log_path) {
  return log_path + ".run.json";
}

void writeRunRecord(const std::string& log_path, const RunRecord& record, int64_t start_utime) {
  const nlohmann::json json = {{"version", record.version},
                               {"command_line", record.command_line},
                               {"seed", record.seed},
                               {"host", hostName()},
                               {"start_utime", start_utime},
                               {"config", record.config_path},
                               {"configuration", configurationTexts(record.config_path)}};
  const std::string path = runRecordPath(log_path);
  std::ofstream file(path);
  if (!(file << json.dump(2) << '\n') || !file.flush())
    throw std::invalid_argument(fmt::format("cannot write the record of the run '{}'", path));
}

}  // namespace fastball::logger
