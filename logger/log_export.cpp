#include "logger/log_export.h"

#include <fmt/format.h>

#include <map>
#include <optional>
#include <stdexcept>
#include <unordered_map>

#include "logger/log_reader.h"

namespace fastball::logger {
namespace {

using messaging::MessageField;

constexpr std::size_t kMaxColumns = 10000;

std::string quoted(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos)
    return text;
  std::string result = "\"";
  for (const char c : text)
    result += c == '"' ? std::string("\"\"") : std::string(1, c);
  return result + "\"";
}

/// Messages with the same members and array lengths share one of these.
std::string shapeOf(const std::vector<MessageField>& fields) {
  std::string shape;
  for (const MessageField& field : fields) {
    shape += field.name();
    for (const int64_t size : field.sizes())
      shape += fmt::format("[{}]", size);
    shape += ' ';
  }
  return shape;
}

/// Which value of a message stands in a column.
struct Cell {
  std::size_t field = 0;
  std::size_t element = 0;
};

class Table {
 public:
  explicit Table(const std::vector<std::string>& wanted) : wanted_(wanted) {}

  /// Makes columns for all values of such a message that are wanted.
  void addColumns(const std::vector<MessageField>& fields) {
    if (!shapes_.try_emplace(shapeOf(fields)).second)
      return;
    for (const MessageField& field : fields) {
      names_of_fields_.try_emplace(field.name(), field.sizes().size());
      for (std::size_t i = 0; i < field.count(); ++i) {
        if (wants(field, i))
          addColumn(field.elementName(i));
      }
    }
  }

  /// @throw std::invalid_argument if something that was wanted is in no message.
  void orderColumns() {
    if (wanted_.empty())
      return;
    std::vector<std::string> ordered;
    for (const std::string& name : wanted_) {
      const std::size_t before = ordered.size();
      for (const std::string& column : columns_) {
        if (column == name || column.rfind(name + "[", 0) == 0)
          ordered.push_back(column);
      }
      if (ordered.size() == before)
        throw std::invalid_argument(
            fmt::format("there is no field '{}'; there are {}", name, fieldNames()));
    }
    columns_ = ordered;
  }

  const std::vector<std::string>& columns() const { return columns_; }

  /// Where the values of each column stand in such a message.
  const std::vector<std::optional<Cell>>& cells(const std::vector<MessageField>& fields) {
    auto& cells = shapes_[shapeOf(fields)];
    if (cells.empty()) {
      for (const std::string& column : columns_)
        cells.push_back(find(fields, column));
    }
    return cells;
  }

 private:
  bool wants(const MessageField& field, std::size_t i) const {
    if (wanted_.empty())
      return true;
    for (const std::string& name : wanted_) {
      if (name == field.name() || field.indexOf(name) == i)
        return true;
    }
    return false;
  }

  void addColumn(const std::string& name) {
    if (!known_.try_emplace(name, columns_.size()).second)
      return;
    columns_.push_back(name);
    if (columns_.size() > kMaxColumns)
      throw std::invalid_argument(
          fmt::format("the messages have more than {} values; name those wanted of {}", kMaxColumns,
                      fieldNames()));
  }

  std::string fieldNames() const {
    std::string text;
    for (const auto& [name, dimensions] : names_of_fields_) {
      text += (text.empty() ? "" : ", ") + name;
      for (std::size_t i = 0; i < dimensions; ++i)
        text += "[]";
    }
    return text;
  }

  static std::optional<Cell> find(const std::vector<MessageField>& fields,
                                  const std::string& column) {
    for (std::size_t f = 0; f < fields.size(); ++f) {
      if (const auto element = fields[f].indexOf(column))
        return Cell{f, *element};
    }
    return std::nullopt;
  }

  const std::vector<std::string>& wanted_;
  std::vector<std::string> columns_;
  std::unordered_map<std::string, std::size_t> known_;
  std::unordered_map<std::string, std::vector<std::optional<Cell>>> shapes_;
  std::map<std::string, std::size_t> names_of_fields_;
};

/// Calls `handler` with every message that is to be exported, taken apart. @return how many were and how many could not.
template <class Handler>
ExportResult forEach(LogReader& reader,
                     const ExportOptions& options,
                     const messaging::TypeLibrary& types,
                     Handler handler) {
  LogPart part;
  part.from = options.from;
  part.to = options.to;
  ExportResult result;
  std::optional<int64_t> start_utime;
  reader.rewind();
  for (LogEntry entry; reader.next(entry);) {
    if (!start_utime)
      start_utime = entry.utime;
    if (entry.channel != options.channel || !part.holds(entry.utime, *start_utime))
      continue;
    const auto fields = types.fields(entry.data.data(), entry.data.size());
    if (!fields) {
      ++result.undecodable;
      continue;
    }
    ++result.messages;
    handler(entry, *fields);
  }
  return result;
}

}  // namespace

ExportResult exportCsv(const std::string& path,
                       const ExportOptions& options,
                       const messaging::TypeLibrary& types,
                       std::ostream& csv) {
  LogReader reader(path);
  Table table(options.fields);
  const ExportResult found =
      forEach(reader, options, types,
              [&](const LogEntry&, const auto& fields) { table.addColumns(fields); });
  if (found.messages == 0)
    throw std::invalid_argument(
        fmt::format("'{}' holds no message on channel '{}' that can be decoded, and {} that cannot",
                    path, options.channel, found.undecodable));
  table.orderColumns();
  csv << "recv_utime";
  for (const std::string& column : table.columns())
    csv << ',' << column;
  csv << '\n';
  return forEach(reader, options, types, [&](const LogEntry& entry, const auto& fields) {
    csv << entry.utime;
    for (const auto& cell : table.cells(fields)) {
      csv << ',';
      if (cell)
        csv << quoted(fields[cell->field].text(cell->element));
    }
    csv << '\n';
  });
}

}  // namespace fastball::logger
