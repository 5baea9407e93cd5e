#pragma once

#include <string>

#include "launch/doctor/finding.h"

namespace fastball::launch {

// All throw std::invalid_argument if the URL does not parse, the first three also if it is not
// udpm's; all but the first throw std::runtime_error as messaging::LcmEndpoint.

/// The route to the URL's group, its interface, and how far the messages go.
Findings checkRoute(const std::string& lcm_url);

/// Messages of several sizes, sent to ourselves on a port that nobody else uses: the time they take, and whether those of many
/// fragments arrive.
Findings checkRoundTrip(const std::string& lcm_url);

/// What the kernel keeps for a receiver that is busy: its limit, and how many images were lost of a
/// burst that nobody read.
Findings checkReceiveBuffer(const std::string& lcm_url);

/// Listens to HEARTBEATs for a second: who is there, and how far each host's clock is from ours, by questions and answers.
Findings checkOthers(const std::string& lcm_url);

}  // namespace fastball::launch
