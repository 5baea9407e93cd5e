#pragma once

#include <memory>
#include <string>

#include "launch/progress.h"
#include "launch/replay.h"
#include "messaging/stop_signals.h"

namespace fastball::launch {

/// The terminal of `fastball replay`: the space bar pauses and goes on, Ctrl-C ends, and one line says how far it
/// is. Where standard input is no terminal, nothing but the signals is heard.
class TerminalConsole : public ReplayConsole {
 public:
  explicit TerminalConsole(bool paused);
  ~TerminalConsole() override;
  void wait(int64_t until_us) override;
  bool paused() override { return paused_; }
  bool stopped() override { return signals_.received(); }
  void show(double time, double share, int64_t said) override;
  /// Prints a line that stays.
  void line(const std::string& text) { progress_.line(text); }

 private:
  void readKeys();
  void showState();
  struct Terminal;
  messaging::StopSignals signals_;
  std::unique_ptr<Terminal> terminal_;
  Progress progress_;
  bool paused_;
  double time_ = 0;
  double share_ = 0;
  int64_t said_ = 0;
  static constexpr int64_t kShowPeriodUs = 100'000;
  int64_t next_show_us_ = INT64_MIN;
};

}  // namespace fastball::launch
