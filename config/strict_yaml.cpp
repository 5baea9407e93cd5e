#include "config/strict_yaml.h"

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <filesystem>

#include "config/yaml_map.h"

namespace fastball::config {

namespace {

namespace fs = std::filesystem;

}  // namespace

struct Section::Impl : YamlMap {
  using YamlMap::YamlMap;
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
        fmt::format("must be a whole number in [{}, {}], not {}", low, high, kindOf(node)));
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
    throw impl_->fault(node, key, "must be true or false, not " + kindOf(node));
  }
  return value;
}

std::string Section::text(const std::string& key) {
  const YAML::Node node = impl_->value(key);
  if (!node.IsScalar() || node.Scalar().empty()) {
    throw impl_->fault(node, key, "must be a word, not " + kindOf(node));
  }
  return node.Scalar();
}

std::vector<std::string> Section::texts(const std::string& key) {
  const YAML::Node node = impl_->value(key);
  if (!node.IsSequence()) {
    throw impl_->fault(node, key, "must be a list of words, not " + kindOf(node));
  }
  std::vector<std::string> words;
  for (const YAML::Node& item : node) {
    if (!item.IsScalar() || item.Scalar().empty()) {
      throw impl_->fault(item, key, "must be a list of words, and has " + kindOf(item));
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
    throw error(key, "must be a map, not " + kindOf(node));
  }
  Section section;
  section.impl_ = std::make_shared<Impl>(impl_->path, node);
  return section;
}

std::vector<Section> Section::sections(const std::string& key) {
  const YAML::Node node = impl_->get(key);
  if (!node.IsSequence()) {
    throw error(key, "must be a list of maps, not " + kindOf(node));
  }
  std::vector<Section> sections;
  for (const YAML::Node& item : node) {
    if (!item.IsMap()) {
      throw impl_->fault(item, key, "must be a list of maps, and has " + kindOf(item));
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
