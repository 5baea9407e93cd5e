#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include "model/release_motion.h"

namespace fastball::hand_server {

/// What the hand has learned of the time from its command to let go until the ball leaves, for each release mode: how far it
/// lies from what the plans say, as the mean over the throws made, with the plan's own word counting as one throw.
class ReleaseDelay {
 public:
  /// @param planned [s], from command to departure as the plan says; @param observed [s], as felt.
  void learn(model::ReleaseMode mode, double planned, double observed) {
    Learned& learned = of(mode);
    learned.sum += observed - planned;
    ++learned.throws;
  }
  /// [s], to be added to what a plan says.
  double correction(model::ReleaseMode mode) const {
    const Learned& learned = learned_[static_cast<std::size_t>(mode)];
    return learned.sum / (learned.throws + 1);
  }
  /// [s], by how much later (negative: earlier) than planned the command shall come for the ball to
  /// leave when planned; at most by `most` [s].
  double commandShift(model::ReleaseMode mode, double most) const {
    return std::clamp(-correction(mode), -most, most);
  }

 private:
  struct Learned {
    double sum = 0;  ///< [s]
    int throws = 0;
  };
  Learned& of(model::ReleaseMode mode) { return learned_[static_cast<std::size_t>(mode)]; }
  std::array<Learned, 3> learned_;  ///< as many as there are modes
};

}  // namespace fastball::hand_server
