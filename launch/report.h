#pragma once

#include <string>
#include <vector>

#include "config/experiment.h"
#include "launch/throw_record.h"

namespace fastball::launch {

/// Draws one throw as PNG and SVG: stroboscopic side and top view (arm and ball at even times, the net), and the target's face
/// with the measured landing. The arm comes from ARM_STATE, the flying ball from the tracker.
/// @param path_stem file names without ".png" and ".svg".
/// @throw std::runtime_error if the throw's messages do not suffice (says which is missing) or gnuplot fails.
void drawThrow(const ThrowRecord& record,
               int64_t number,
               const config::Experiment& experiment,
               const std::string& path_stem);

/// Pictures of every throw of a log (throw-1, release-1 with its caption and its numbers, ...), and throws.csv with a line
/// each, in `folder` (made if absent).
/// @return one sentence for each picture that could not be drawn.
std::vector<std::string> writeReport(const std::string& log_path,
                                     const config::Experiment& experiment,
                                     const std::string& folder);

}  // namespace fastball::launch
