#include "launch/campaign/record.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace fastball::launch {
namespace {

namespace fs = std::filesystem;
constexpr const char* kEnding = ".jsonl";

nlohmann::json toJson(const std::optional<Eigen::Vector2d>& v) {
  return v ? nlohmann::json{v->x(), v->y()} : nlohmann::json(nullptr);
}

std::optional<Eigen::Vector2d> vectorFrom(const nlohmann::json& value) {
  if (value.is_null())
    return {};
  return Eigen::Vector2d(value.at(0).get<double>(), value.at(1).get<double>());
}

nlohmann::json toJson(const UnitResult& result) {
  nlohmann::json throws = nlohmann::json::array();
  for (const ThrowOutcome& one : result.throws)
    throws.push_back({{"hit", one.hit},
                      {"clean", one.clean},
                      {"landing", toJson(one.landing)},
                      {"measured", toJson(one.measured)},
                      {"release_speed", one.release_speed},
                      {"note", one.note}});
  return {{"case", result.unit.case_index},
          {"set_up", result.unit.set_up},
          {"throws", throws},
          {"wall_s", result.wall_s}};
}

UnitResult resultFrom(const nlohmann::json& object) {
  UnitResult result;
  for (const nlohmann::json& one : object.at("throws"))
    result.throws.push_back({one.at("hit"), one.at("clean"), vectorFrom(one.at("landing")),
                             vectorFrom(one.at("measured")), one.at("release_speed"),
                             one.at("note")});
  result.unit = {object.at("case"), object.at("set_up"), static_cast<int>(result.throws.size())};
  result.wall_s = object.at("wall_s");
  return result;
}

void readFile(const fs::path& path, std::map<Unit, UnitResult>& record) {
  std::ifstream file(path);
  std::string line;
  for (int number = 1; std::getline(file, line); ++number) {
    if (file.eof())
      return;  // no end of line: cut short
    if (line.empty())
      continue;  // where one cut short was closed
    try {
      UnitResult result = resultFrom(nlohmann::json::parse(line));
      record.emplace(result.unit, std::move(result));
    } catch (const nlohmann::json::exception& e) {
      // What a kill cut short, and a later process closed with an end of line.
      if (!nlohmann::json::accept(line))
        continue;
      throw std::runtime_error(
          fmt::format("{}:{}: is no result of a throw: {}", path.string(), number, e.what()));
    }
  }
}

}  // namespace

std::map<Unit, UnitResult> readRecord(const std::string& folder) {
  std::map<Unit, UnitResult> record;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() == kEnding)
      readFile(entry.path(), record);
  }
  return record;
}

RecordFile::RecordFile(const std::string& folder, const std::string& name)
    : path_((fs::path(folder) / (name + kEnding)).string()),
      file_(open(path_.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0644)) {
  if (file_ < 0 || write(file_, "\n", 1) != 1)
    throw std::runtime_error(fmt::format("{}: {}", path_, std::strerror(errno)));
}

RecordFile::~RecordFile() {
  if (file_ >= 0)
    close(file_);
}

void RecordFile::add(const UnitResult& result) {
  const std::string line = toJson(result).dump() + '\n';
  if (write(file_, line.data(), line.size()) != static_cast<ssize_t>(line.size()))
    throw std::runtime_error(fmt::format("{}: {}", path_, std::strerror(errno)));
}

}  // namespace fastball::launch
