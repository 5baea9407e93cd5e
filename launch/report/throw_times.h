#pragma once

#include <optional>
#include <string>

#include "launch/throw_record.h"

namespace fastball::launch {

/// The moments of a throw that its pictures show, in seconds from their origin: the ball's departure, or where
/// nobody felt it leave, the planned release, or else the first state of arm or hand.
struct ThrowTimes {
  int64_t origin = 0;                    ///< [us]
  std::string of_origin;                 ///< "the ball's departure", ...
  std::optional<double> swing;           ///< the swing begins, as planned
  std::optional<double> swing_end;       ///< the follow-through begins, as planned
  std::optional<double> command;         ///< the hand is told to let go
  std::optional<double> departure;       ///< the ball leaves
  std::optional<double> window[2] = {};  ///< in which the ball may leave, as planned

  /// [s], of a simulated time [us].
  double at(int64_t utime) const { return 1e-6 * static_cast<double>(utime - origin); }
};

/// @throw std::runtime_error if the throw has no state of arm or hand, no plan and no release.
ThrowTimes timesOf(const ThrowRecord& record);

/// On which side of its line the words of a moment stand.
enum class WordsAt { kLeft, kMiddle, kRight };

/// gnuplot: a line across the panel at a moment, if there is one, with words above the panel.
/// @param number of the arrow and the label. @param scale of the axis: 1 for seconds, 1000 for milliseconds.
std::string momentLine(int number,
                       const std::optional<double>& t,
                       double scale,
                       const std::string& words,
                       WordsAt side);

}  // namespace fastball::launch
