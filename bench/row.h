#pragma once

#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

namespace fastball::bench {

/// One line of the benchmark table.
struct Row {
  std::string id;
  double value = 0;
  std::string unit;
  std::string peer = "none";         ///< what the value is held against, measured in the same run
  std::optional<double> peer_value;  ///< in the same unit
  std::string note;
};

/// A row that can be measured.
struct Benchmark {
  std::string id;
  std::function<Row()> measure;
};

/// All rows, in the order of the table.
std::vector<Benchmark> allBenchmarks();

/// The object of `fastball bench --json`.
nlohmann::json toJson(const std::vector<Row>& rows);

/// The rows as a Markdown table.
std::string tableText(const std::vector<Row>& rows);

}  // namespace fastball::bench
