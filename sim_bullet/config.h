#pragma once

#include <Eigen/Core>
#include <string>

#include "config/experiment.h"

namespace fastball::sim_bullet {

/// A stop that pushes back like a spring with a damper once a joint is past it.
struct StopSettings {
  double stiffness = 0;  ///< [N m/rad]
  double damping = 0;    ///< [N m s/rad]
};

/// The net behind the target's ring.
struct NetSettings {
  double tube_radius = 0;     ///< [m], of the ring's tube, outside the target's radius
  double ring_stiffness = 0;  ///< [N/m], of the ring where the ball touches it
  double ring_damping = 0;    ///< [N s/m]
  double friction = 0;        ///< of the ring
  double bag_depth = 0;       ///< [m], behind the ring
  double bag_time = 0;        ///< [s], in which the fabric takes the ball's speed by a factor e
  double bag_stiffness = 0;   ///< [N/m], of the bag's side and bottom
};

struct FloorSettings {
  double height = 0;  ///< [m], z in the world
  double friction = 0;
  double restitution = 0;
};

/// The force sensors in the fingertips.
struct TactileSettings {
  double noise = 0;       ///< [N], standard deviation of each component, white at 1 kHz
  double delay = 0;       ///< [s], from a force to its reading
  double resolution = 0;  ///< [N], step of the reading; 0: none
};

/// What measures landings where there are no cameras: a light curtain in the plane of the net's ring.
struct CurtainSettings {
  double noise = 0;  ///< [m], standard deviation of each coordinate
};

/// Section `simulation` of the experiment file.
struct SimulationSettings {
  int substeps = 0;     ///< physics steps in a control tick
  double watchdog = 0;  ///< [s], real time only: the oldest arm command that still counts
  Eigen::Vector4d brake_damping =
      Eigen::Vector4d::Zero();  ///< [N m s/rad], of the watchdog's brake
  StopSettings arm_stop, wrist_stop, finger_stop;
  double spread_limit = 0;      ///< [rad], both ways
  double flexion_limit = 0;     ///< [rad], of the phalanges' joints, both ways
  double open_clearance = 0;    ///< [m], between ball and open fingers at the start of a scene
  double feeder_release = 0;    ///< [s] after the scene's start, the feeder lets the ball go
  double feeder_frequency = 0;  ///< [rad/s], of the ball on the feeder's spring, critically damped
  TactileSettings tactile;
  CurtainSettings light_curtain;
  NetSettings net;
  FloorSettings floor;
};

/// @throw config::ConfigError naming file, line and key.
SimulationSettings loadSimulationSettings(const std::string& experiment_path);

}  // namespace fastball::sim_bullet
