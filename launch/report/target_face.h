#pragma once

#include <Eigen/Core>
#include <string>

#include "lcmtypes/fastball_types.h"

namespace fastball::launch {

/// Outline [mm] of the region of the target plane that holds the landing with 95 % probability by its covariance, for gnuplot.
std::string ellipse95(const landing_t& landing);

/// Half the widths [m] of that region's upright box.
Eigen::Vector2d extent95(const landing_t& landing);

}  // namespace fastball::launch
