#pragma once

#include <map>
#include <string>

#include "config/experiment.h"
#include "launch/report/logged_run.h"

/// Pictures of one throw of a log, each as path_stem.png and path_stem.svg, most with their numbers as path_stem.csv.
/// Each draws what there is, and throws std::runtime_error with the name of the channel that it cannot do without, or
/// if gnuplot fails. Each returns what is said below the picture: sentences with the numbers of this throw.
namespace fastball::launch {

/// Arm and ball at even times from the side and from above (Fig. 13), and the landing in the net's face with its 95 % ellipse.
/// The arm comes from ARM_STATE, the flying ball from the tracker, or, where none was part of the run, from SIM_TRUTH.
std::string drawThrow(const LoggedThrow& thrown,
                      const config::Experiment& experiment,
                      const std::string& path_stem);

/// Speeds and torques of the joints as shares of their limits, from the swing to the end of the follow-through.
std::string drawMotion(const LoggedThrow& thrown,
                       const config::Experiment& experiment,
                       const std::string& path_stem);

/// Forces of the three fingers on the ball around its release.
std::string drawFingers(const LoggedThrow& thrown, const std::string& path_stem);

/// What the tracker saw less what its last fit says, for each camera.
/// @param cameras CAMERA_INFO of each channel of images.
std::string drawResiduals(const LoggedThrow& thrown,
                          const std::map<std::string, camera_info_t>& cameras,
                          const config::Experiment& experiment,
                          const std::string& path_stem);

}  // namespace fastball::launch
