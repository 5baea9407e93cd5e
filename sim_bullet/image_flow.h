#pragma once

#include <cstdint>
#include <deque>
#include <string>
#include <vector>

#include "messaging/channels.h"
#include "messaging/clock.h"
#include "messaging/endpoint.h"

namespace fastball::sim_bullet {

/// Images on their way to a tracker, which answers each with BALL_OBSERVATION. In lockstep one image of each camera is under
/// way at a time, and is said again while its answer is missing: what a tracker sees depends neither on the speed of the
/// machine nor on the network. Where no tracker has been heard, images are said as they come.
class ImageFlow {
 public:
  /// @param lockstep false: images are said as they come, whoever hears them.
  /// @throw std::invalid_argument if one of `channels` is none of CAMERA_LEFT and CAMERA_RIGHT.
  ImageFlow(messaging::Endpoint& endpoint,
            const messaging::Clock& clock,
            const std::vector<std::string>& channels,
            bool lockstep);

  /// Forgets what has not been said.
  void beginScene();
  /// Takes the next image of a camera, in order of time.
  void add(std::size_t camera, image_t message);
  /// Says what may be said now, and again what waits for its answer for too long.
  void say();
  /// Says all that is left, whether or not it is answered.
  void sayRest();
  /// So many images wait that the scene must not go on.
  bool behind() const;
  /// Nothing waits, neither to be said nor for its answer.
  bool empty() const;

 private:
  struct Stream {
    std::string channel;
    messaging::Publisher<image_t> images;
    std::deque<image_t> queue;  ///< the first of them is under way, if any is
    bool under_way = false;
    int64_t first_said_us = 0, said_us = 0;  ///< monotonic, of the one under way
    bool heard = true;                       ///< false: nobody answered it; until somebody does
  };

  void hear(const ball_observation_t& answer);
  void say(Stream& stream);
  static void sayRest(Stream& stream);
  bool paced(const Stream& stream) const { return lockstep_ && tracker_ && stream.heard; }

  const messaging::Clock& clock_;
  bool lockstep_;
  bool tracker_ = false;  ///< has been heard, and has not ended
  std::vector<Stream> streams_;
};

}  // namespace fastball::sim_bullet
