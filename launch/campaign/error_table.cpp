#include "launch/campaign/error_table.h"

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <stdexcept>

namespace fastball::launch {
namespace {

/// "normal, sd 0.002": the distribution with the numbers of the file.
std::string distributionOf(const YAML::Node& error) {
  std::string text = "?";
  if (const YAML::Node sd = error["normal"])
    text = "normal, sd " + sd.as<std::string>();
  else if (const YAML::Node half = error["half_normal"])
    text = "half-normal, sd " + half.as<std::string>();
  else if (const YAML::Node even = error["uniform"])
    text = fmt::format("uniform, {} to {}", even[0].as<std::string>(), even[1].as<std::string>());
  else if (const YAML::Node factor = error["log_uniform"])
    text = fmt::format("log-uniform factor, {} to {}", factor[0].as<std::string>(),
                       factor[1].as<std::string>());
  if (error["times"])
    text += fmt::format(", times {}", error["times"].as<std::string>());
  return text;
}

}  // namespace

std::vector<ErrorLine> errorLines(const std::string& path) {
  std::vector<ErrorLine> lines;
  try {
    const YAML::Node file = YAML::LoadFile(path);
    for (const char* part : {"set_up", "throw"}) {
      for (const auto& entry : file[part]) {
        const YAML::Node& error = entry.second;
        lines.push_back({entry.first.as<std::string>(),
                         part == std::string("set_up") ? "set-up" : part, distributionOf(error),
                         error["unit"].as<std::string>("relative"),
                         error["reason"].as<std::string>("")});
      }
    }
  } catch (const YAML::Exception& e) {
    throw std::invalid_argument(fmt::format("{}: {}", path, e.what()));
  }
  return lines;
}

std::string errorTable(const std::string& path) {
  std::string table =
      "| error | drawn for each | distribution | unit | reason |\n"
      "| --- | --- | --- | --- | --- |\n";
  for (const ErrorLine& error : errorLines(path))
    table += fmt::format("| `{}` | {} | {} | {} | {} |\n", error.name, error.drawn_for,
                         error.distribution, error.unit, error.reason);
  return table;
}

}  // namespace fastball::launch
