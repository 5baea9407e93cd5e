#pragma once

#include <string>

namespace CLI {  // NOLINT(readability-identifier-naming): the library's own
class App;
}

namespace fastball::launch {

/// The manual page fastball(1) as troff, of every command and flag that --help shows.
std::string manualPage(const CLI::App& app, const std::string& version);

/// What bash completes after `fastball`: commands, their flags, the values of flags that have a list of them, else files.
std::string bashCompletion(const CLI::App& app);

}  // namespace fastball::launch
