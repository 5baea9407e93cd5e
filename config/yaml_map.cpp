#include "config/yaml_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace fastball::config {
namespace {

std::string rangeSentence(const Range& range) {
  if (range.low == kPositive.low && range.high == kPositive.high) {
    return "must be positive";
  }
  if (range.low == kNonNegative.low && range.high == kNonNegative.high) {
    return "must not be negative";
  }
  if (std::isinf(range.high)) {
    return fmt::format("must be at least {}", range.low);
  }
  if (std::isinf(range.low)) {
    return fmt::format("must be at most {}", range.high);
  }
  return fmt::format("must be in [{}, {}]", range.low, range.high);
}

}  // namespace

ConfigError errorAt(const std::string& path, const YAML::Mark& mark, const std::string& sentence) {
  // YAML's marks count lines from 0, and have -1 where there is no line.
  return ConfigError(fmt::format("{}:{}: {}", path, std::max(mark.line, 0) + 1, sentence));
}

std::string kindOf(const YAML::Node& node) {
  switch (node.Type()) {
    case YAML::NodeType::Map:
      return "a map";
    case YAML::NodeType::Sequence:
      return "a list";
    case YAML::NodeType::Scalar:
      return fmt::format("'{}'", node.Scalar());
    default:
      return "nothing";
  }
}

std::string readNumber(const YAML::Node& node, const Range& range, double* value) {
  if (!convert(node, value)) {
    return fmt::format("must be a number, not {}", kindOf(node));
  }
  if (!std::isfinite(*value)) {
    return fmt::format("is {}, must be a finite number", *value);
  }
  if (*value < range.low || *value > range.high) {
    return fmt::format("is {}, {}", *value, rangeSentence(range));
  }
  return "";
}

YamlMap::YamlMap(std::string file, const YAML::Node& map)
    : path(std::move(file)), node(map), mark(map.Mark()) {
  std::set<std::string> seen;
  for (const auto& entry : node) {
    if (!entry.first.IsScalar()) {
      throw errorAt(path, entry.first.Mark(), "a key must be a word, not " + kindOf(entry.first));
    }
    const std::string key = entry.first.Scalar();
    if (!seen.insert(key).second) {
      throw errorAt(path, entry.first.Mark(), fmt::format("key '{}': stands here twice", key));
    }
  }
}

ConfigError YamlMap::error(const YAML::Mark& at,
                           const std::string& key,
                           const std::string& sentence) const {
  return errorAt(path, at, fmt::format("key '{}': {}", key, sentence));
}

ConfigError YamlMap::fault(const YAML::Node& at,
                           const std::string& key,
                           const std::string& sentence) const {
  const auto entry = find(key);
  const bool empty = at.IsNull() && entry != node.end();
  return error(empty ? entry->first.Mark() : at.Mark(), key, sentence);
}

YAML::const_iterator YamlMap::find(const std::string& key) const {
  return std::find_if(node.begin(), node.end(),
                      [&key](const auto& entry) { return entry.first.Scalar() == key; });
}

YAML::Node YamlMap::get(const std::string& key) {
  known.insert(key);
  const auto entry = find(key);
  if (entry == node.end()) {
    throw error(mark, key, "is missing");
  }
  return entry->second;
}

YAML::Node YamlMap::value(const std::string& key) {
  YAML::Node found = get(key);
  if (!found.IsMap()) {
    return found;
  }
  const YamlMap annotated(path, found);
  for (const auto& entry : found) {
    const std::string& inner = entry.first.Scalar();
    if (inner != "value" && inner != "unit" && inner != "source") {
      throw error(entry.first.Mark(), key,
                  fmt::format("has the unknown key '{}' (known: value, unit, source)", inner));
    }
  }
  if (annotated.find("value") == found.end()) {
    throw fault(found, key, "has no 'value'");
  }
  return annotated.find("value")->second;
}

Eigen::VectorXd YamlMap::list(const YAML::Node& found,
                              const std::string& key,
                              const std::string& what,
                              int size,
                              const Range& range) const {
  if (!found.IsSequence() || (size >= 0 && static_cast<int>(found.size()) != size)) {
    const std::string wanted = size < 0 ? "" : fmt::format("{} ", size);
    const std::string given =
        found.IsSequence() ? fmt::format("{} values", found.size()) : kindOf(found);
    throw fault(found, key,
                fmt::format("{}must be a list of {}numbers, not {}", what, wanted, given));
  }
  Eigen::VectorXd numbers(found.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    const std::string wrong = readNumber(found[i], range, &numbers[static_cast<Eigen::Index>(i)]);
    if (!wrong.empty()) {
      throw fault(found[i], key, fmt::format("{}number {} {}", what, i + 1, wrong));
    }
  }
  return numbers;
}

}  // namespace fastball::config
