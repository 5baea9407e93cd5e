#pragma once

#include <yaml-cpp/yaml.h>

#include <Eigen/Core>
#include <set>
#include <string>

#include "config/strict_yaml.h"

namespace fastball::config {

/// "file:line: sentence", as an exception to throw.
ConfigError errorAt(const std::string& path, const YAML::Mark& mark, const std::string& sentence);

/// A node in the words of an error: "a map", "a list", "'text'", "nothing".
std::string kindOf(const YAML::Node& node);

/// A value as YAML reads it, unless it stands in quotes. @return false if it is none of that type
template <typename T>
bool convert(const YAML::Node& node, T* value) {
  return node.IsScalar() && node.Tag() != "!" && YAML::convert<T>::decode(node, *value);
}

/// A scalar as the number that it must be; the sentence says what is wrong with it, or is empty.
std::string readNumber(const YAML::Node& node, const Range& range, double* value);

/// What a Section reads from: one map of a YAML file, and the place of everything in it. All
/// members throw ConfigError.
struct YamlMap {
  std::string path;
  YAML::Node node;
  YAML::Mark mark;              ///< where the map begins
  std::set<std::string> known;  ///< keys that were asked for

  /// @param map of the file; each key must be a word and stand there once
  YamlMap(std::string file, const YAML::Node& map);

  ConfigError error(const YAML::Mark& at,
                    const std::string& key,
                    const std::string& sentence) const;
  /// An error in the value of a key. An empty value has no line of its own, so the key's is named.
  ConfigError fault(const YAML::Node& at,
                    const std::string& key,
                    const std::string& sentence) const;
  /// The key's place in the map. (YAML::Node's own look-up would add the key.)
  YAML::const_iterator find(const std::string& key) const;
  /// The node of a key that must be there; marks it as known.
  YAML::Node get(const std::string& key);
  /// Like get(), and looks through {value: ..., unit: ..., source: ...}.
  YAML::Node value(const std::string& key);
  /// The numbers of a list, of the wanted size unless that is -1. @param what in front of an error
  Eigen::VectorXd list(const YAML::Node& found,
                       const std::string& key,
                       const std::string& what,
                       int size,
                       const Range& range) const;
};

}  // namespace fastball::config
