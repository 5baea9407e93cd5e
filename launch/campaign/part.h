#pragma once

#include <string>

#include "launch/campaign/record.h"

namespace fastball::launch {

/// Makes the throws of a unit in this process, without a network.
/// @throw std::invalid_argument as prepareRun().
/// @throw std::runtime_error if they cannot be made: what went wrong. A throw that the planner
///   refuses is a miss with a note, and so are those after it in the unit.
UnitResult runUnit(const Campaign& campaign, const Unit& unit);

/// Does every `parts`-th of the units that the folder's campaign still lacks, beginning with number
/// `part`, and records each when it is done. SIGINT or SIGTERM ends it, and the unit it is at is
/// not recorded.
/// @param todo file with the numbers of the units to do, one a line, so that all parts agree on them.
/// @return false if it was interrupted.
/// @throw std::invalid_argument if there is no campaign or no such file.
/// @throw std::runtime_error at the end, or after ten units that failed: what went wrong last.
bool runPart(const std::string& folder, const std::string& todo, int part, int parts);

/// Writes the numbers of the units that the record lacks to a new file of the folder. @return its path; empty: nothing is to do.
std::string writeTodo(const std::string& folder, const Campaign& campaign);

}  // namespace fastball::launch
