#pragma once

#include <memory>

#include "launch/spy/spy_output.h"

namespace fastball::launch {

/// `fastball spy` on a terminal: the table of channels, and the members of one channel's newest message with plots.
class TerminalView : public SpyOutput {
 public:
  /// Takes over the terminal of standard input and output; its state comes back with the destructor.
  /// @return null if they are no terminal, or one that cannot move its cursor. `title`: the first line. `interval_s`: between two
  /// samples of the plots.
  static std::unique_ptr<TerminalView> open(const std::string& title, double interval_s);
  ~TerminalView() override;
  TerminalView(const TerminalView&) = delete;
  TerminalView& operator=(const TerminalView&) = delete;

  void show(const Traffic& traffic, int64_t now) override;
  bool hasKeys() const override { return true; }
  bool readKeys(const Traffic& traffic, int64_t now) override;

 private:
  struct State;
  explicit TerminalView(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace fastball::launch
