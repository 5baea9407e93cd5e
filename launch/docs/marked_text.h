#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace fastball::launch {

/// A page whose block between the lines `<!-- NAME -->` and `<!-- /NAME -->` is `block` in place of what it was.
/// @throw std::runtime_error that names the marker if the page does not have it.
std::string withBlock(const std::string& page, const std::string& name, const std::string& block);

/// A page whose table rows `| `id` | ...` are `row` in place of what they were; `found` tells whether there was one.
std::string withRow(const std::string& page,
                    const std::string& id,
                    const std::string& row,
                    bool& found);

/// The same for a row of `fastball bench --json`.
std::string withBenchmark(const std::string& page, const nlohmann::json& row, bool& found);

}  // namespace fastball::launch
