#pragma once

#include <memory>
#include <optional>

#include "camera/image_source.h"

namespace fastball::camera {

/// Reads a source on a thread of its own, so that nobody has to wait for a device that hangs. What
/// it gives may be asked for from any thread.
class Capture {
 public:
  /// What happens when images come faster than they are taken.
  enum class WhenFull { kWait, kDropOldest };

  /// Opens the source on that thread. What `open` refers to must live as long as the process, for
  /// the thread may be left behind.
  Capture(const OpenSource& open, WhenFull when_full);
  /// Waits for the thread for a fifth of a second; one that hangs in its device is left behind and ends with the process.
  ~Capture();
  Capture(const Capture&) = delete;
  Capture& operator=(const Capture&) = delete;

  /// The oldest image that waits, or nothing. Does not block.
  /// @throw what opening or reading the source threw, once the images before that have been taken;
  ///   again with every call
  std::optional<SourceImage> take();
  /// The source had an end, and all images have been taken.
  bool ended() const;
  /// [Hz] as the source tells it, 0 if it does not or is not open yet.
  double rate() const;
  /// Images that nobody took in time.
  int64_t dropped() const;

  static constexpr std::size_t kLongestQueue = 16;  ///< images that wait

 private:
  struct Shared;
  static void read(const std::shared_ptr<Shared>& shared, const OpenSource& open);
  std::shared_ptr<Shared> shared_;
};

}  // namespace fastball::camera
