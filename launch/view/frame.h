#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "launch/view/timeline.h"

namespace fastball::view {

/// How far a viewer has been told.
struct Cursor {
  int64_t sample = 0;
  int64_t heartbeat = 0;
  int64_t track = 0;
  int64_t throw_serial = 0;
  std::map<std::string, int64_t> pictures;
  bool whole = false;  ///< nothing was left out of the last frame for its size
};

/// What a viewer must know before the first frame: how samples are laid out, what is drawn between
/// their points, limits, target. `floor` [m]: as of Figure.
nlohmann::json hello(const Timeline& timeline, const config::Experiment& experiment, double floor);

/// What has been added since `cursor`, which is moved on; at most kFrameSamples samples, the rest
/// with the next frame. `more` is put into its text. A frame is, little endian: the length of the
/// text [bytes] as a uint32, the text (JSON, padded with spaces until what follows begins at a
/// multiple of eight), the times of the samples [s] as float64, and their values as float32, sample
/// by sample.
/// @param wall_us now [us since 1970], for the age of HEARTBEATs
/// @return empty if there is nothing new and `more` is null.
std::string nextFrame(const Timeline& timeline,
                      Cursor& cursor,
                      const nlohmann::json& more,
                      int64_t wall_us);
inline constexpr int64_t kFrameSamples = 10'000;

/// JSON in which bytes that are no UTF-8 are replaced: names and notes come from other processes.
std::string text(const nlohmann::json& object);

}  // namespace fastball::view
