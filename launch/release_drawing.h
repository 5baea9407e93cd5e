#pragma once

#include <string>
#include <vector>

#include "config/experiment.h"
#include "launch/figures/table.h"
#include "launch/release_sequence.h"
#include "launch/throw_record.h"

namespace fastball::launch {

/// Draws how the hand lets go of the ball (Fig. 12), seen square to throw and forearm: every 100 ms over the whole throw, and
/// every 2 ms around the release, with fingers, palm and ball in their true sizes; and how far each finger is from the ball.
/// Writes path_stem.png, .svg and .csv: every tick that is drawn.
/// @param title what is said of the throw before the rest of the picture's title.
/// @return the caption: what is seen, with its numbers.
/// @throw std::runtime_error if the throw's messages do not suffice (says which is missing) or gnuplot fails.
std::string drawRelease(const ThrowRecord& record,
                        const config::Experiment& experiment,
                        const std::string& title,
                        const std::string& path_stem);

/// The places of all that is drawn at these ticks.
Table releaseTable(const std::vector<const HandAndBall*>& ticks);

/// What a picture of this release shows, in sentences.
std::string releaseCaption(const ReleaseSequence& sequence, const config::Experiment& experiment);

}  // namespace fastball::launch
