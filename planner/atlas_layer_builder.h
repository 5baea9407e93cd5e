#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "planner/atlas.h"

namespace fastball::planner {

/// Makes throws of one kind from one family of starts, to targets straight ahead. Places: distance and height [m] of the target.
class ThrowSource {
 public:
  virtual ~ThrowSource() = default;
  virtual ThrowKind kind() const = 0;
  /// A throw from the family's start.
  virtual std::optional<AtlasThrow> first(const Eigen::Vector2d& place) const = 0;
  /// A throw from one to a target nearby, whose ball is taken to depart as that one's does.
  /// @param beyond the limits may be exceeded a little: not a throw, but where to begin for one that lies before it.
  virtual std::optional<AtlasThrow> next(const Eigen::Vector2d& place,
                                         const AtlasThrow& near,
                                         bool beyond) const = 0;
  /// The throw brought closer to the mean of its neighbours, so that what lies between nodes can be interpolated; nothing
  /// if it is best as it is.
  virtual std::optional<AtlasThrow> smoothed(const Eigen::Vector2d& place,
                                             const AtlasThrow& own,
                                             const AtlasVector& mean) const = 0;
  /// The throw with the departure of its own ball, and whether it is inside the limits; nothing if the ball does not come there.
  virtual std::optional<AtlasThrow> finished(const Eigen::Vector2d& place,
                                             const AtlasThrow& found) const = 0;
};

/// The layer of a source.
/// @param wanted whether a throw to a node is of use.
/// @param progress told now and then which share of the work is done, about.
AtlasLayer buildLayer(const AtlasGrid& grid,
                      const ThrowSource& source,
                      const std::vector<bool>& wanted,
                      const std::function<void(double)>& progress);

}  // namespace fastball::planner
