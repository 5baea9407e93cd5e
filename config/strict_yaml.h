#pragma once

#include <Eigen/Core>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace fastball::config {

/// A bad configuration file. what() is one sentence: file, line, key, value, limit.
class ConfigError : public std::invalid_argument {
 public:
  using std::invalid_argument::invalid_argument;
};

/// Closed range of allowed values.
struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
};
inline constexpr Range kPositive{std::numeric_limits<double>::min(),
                                 std::numeric_limits<double>::infinity()};
inline constexpr Range kNonNegative{0.0, std::numeric_limits<double>::infinity()};

/// One map of a YAML file, read strictly: every key that the file gives must be asked for before
/// finish(), every number is finite and inside its range. A value may be given plainly or as
/// {value: ..., unit: ..., source: ...}; unit and source are for the reader. All functions throw
/// ConfigError.
class Section {
 public:
  /// Reads the file; its top level must be a map.
  static Section fromFile(const std::string& path);

  bool has(const std::string& key) const;
  double number(const std::string& key, Range range = {});
  int integer(const std::string& key, int low, int high);
  bool boolean(const std::string& key);
  std::string text(const std::string& key);
  /// A list of words.
  std::vector<std::string> texts(const std::string& key);
  /// One of `allowed`.
  std::string choice(const std::string& key, const std::vector<std::string>& allowed);
  /// `size` numbers; size -1: any number of them.
  Eigen::VectorXd vector(const std::string& key, int size, Range range = {});
  /// A list of lists, row by row.
  Eigen::MatrixXd matrix(const std::string& key, int rows, int cols, Range range = {});
  Section section(const std::string& key);
  /// A list of maps.
  std::vector<Section> sections(const std::string& key);
  /// The file that `key` names, relative to the folder of this file, as a Section.
  Section file(const std::string& key);
  /// Marks `key` as known and unread (for keys that only a human reads, such as `source`).
  void ignore(const std::string& key);
  /// @throw ConfigError naming the first key that nobody asked for.
  void finish() const;
  /// "file:line: key 'key': " + sentence, as an exception to throw.
  ConfigError error(const std::string& key, const std::string& sentence) const;
  const std::string& path() const;

 private:
  struct Impl;
  std::shared_ptr<Impl> impl_;
};

}  // namespace fastball::config
