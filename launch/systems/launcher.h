#pragma once

#include "launch/systems/state_folder.h"
#include "launch/systems/system_file.h"

namespace fastball::launch {

/// Supervises a system in this process until it is told to end; its words and the processes' output go to stdout.
/// @throw std::runtime_error if it did not become ready, or another process supervises it.
void superviseHere(const System& system, StateFolder& folder);

/// The same in a process of its own that outlives this one; its words go to `launcher.log` in the folder.
/// @return when all is ready. @throw std::runtime_error as above.
void superviseBehind(const System& system, StateFolder& folder);

/// Ends the launcher of a system and waits for it. @return false if there was none.
/// @throw std::runtime_error if it does not end.
bool endLauncher(const StateFolder& folder, const System& system);

}  // namespace fastball::launch
