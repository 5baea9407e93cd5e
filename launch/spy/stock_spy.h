#pragma once

#include <string>

namespace fastball::launch {

/// Becomes LCM's own lcm-spy, which Debian's start script cannot start, with the types of this project and those of the jars in
/// $CLASSPATH. Does not return.
/// @throw std::runtime_error that says what it lacks: Java, its jars, a display.
[[noreturn]] void runStockSpy(const std::string& lcm_url);

}  // namespace fastball::launch
