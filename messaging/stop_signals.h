#pragma once

namespace fastball::messaging {

/// While one of these lives, SIGINT and SIGTERM do not kill the process but are remembered,
/// whichever thread gets them. May be nested; the outermost one restores what was before. Create
/// and destroy on one thread.
class StopSignals {
 public:
  /// @throw std::runtime_error if the kernel has no file descriptor left.
  StopSignals();
  ~StopSignals();
  StopSignals(const StopSignals&) = delete;
  StopSignals& operator=(const StopSignals&) = delete;

  /// True once a signal has come.
  bool received() const;
  /// Readable once a signal has come, so that poll() cannot miss one that comes just before it.
  int fileDescriptor() const;
};

}  // namespace fastball::messaging
