#pragma once

#include <cstdint>

#include "launch/spy/traffic.h"

namespace fastball::launch {

/// Where `fastball spy` shows what it hears.
class SpyOutput {
 public:
  virtual ~SpyOutput() = default;
  /// Called once an interval, and once more at the end. `now`: [us since 1970].
  virtual void show(const Traffic& traffic, int64_t now) = 0;
  /// True if readKeys() is to be called when standard input has something.
  virtual bool hasKeys() const { return false; }
  /// @return false: the user wants to end.
  virtual bool readKeys(const Traffic& /*traffic*/, int64_t /*now*/) { return true; }
};

/// One JSON object a line and channel. @throw std::runtime_error from show() if standard output does not take it; the other too.
class JsonOutput : public SpyOutput {
 public:
  void show(const Traffic& traffic, int64_t now) override;
};

/// The table of channels as plain text.
class TableOutput : public SpyOutput {
 public:
  void show(const Traffic& traffic, int64_t now) override;
};

}  // namespace fastball::launch
