#pragma once

#include "launch/report/logged_run.h"

namespace fastball::launch {

/// How long a process's loops took, by its HEARTBEATs; those that name no time do not count.
struct LoopTimes {
  int beats = 0;               ///< that count
  double median_mean_us = 0;   ///< [us], of the means that they name
  double largest_mean_us = 0;  ///< [us]
  double worst_us = 0;         ///< [us], the longest loop of all
};
LoopTimes loopTimesOf(const LoggedProcess& process);

}  // namespace fastball::launch
