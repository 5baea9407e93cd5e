#pragma once

#include <functional>
#include <string>

#include "launch/throw_record.h"
#include "messaging/endpoint.h"

namespace fastball::launch {

/// One throw of the experiment in this process, recorded as from its log.
/// @param listen subscribes to what else a listener wants to hear of it, before it begins.
/// @throw std::runtime_error if the throw fails.
ThrowRecord recordedThrow(const std::string& config,
                          const std::string& strategy,
                          const std::function<void(messaging::Endpoint&)>& listen = {});

}  // namespace fastball::launch
