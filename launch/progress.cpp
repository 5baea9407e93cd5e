#include "launch/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>

namespace fastball::launch {
namespace {

constexpr int64_t kIntervalUs = 100000;
constexpr const char* kClearLine = "\r\033[K";

}  // namespace

Progress::Progress(bool silent) : silent_(silent), terminal_(isatty(STDERR_FILENO) == 1) {}

Progress::~Progress() {
  clearStatus();
}

void Progress::line(const std::string& text) {
  if (silent_)
    return;
  clearStatus();
  fmt::print("{}\n", text);
  std::fflush(stdout);
}

void Progress::status(const std::string& text, int64_t now_us) {
  if (silent_)
    return;
  if (!terminal_ || now_us < next_us_)
    return;
  next_us_ = now_us + kIntervalUs;
  fmt::print(stderr, "{}{}", kClearLine, text);
  std::fflush(stderr);
  shown_ = true;
}

void Progress::clearStatus() {
  if (!shown_)
    return;
  fmt::print(stderr, "{}", kClearLine);
  std::fflush(stderr);
  shown_ = false;
}

}  // namespace fastball::launch
