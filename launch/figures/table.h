#pragma once

#include <limits>
#include <string>
#include <vector>

namespace fastball::launch {

/// A field of a table that is left empty.
inline constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();

/// Numbers under named columns, which is what a picture is drawn from and what a reader gets as
/// CSV.
struct Table {
  std::vector<std::string> columns;  ///< with units, without commas: "q2 (rad)"
  std::vector<std::vector<double>> rows;
};

/// @throw std::runtime_error if the file cannot be written.
void writeCsv(const Table& table, const std::string& path);

/// The same as data for gnuplot: columns apart by blanks, numbers that are missing as "NaN", no
/// header.
std::string plotData(const Table& table);

}  // namespace fastball::launch
