#include "launch/spy/plot.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace fastball::launch {
namespace {

constexpr std::array<const char*, 9> kBlocks = {" ", "▁", "▂", "▃", "▄", "▅", "▆", "▇", "█"};
constexpr std::array<const char*, 5> kAscii = {" ", "_", ".", "-", "#"};

struct Range {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
};

/// 0: empty, else the share of the height, at least `least` so that the smallest sample is seen.
double share(double value, const Range& range, double least) {
  if (!std::isfinite(value))
    return 0;
  // Halves: the difference of two numbers may be beyond the largest.
  const double span = range.high / 2 - range.low / 2;
  return span > 0 ? least + (1 - least) * (value / 2 - range.low / 2) / span : 0.5;
}

const char* cell(double filled, PlotStyle style) {
  const auto pick = [filled](const auto& levels) {
    const auto last = static_cast<double>(levels.size() - 1);
    return levels[static_cast<std::size_t>(std::lround(std::clamp(filled, 0.0, 1.0) * last))];
  };
  return style.blocks ? pick(kBlocks) : pick(kAscii);
}

}  // namespace

std::vector<std::string> plot(const std::deque<double>& samples,
                              std::size_t width,
                              std::size_t height,
                              PlotStyle style) {
  const std::size_t drawn = std::min(width, samples.size());
  const auto begin = samples.end() - static_cast<std::ptrdiff_t>(drawn);
  Range range;
  for (auto sample = begin; sample != samples.end(); ++sample) {
    if (std::isfinite(*sample))
      range = {std::min(range.low, *sample), std::max(range.high, *sample)};
  }
  const auto rows = static_cast<double>(height);
  const double least =
      1 / (rows * static_cast<double>(style.blocks ? kBlocks.size() - 1 : kAscii.size() - 1));
  std::vector<std::string> lines(height);
  for (std::size_t row = 0; row < height; ++row) {
    const auto below = static_cast<double>(height - 1 - row);
    for (auto sample = begin; sample != samples.end(); ++sample)
      lines[row] += cell(rows * share(*sample, range, least) - below, style);
  }
  return lines;
}

void FieldHistory::add(const std::vector<FieldLine>& lines) {
  for (const FieldLine& line : lines) {
    std::deque<double>& samples = samples_[line.name];
    samples.push_back(line.number.value_or(std::numeric_limits<double>::quiet_NaN()));
    if (samples.size() > length_)
      samples.pop_front();
  }
}

const std::deque<double>& FieldHistory::of(const std::string& name) const {
  static const std::deque<double> none;
  const auto found = samples_.find(name);
  return found == samples_.end() ? none : found->second;
}

}  // namespace fastball::launch
