#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "launch/campaign/statistics.h"

namespace fastball::launch {

/// The object of `fastball campaign --json`: per case throws, hits, rates with intervals, bias, scatter.
/// @param throws_per_minute of the time that this program has worked on it; 0: unknown.
nlohmann::json campaignJson(const Campaign& campaign,
                            const std::map<Unit, UnitResult>& record,
                            double throws_per_minute);

/// A table of the cases, one a line.
std::string campaignTable(const Campaign& campaign, const std::map<Unit, UnitResult>& record);

/// One line a throw: case, seed, number in its set-up, hit, clean, landing, measured landing [mm], release speed, note.
/// @throw std::runtime_error if the file cannot be written.
void writeThrowsCsv(const Campaign& campaign,
                    const std::map<Unit, UnitResult>& record,
                    const std::string& path);

}  // namespace fastball::launch
