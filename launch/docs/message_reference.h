#pragma once

#include <filesystem>
#include <string>

namespace fastball::launch {

/// docs/messages.md: the channels, and every message with its fields, units and constants, from the comments of the .lcm files
/// in a folder. @throw std::runtime_error if the folder holds none, or one of them does not begin with a comment on its channel.
std::string messageReference(const std::filesystem::path& folder);

}  // namespace fastball::launch
