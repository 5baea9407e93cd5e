#include <fmt/format.h>

#include <cmath>

#include "launch/release_drawing.h"

namespace fastball::launch {
namespace {

constexpr const char* kFingerNames[] = {"finger A", "the thumb", "finger B"};
constexpr double kQuiet = 0.15;  ///< [s], for which nothing may touch the ball once it has left

/// "the thumb has opened by 32 degrees"
std::string turned(double closed) {
  return fmt::format("{} by {:.1f} degrees", closed < 0 ? "opened" : "closed",
                     std::abs(closed) * 180 / M_PI);
}

std::string openingWords(const ReleaseSequence& sequence,
                         double t,
                         const config::Experiment& experiment) {
  const Opening opening = openingAt(sequence, t, experiment.hand.p_HBall);
  return fmt::format(
      " {:.0f} ms after it left, the ball is {:.1f} mm out of the hand, nearest to it is {} at "
      "{:.1f} mm; the thumb has {}, finger A has {} and finger B {}.",
      1e3 * t, 1e3 * opening.way_out, kFingerNames[opening.nearest], 1e3 * opening.gap,
      turned(opening.closed[model::kThumb]), turned(opening.closed[model::kFingerA]),
      turned(opening.closed[model::kFingerB]));
}

}  // namespace

std::string releaseCaption(const ReleaseSequence& sequence, const config::Experiment& experiment) {
  std::string caption = fmt::format(
      "The hand is told to let go {:.1f} ms before the ball leaves it at {:.2f} m/s. Until it "
      "leaves, "
      "the ball is drawn where the hand has held it; the flight that the tracker saw begins {:.1f} "
      "mm "
      "from there.",
      -1e3 * sequence.t_command, sequence.v_WBall.norm(), 1e3 * sequence.step_H.norm());
  for (const double t : {0.02, 0.04})
    caption += openingWords(sequence, t, experiment);
  constexpr double kClear = 0.01;
  caption += fmt::format(
      " From {:.0f} to {:.0f} ms after the departure nothing of the hand comes nearer to the ball "
      "than {:.1f} mm.",
      1e3 * kClear, 1e3 * kQuiet, 1e3 * smallestGap(sequence, kClear, kQuiet));
  return caption;
}

}  // namespace fastball::launch
