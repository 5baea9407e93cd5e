#pragma once

#include <string>

#include "launch/campaign/record.h"

namespace fastball::launch {

/// Makes the throws of a unit in this process, without a network.
/// @throw std::runtime_error if they cannot be made: what went wrong. A throw that the planner refuses is a miss with a note.
UnitResult runUnit(const Campaign& campaign, const Unit& unit);

/// Does every `parts`-th of the units that the folder's campaign still lacks, beginning with number `part`, and
/// records each when it is done. SIGINT or SIGTERM ends it after nothing is left half-recorded.
/// @param todo file with the numbers of the units to do, one a line, so that all parts agree on them.
/// @return false if it was interrupted.
bool runPart(const std::string& folder, const std::string& todo, int part, int parts);

/// Writes the numbers of the units that the record lacks to a new file of the folder. @return its path; empty: nothing is to do.
std::string writeTodo(const std::string& folder, const Campaign& campaign);

}  // namespace fastball::launch
