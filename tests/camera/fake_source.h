#pragma once

#include <atomic>
#include <chrono>
#include <memory>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "camera/image_source.h"

namespace fastball::testing {

/// A source as a test wants it: some images, and then an end, an error, or nothing any more.
struct FakeSource {
  enum class Then { kEnd, kFail, kHang };

  std::vector<camera::SourceImage> images;
  Then then = Then::kEnd;
  double rate = 100;
  std::string open_failure;  ///< if not empty
  /// What hangs does so until this is set, at the latest when the test has ended.
  std::shared_ptr<std::atomic<bool>> released = std::make_shared<std::atomic<bool>>(false);

  camera::OpenSource opener() const;

 private:
  class Source;
};

class FakeSource::Source : public camera::ImageSource {
 public:
  explicit Source(FakeSource fake) : fake_(std::move(fake)) {}
  std::optional<camera::SourceImage> next() override {
    if (next_ < fake_.images.size())
      return fake_.images[next_++];
    if (fake_.then == Then::kFail)
      throw std::runtime_error("the plug was pulled");
    while (fake_.then == Then::kHang && !*fake_.released)
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    return std::nullopt;
  }
  double rate() const override { return fake_.rate; }

 private:
  FakeSource fake_;
  std::size_t next_ = 0;
};

inline camera::OpenSource FakeSource::opener() const {
  return [fake = *this]() -> std::unique_ptr<camera::ImageSource> {
    if (!fake.open_failure.empty())
      throw std::runtime_error(fake.open_failure);
    return std::make_unique<Source>(fake);
  };
}

/// `count` images of one size; image k is of grey value k.
inline std::vector<camera::SourceImage> greyImages(int count,
                                                   const cv::Size& size = {64, 48},
                                                   int type = CV_8UC1) {
  std::vector<camera::SourceImage> images(static_cast<std::size_t>(count));
  for (int k = 0; k < count; ++k)
    images[static_cast<std::size_t>(k)].pixels = cv::Mat(size, type, cv::Scalar::all(k));
  return images;
}

/// Until `done()`, looking every millisecond. @return false after 20 s
template <class Done>
bool waitFor(Done done) {
  for (int i = 0; i < 20000; ++i) {
    if (done())
      return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return false;
}

}  // namespace fastball::testing
