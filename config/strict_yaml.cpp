#include "config/strict_yaml.h"

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>

namespace fastball::config {

namespace {

namespace fs = std::filesystem;

/// "file:line: sentence"; YAML's marks count lines from 0, and have -1 where there is no line.
ConfigError errorAt(const std::string& path, const YAML::Mark& mark, const std::string& sentence) {
  return ConfigError(fmt::format("{}:{}: {}", path, std::max(mark.line, 0) + 1, sentence));
}

std::string kind(const YAML::Node& node) {
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

/// A number as YAML reads it, unless it stands in quotes; nothing if it is none.
template <typename T>
bool convert(const YAML::Node& node, T* value) {
  return node.IsScalar() && node.Tag() != "!" && YAML::convert<T>::decode(node, *value);
}

/// A scalar as the number that it must be; the sentence says what is wrong with it, or is empty.
std::string readNumber(const YAML::Node& node, const Range& range, double* value) {
  if (!convert(node, value)) {
    return fmt::format("must be a number, not {}", kind(node));
  }
  if (!std::isfinite(*value)) {
    return fmt::format("is {}, must be a finite number", *value);
  }
  if (*value < range.low || *value > range.high) {
    return fmt::format("is {}, {}", *value, rangeSentence(range));
  }
  return "";
}

}  // namespace

struct Section::Impl {
  std::string path;
  YAML::Node node;
  YAML::Mark mark;  ///< where the map begins
  std::set<std::string> known = {};

  Impl(std::string file, const YAML::Node& map)
      : path(std::move(file)), node(map), mark(map.Mark()) {
    std::set<std::string> seen;
    for (const auto& entry : node) {
      if (!entry.first.IsScalar()) {
        throw errorAt(path, entry.first.Mark(), "a key must be a word, not " + kind(entry.first));
      }
      const std::string key = entry.first.Scalar();
      if (!seen.insert(key).second) {
        throw errorAt(path, entry.first.Mark(), fmt::format("key '{}': stands here twice", key));
      }
    }
  }

  ConfigError error(const YAML::Mark& at,
                    const std::string& key,
                    const std::string& sentence) const {
    return errorAt(path, at, fmt::format("key '{}': {}", key, sentence));
  }

  /// The key's place in the map. (YAML::Node's own look-up would add the key.)
  YAML::const_iterator find(const std::string& key) const {
    return std::find_if(node.begin(), node.end(),
                        [&key](const auto& entry) { return entry.first.Scalar() == key; });
  }

  /// An error in the value of a key. An empty value has no line of its own, so the key's is named.
  ConfigError fault(const YAML::Node& at,
                    const std::string& key,
                    const std::string& sentence) const {
    const auto entry = find(key);
    const bool empty = at.IsNull() && entry != node.end();
    return error(empty ? entry->first.Mark() : at.Mark(), key, sentence);
  }

  /// The node of a key that must be there; marks it as known.
  YAML::Node get(const std::string& key) {
    known.insert(key);
    const auto entry = find(key);
    if (entry == node.end()) {
      throw error(mark, key, "is missing");
    }
    return entry->second;
  }

  /// Like get(), and looks through {value: ..., unit: ..., source: ...}.
  YAML::Node value(const std::string& key) {
    YAML::Node found = get(key);
    if (!found.IsMap()) {
      return found;
    }
    Impl annotated(path, found);
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

  /// The numbers of a list, of the wanted size unless that is -1.
  Eigen::VectorXd list(const YAML::Node& found,
                       const std::string& key,
                       const std::string& what,
                       int size,
                       const Range& range) const {
    if (!found.IsSequence() || (size >= 0 && static_cast<int>(found.size()) != size)) {
      const std::string wanted = size < 0 ? "" : fmt::format("{} ", size);
      const std::string given =
          found.IsSequence() ? fmt::format("{} values", found.size()) : kind(found);
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
};

Section Section::fromFile(const std::string& path) {
  if (!fs::exists(path) || fs::is_directory(path)) {
    throw ConfigError(path + ": there is no such file");
  }
  std::vector<YAML::Node> documents;
  try {
    documents = YAML::LoadAllFromFile(path);
  } catch (const YAML::ParserException& exception) {
    throw errorAt(path, exception.mark, "cannot be read as YAML, " + exception.msg);
  } catch (const YAML::Exception&) {
    throw ConfigError(path + ": cannot be opened");
  }
  if (documents.size() != 1 || !documents.front().IsMap()) {
    throw ConfigError(path + ":1: the file must be one map of keys");
  }
  Section section;
  section.impl_ = std::make_shared<Impl>(path, documents.front());
  return section;
}

bool Section::has(const std::string& key) const {
  return impl_->find(key) != impl_->node.end();
}

double Section::number(const std::string& key, Range range) {
  const YAML::Node node = impl_->value(key);
  double value = 0;
  const std::string wrong = readNumber(node, range, &value);
  if (!wrong.empty()) {
    throw impl_->fault(node, key, wrong);
  }
  return value;
}

int Section::integer(const std::string& key, int low, int high) {
  const YAML::Node node = impl_->value(key);
  int value = 0;
  if (!convert(node, &value)) {
    throw impl_->error(
        node.Mark(), key,
        fmt::format("must be a whole number in [{}, {}], not {}", low, high, kind(node)));
  }
  if (value < low || value > high) {
    throw impl_->fault(node, key, fmt::format("is {}, must be in [{}, {}]", value, low, high));
  }
  return value;
}

bool Section::boolean(const std::string& key) {
  const YAML::Node node = impl_->value(key);
  bool value = false;
  if (!convert(node, &value)) {
    throw impl_->fault(node, key, "must be true or false, not " + kind(node));
  }
  return value;
}

std::string Section::text(const std::string& key) {
  const YAML::Node node = impl_->value(key);
  if (!node.IsScalar() || node.Scalar().empty()) {
    throw impl_->fault(node, key, "must be a word, not " + kind(node));
  }
  return node.Scalar();
}

std::vector<std::string> Section::texts(const std::string& key) {
  const YAML::Node node = impl_->value(key);
  if (!node.IsSequence()) {
    throw impl_->fault(node, key, "must be a list of words, not " + kind(node));
  }
  std::vector<std::string> words;
  for (const YAML::Node& item : node) {
    if (!item.IsScalar() || item.Scalar().empty()) {
      throw impl_->fault(item, key, "must be a list of words, and has " + kind(item));
    }
    words.push_back(item.Scalar());
  }
  return words;
}

std::string Section::choice(const std::string& key, const std::vector<std::string>& allowed) {
  std::string word = text(key);
  for (const std::string& candidate : allowed) {
    if (word == candidate) {
      return word;
    }
  }
  throw error(key, fmt::format("is '{}', must be one of: {}", word, fmt::join(allowed, ", ")));
}

Eigen::VectorXd Section::vector(const std::string& key, int size, Range range) {
  return impl_->list(impl_->value(key), key, "", size, range);
}

Eigen::MatrixXd Section::matrix(const std::string& key, int rows, int cols, Range range) {
  const YAML::Node node = impl_->value(key);
  if (!node.IsSequence() || static_cast<int>(node.size()) != rows) {
    throw impl_->fault(node, key, fmt::format("must be a list of {} rows", rows));
  }
  Eigen::MatrixXd matrix(rows, cols);
  for (int row = 0; row < rows; ++row) {
    matrix.row(row) =
        impl_->list(node[row], key, fmt::format("row {}: ", row + 1), cols, range).transpose();
  }
  return matrix;
}

Section Section::section(const std::string& key) {
  const YAML::Node node = impl_->get(key);
  if (!node.IsMap()) {
    throw error(key, "must be a map, not " + kind(node));
  }
  Section section;
  section.impl_ = std::make_shared<Impl>(impl_->path, node);
  return section;
}

std::vector<Section> Section::sections(const std::string& key) {
  const YAML::Node node = impl_->get(key);
  if (!node.IsSequence()) {
    throw error(key, "must be a list of maps, not " + kind(node));
  }
  std::vector<Section> sections;
  for (const YAML::Node& item : node) {
    if (!item.IsMap()) {
      throw impl_->fault(item, key, "must be a list of maps, and has " + kind(item));
    }
    Section section;
    section.impl_ = std::make_shared<Impl>(impl_->path, item);
    sections.push_back(section);
  }
  return sections;
}

Section Section::file(const std::string& key) {
  const fs::path named = fs::path(impl_->path).parent_path() / text(key);
  if (!fs::is_regular_file(named)) {
    throw error(key, fmt::format("names the file {}, which does not exist", named.string()));
  }
  return fromFile(named.string());
}

void Section::ignore(const std::string& key) {
  impl_->known.insert(key);
}

void Section::finish() const {
  for (const auto& entry : impl_->node) {
    if (impl_->known.count(entry.first.Scalar()) == 0) {
      throw impl_->error(entry.first.Mark(), entry.first.Scalar(), "is not known here");
    }
  }
}

ConfigError Section::error(const std::string& key, const std::string& sentence) const {
  const auto entry = impl_->find(key);
  return impl_->error(entry == impl_->node.end() ? impl_->mark : entry->first.Mark(), key,
                      sentence);
}

const std::string& Section::path() const {
  return impl_->path;
}

}  // namespace fastball::config
