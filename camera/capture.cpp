#include "camera/capture.h"

#include <chrono>
#include <condition_variable>
#include <deque>
#include <exception>
#include <mutex>
#include <thread>
#include <utility>

namespace fastball::camera {
namespace {

constexpr auto kPatience = std::chrono::milliseconds(200);

}  // namespace

/// What both threads use; lives as long as the longer of them.
struct Capture::Shared {
  std::mutex mutex;
  std::condition_variable changed;
  std::deque<SourceImage> queue;
  WhenFull when_full = WhenFull::kWait;
  double rate = 0;
  int64_t dropped = 0;
  bool stop = false;
  bool done = false;  ///< the thread reads no more
  std::exception_ptr failure;

  /// @return false when the reader shall end
  bool add(SourceImage image) {
    std::unique_lock lock(mutex);
    if (when_full == WhenFull::kWait)
      changed.wait(lock, [this] { return stop || queue.size() < kLongestQueue; });
    if (queue.size() >= kLongestQueue) {
      queue.pop_front();
      ++dropped;
    }
    queue.push_back(std::move(image));
    return !stop;
  }
};

Capture::Capture(const OpenSource& open, WhenFull when_full) : shared_(std::make_shared<Shared>()) {
  shared_->when_full = when_full;
  std::thread(read, shared_, open).detach();
}

Capture::~Capture() {
  std::unique_lock lock(shared_->mutex);
  shared_->stop = true;
  shared_->changed.notify_all();
  shared_->changed.wait_for(lock, kPatience, [this] { return shared_->done; });
}

void Capture::read(const std::shared_ptr<Shared>& shared, const OpenSource& open) {
  std::exception_ptr failure;
  try {
    const std::unique_ptr<ImageSource> source = open();
    {
      const std::lock_guard lock(shared->mutex);
      shared->rate = source->rate();
    }
    int64_t frame = 0;
    while (std::optional<SourceImage> image = source->next()) {
      // A device may use its memory again for the next image.
      image->pixels = image->pixels.clone();
      image->frame = frame++;
      if (!shared->add(std::move(*image)))
        break;
    }
  } catch (...) {
    failure = std::current_exception();
  }
  const std::lock_guard lock(shared->mutex);
  shared->failure = failure;
  shared->done = true;
  shared->changed.notify_all();
}

std::optional<SourceImage> Capture::take() {
  const std::lock_guard lock(shared_->mutex);
  if (shared_->queue.empty()) {
    if (shared_->failure)
      std::rethrow_exception(shared_->failure);
    return std::nullopt;
  }
  SourceImage image = std::move(shared_->queue.front());
  shared_->queue.pop_front();
  shared_->changed.notify_all();
  return image;
}

bool Capture::ended() const {
  const std::lock_guard lock(shared_->mutex);
  return shared_->done && shared_->queue.empty() && !shared_->failure;
}

double Capture::rate() const {
  const std::lock_guard lock(shared_->mutex);
  return shared_->rate;
}

int64_t Capture::dropped() const {
  const std::lock_guard lock(shared_->mutex);
  return shared_->dropped;
}

}  // namespace fastball::camera
