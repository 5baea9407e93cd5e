#include "launch/child_setup.h"

#include <sys/prctl.h>
#include <unistd.h>

#include <csignal>

#include <linux/close_range.h>

namespace fastball::launch {

void prepareChild(pid_t parent, int signal) {
  prctl(PR_SET_PDEATHSIG, signal);
  if (getppid() != parent)
    _exit(1);
  close_range(STDERR_FILENO + 1, ~0U, CLOSE_RANGE_CLOEXEC);
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
}

}  // namespace fastball::launch
