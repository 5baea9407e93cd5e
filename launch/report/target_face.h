#pragma once

#include <Eigen/Core>
#include <string>

#include "launch/report/logged_run.h"
#include "lcmtypes/fastball_types.h"

namespace fastball::launch {

/// Outline [mm] of the region of the target plane that holds the landing with 95 % probability by its covariance, for gnuplot.
std::string ellipse95(const landing_t& landing);

/// Half the widths [m] of that region's upright box.
Eigen::Vector2d extent95(const landing_t& landing);

/// gnuplot: two panels of the net's face as the robot sees it. The first shows the ring, the ring for the whole
/// ball, and the landing with its ellipse and the truth; the second the landing enlarged.
struct FacePanels {
  std::string data, commands;
};
/// @param ball_radius [m]. @param whole, enlarged commands that set the margins of the panels; that of the first also where the key is.
FacePanels facePanels(const LoggedThrow& thrown,
                      const model::Target& target,
                      double ball_radius,
                      const std::string& whole,
                      const std::string& enlarged);

/// A step of 1, 2 or 5 times a power of ten that is not less than `least` > 0: for an axis.
double roundStep(double least);

}  // namespace fastball::launch
