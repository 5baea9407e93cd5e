#pragma once

#include <deque>
#include <map>
#include <string>
#include <vector>

#include "launch/spy/field_summary.h"

namespace fastball::launch {

/// Numbers over time, drawn in characters.
struct PlotStyle {
  bool blocks = true;  ///< eighths of a character cell (UTF-8); false: ASCII
};

/// `height` lines of at most `width` cells, the newest sample on the right, the largest of those drawn at the top
/// and the smallest at the bottom. A sample that is not finite leaves its column empty.
std::vector<std::string> plot(const std::deque<double>& samples,
                              std::size_t width,
                              std::size_t height,
                              PlotStyle style);

/// The last samples of every number of one message.
class FieldHistory {
 public:
  explicit FieldHistory(std::size_t length) : length_(length) {}
  /// Another sample of each line; one without a number gets NaN.
  void add(const std::vector<FieldLine>& lines);
  /// The samples of the line called `name`, oldest first.
  const std::deque<double>& of(const std::string& name) const;
  void clear() { samples_.clear(); }

 private:
  std::size_t length_;
  std::map<std::string, std::deque<double>> samples_;
};

}  // namespace fastball::launch
