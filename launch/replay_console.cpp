#include "launch/replay_console.h"

#include <fmt/format.h>
#include <poll.h>
#include <sys/prctl.h>
#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <ctime>

namespace fastball::launch {
namespace {

/// The kernel may wake a process that much later than it asks [ns].
constexpr unsigned long kTimerSlack = 1000;

}  // namespace

/// Standard input, key by key and without echo, until it goes.
struct TerminalConsole::Terminal {
  Terminal() {
    termios raw = before;
    raw.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO);
    raw.c_cc[VMIN] = 0;
    raw.c_cc[VTIME] = 0;
    tcsetattr(STDIN_FILENO, TCSANOW, &raw);
  }
  ~Terminal() { tcsetattr(STDIN_FILENO, TCSANOW, &before); }
  Terminal(const Terminal&) = delete;
  Terminal& operator=(const Terminal&) = delete;

  static termios now() {
    termios settings{};
    tcgetattr(STDIN_FILENO, &settings);
    return settings;
  }
  const termios before = now();
};

TerminalConsole::TerminalConsole(bool paused) : paused_(paused) {
  prctl(PR_SET_TIMERSLACK, kTimerSlack);
  // A job in the background must not touch the terminal: the system would stop it.
  if (isatty(STDIN_FILENO) != 0 && tcgetpgrp(STDIN_FILENO) == getpgrp())
    terminal_ = std::make_unique<Terminal>();
  showState();
}

TerminalConsole::~TerminalConsole() = default;

void TerminalConsole::wait(int64_t until_us) {
  const int64_t left_us = std::max<int64_t>(until_us - steadyUs(), 0);
  const timespec left{left_us / 1'000'000, left_us % 1'000'000 * 1000};
  std::array<pollfd, 2> inputs{
      {{signals_.fileDescriptor(), POLLIN, 0}, {terminal_ ? STDIN_FILENO : -1, POLLIN, 0}}};
  if (ppoll(inputs.data(), inputs.size(), &left, nullptr) > 0) {
    if ((inputs[1].revents & POLLIN) != 0)
      readKeys();
    else if (inputs[1].revents != 0)
      terminal_.reset();  // it has gone
  }
  showState();
}

void TerminalConsole::readKeys() {
  std::array<char, 64> keys{};
  const ssize_t n = read(STDIN_FILENO, keys.data(), keys.size());
  if (n > 0 && std::count(keys.begin(), keys.begin() + n, ' ') % 2 == 1)
    paused_ = !paused_;
}

void TerminalConsole::show(double time, double share, int64_t said) {
  time_ = time;
  share_ = share;
  said_ = said;
  showState();
}

void TerminalConsole::showState() {
  const int64_t now_us = steadyUs();
  if (now_us < next_show_us_)
    return;
  next_show_us_ = now_us + kShowPeriodUs;
  progress_.status(fmt::format("{:.1f} s, {:.0f} %, {} messages{}", time_, 100 * share_, said_,
                               paused_ ? ", paused (space: go on)" : ""),
                   now_us);
}

}  // namespace fastball::launch
