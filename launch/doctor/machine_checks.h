#pragma once

#include "launch/doctor/finding.h"

namespace fastball::launch {

/// Whether a process may ask for real-time priority, and how long the kernel lets a thread wait that wants to wake each millisecond.
Findings checkRealTime();

/// Room and speed of the disk under the present folder, against what a log takes.
Findings checkDisk();

/// The versions that this program runs with, and the traps known of them.
Findings checkLibraries();

}  // namespace fastball::launch
