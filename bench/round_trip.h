#pragma once

#include <string>
#include <vector>

namespace fastball::bench {

/// A robot says its state 1000 times a second, a controller in another process answers each with a command.
struct RoundTrips {
  std::vector<double> lcm;  ///< [s], from the state to its command, over two LcmEndpoints
  std::vector<double>
      bare;  ///< [s], the same bytes and loop on bare UDP multicast sockets of the same group
};

/// Some hundred trips one way, then the other, and so on for `seconds`, so that both meet the same machine. A trip that got no answer
/// in 20 ms is left out of both.
/// @throw std::runtime_error if the network carries neither.
RoundTrips roundTrips(double seconds);

/// The value that a share of all lies below. `values`: not empty.
double quantile(std::vector<double> values, double share);

}  // namespace fastball::bench
