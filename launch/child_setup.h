#pragma once

#include <sys/types.h>

namespace fastball::launch {

/// To be called in a child between fork and exec (only system calls are made): the child is sent `signal` when `parent`, the
/// process that forked it, ends in whatever way; it holds none of its files but the standard ones; no signal is blocked.
void prepareChild(pid_t parent, int signal);

}  // namespace fastball::launch
