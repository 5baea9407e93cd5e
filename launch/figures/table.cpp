#include "launch/figures/table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <fstream>
#include <stdexcept>

namespace fastball::launch {

void writeCsv(const Table& table, const std::string& path) {
  std::ofstream file(path);
  file << fmt::format("{}\n", fmt::join(table.columns, ","));
  for (const std::vector<double>& row : table.rows) {
    const char* comma = "";
    for (const double value : row) {
      file << comma;
      comma = ",";
      if (std::isfinite(value))
        file << fmt::format("{:.6g}", value);
    }
    file << '\n';
  }
  if (!file.flush())
    throw std::runtime_error(fmt::format("cannot write '{}'", path));
}

std::string plotData(const Table& table) {
  std::string data;
  for (const std::vector<double>& row : table.rows) {
    for (const double value : row)
      data += std::isfinite(value) ? fmt::format("{:.6g} ", value) : "NaN ";
    data += '\n';
  }
  return data;
}

}  // namespace fastball::launch
