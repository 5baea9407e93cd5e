#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "messaging/endpoint.h"

namespace fastball::system_test {

/// Hears how the arm of a run moves and when its controller begins to brake, whoever else of the run can hear it or not.
class ArmWitness {
 public:
  void listen(messaging::Endpoint& endpoint);

  /// Every state lies within the limits of position, speed and torque, and after the first command to brake the
  /// arm goes no further than the controller's braking law from the state at that tick. Fails the test where not.
  void expectLimitsKept() const;
  /// The arm does not move in the last state heard.
  void expectRest() const;

 private:
  void expectBrakingDistanceKept() const;

  std::vector<arm_state_t> states_;     ///< one a tick
  std::optional<arm_command_t> brake_;  ///< the first
};

}  // namespace fastball::system_test
