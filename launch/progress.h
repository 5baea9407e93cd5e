#pragma once

#include <cstdint>
#include <string>

namespace fastball::launch {

/// What `fastball run` shows: lines on stdout, and where stderr is a terminal one line there that
/// is written over and over while a throw goes on.
class Progress {
 public:
  /// @param silent: says nothing at all.
  explicit Progress(bool silent = false);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void line(const std::string& text);
  /// `text` in the live line, at most ten times a second; `now_us`: monotonic time [us].
  void status(const std::string& text, int64_t now_us);

 private:
  void clearStatus();
  bool silent_;
  bool terminal_;
  bool shown_ = false;
  int64_t next_us_ = INT64_MIN;
};

}  // namespace fastball::launch
