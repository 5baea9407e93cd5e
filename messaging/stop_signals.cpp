#include "messaging/stop_signals.h"

#include <sys/eventfd.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <stdexcept>

namespace fastball::messaging {
namespace {

constexpr std::array kSignals = {SIGINT, SIGTERM};

// A signal handler can reach nothing but what is global.
volatile std::sig_atomic_t signal_received = 0;
int event_fd = -1;
int nesting = 0;
std::array<struct sigaction, kSignals.size()> actions_before{};

extern "C" void onStopSignal(int /*signal*/) {
  const int error_before = errno;
  signal_received = 1;
  const uint64_t one = 1;
  // It cannot fail in a way that matters: the descriptor is readable then already.
  [[maybe_unused]] const auto written = write(event_fd, &one, sizeof(one));
  errno = error_before;
}

}  // namespace

StopSignals::StopSignals() {
  if (nesting++ > 0)
    return;
  signal_received = 0;
  event_fd = eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK);
  if (event_fd < 0) {
    --nesting;
    throw std::runtime_error("no file descriptor left for signals");
  }
  struct sigaction action {};
  action.sa_handler = onStopSignal;
  // LCM's own thread may get the signal: let its system calls go on.
  action.sa_flags = SA_RESTART;
  sigemptyset(&action.sa_mask);
  for (std::size_t i = 0; i < kSignals.size(); ++i) {
    sigaction(kSignals[i], &action, &actions_before[i]);
  }
}

StopSignals::~StopSignals() {
  if (--nesting > 0)
    return;
  for (std::size_t i = 0; i < kSignals.size(); ++i) {
    sigaction(kSignals[i], &actions_before[i], nullptr);
  }
  close(event_fd);
  event_fd = -1;
}

bool StopSignals::received() const {
  return signal_received != 0;
}

int StopSignals::fileDescriptor() const {
  return event_fd;
}

}  // namespace fastball::messaging
