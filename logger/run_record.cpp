#include "logger/run_record.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>

#include "messaging/heartbeat.h"

namespace fastball::logger {
namespace {

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

/// The record of a log; an empty object if there is none.
nlohmann::json readRecord(const std::string& log_path) {
  std::ifstream file(runRecordPath(log_path));
  auto json = file ? nlohmann::json::parse(file, nullptr, false) : nlohmann::json();
  return json.is_object() ? json : nlohmann::json::object();
}

std::string textOf(const nlohmann::json& object, const char* name) {
  const auto member = object.find(name);
  return member != object.end() && member->is_string() ? member->get<std::string>() : "";
}

int64_t numberOf(const nlohmann::json& object, const char* name, int64_t otherwise) {
  const auto member = object.find(name);
  return member != object.end() && member->is_number_integer() ? member->get<int64_t>() : otherwise;
}

/// All or nothing, so that a full disk cannot cost the record that is there. Channels and paths may be any bytes.
bool writeWhole(const std::string& path, const nlohmann::json& json) {
  const std::string unfinished = path + ".new";
  std::ofstream file(unfinished);
  file << json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) << '\n';
  file.close();
  std::error_code error;
  if (file)
    std::filesystem::rename(unfinished, path, error);
  else
    std::filesystem::remove(unfinished, error);
  return file && !error;
}

}  // namespace

std::string runRecordPath(const std::string& log_path) {
  return log_path + ".run.json";
}

void writeRunRecord(const std::string& log_path, const RunRecord& record, int64_t start_utime) {
  const nlohmann::json json = {{"version", record.version},
                               {"command_line", record.command_line},
                               {"seed", record.seed},
                               {"host", messaging::hostName()},
                               {"start_utime", start_utime},
                               {"config", record.config_path},
                               {"configuration", configurationTexts(record.config_path)}};
  if (!writeWhole(runRecordPath(log_path), json))
    throw std::invalid_argument(
        fmt::format("cannot write the record of the run '{}'", runRecordPath(log_path)));
}

std::optional<WrittenRunRecord> readRunRecord(const std::string& log_path) {
  const nlohmann::json json = readRecord(log_path);
  if (json.empty())
    return {};
  WrittenRunRecord record;
  record.version = textOf(json, "version");
  record.command_line = textOf(json, "command_line");
  record.config_path = textOf(json, "config");
  record.seed = numberOf(json, "seed", 0);
  record.host = textOf(json, "host");
  record.start_utime = numberOf(json, "start_utime", 0);
  const auto recording = json.find("recording");
  if (recording != json.end() && recording->is_object())
    record.messages = numberOf(*recording, "messages", -1);
  return record;
}

std::string restoreConfiguration(const std::string& log_path, const std::string& folder) {
  namespace fs = std::filesystem;
  const nlohmann::json json = readRecord(log_path);
  const std::string experiment = fs::path(textOf(json, "config")).filename().string();
  const auto found = json.find("configuration");
  if (experiment.empty() || found == json.end() || !found->is_object())
    return "";
  const nlohmann::json& texts = *found;
  const auto is_text = [](const nlohmann::json& text) { return text.is_string(); };
  if (!texts.contains(experiment) || !std::all_of(texts.begin(), texts.end(), is_text))
    return "";
  for (const auto& [name, text] : texts.items()) {
    const fs::path relative = fs::path(name).lexically_normal();
    if (relative.is_absolute() || relative.begin()->string() == "..")
      throw std::invalid_argument(
          fmt::format("'{}' names a configuration file '{}' outside its folder",
                      runRecordPath(log_path), name));
    const fs::path path = fs::path(folder) / relative;
    fs::create_directories(path.parent_path());
    std::ofstream file(path);
    if (!(file << text.get<std::string>()) || !file.flush())
      throw std::runtime_error(fmt::format("cannot write '{}'", path.string()));
  }
  return (fs::path(folder) / experiment).string();
}

void addRecordingToRunRecord(const std::string& log_path,
                             const Recorder& recorder,
                             int64_t missing) {
  nlohmann::json json = readRecord(log_path);
  if (json.empty())
    return;
  const auto status = recorder.status();
  auto& recording = json["recording"];
  recording = {{"files", status.files},
               {"messages", status.messages},
               {"bytes", status.bytes},
               {"missing", missing},
               {"dropped", nlohmann::json::object()}};
  for (const auto& [channel, dropped] : recorder.queue().dropped()) {
    recording["dropped"][channel] = {{"messages", dropped.messages},
                                     {"first_utime", dropped.first_utime},
                                     {"last_utime", dropped.last_utime}};
  }
  if (!writeWhole(runRecordPath(log_path), json))
    spdlog::error("cannot write the record of the run '{}'", runRecordPath(log_path));
}

}  // namespace fastball::logger
