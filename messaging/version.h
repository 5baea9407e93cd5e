#pragma once

namespace fastball::messaging {

/// The version that every HEARTBEAT and `--version` name: "0.1.0+1a2b3c4" (with the commit if it
/// was built from a git checkout).
const char* version();

}  // namespace fastball::messaging
