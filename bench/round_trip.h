#pragma once

#include <string>
#include <vector>

namespace fastball::bench {

/// A robot says its state 1000 times a second, a controller in another process answers each with a command.
struct RoundTrips {
  std::vector<double> lcm;    ///< [s], from the state to its command, over two LcmEndpoints
  std::vector<double> bare;   ///< [s], the same bytes and loop on bare UDP multicast sockets
  std::vector<double> piped;  ///< [s], as bare, with a reading thread and a pipe as LCM 1.3.1 has
};

/// Some hundred trips each way in turn, for `seconds`, so that all meet the same machine. A trip that got no answer
/// in 20 ms is left out.
/// @throw std::runtime_error if the network carries none.
RoundTrips roundTrips(double seconds);

/// The value that a share of all lies below. `values`: not empty.
double quantile(std::vector<double> values, double share);

}  // namespace fastball::bench
