#include "camera/capture.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/camera/fake_source.h"

namespace fastball::camera {
namespace {

using testing::FakeSource;
using testing::waitFor;

/// The grey values of all images until the source has ended.
std::vector<int> all(Capture& capture) {
  std::vector<int> greys;
  EXPECT_TRUE(waitFor([&] {
    while (const auto image = capture.take())
      greys.push_back(image->pixels.at<uint8_t>(0, 0));
    return capture.ended();
  }));
  return greys;
}

TEST(Capture, HandsOverEveryImageInOrder) {
  FakeSource fake;
  fake.images = testing::greyImages(100);
  Capture capture(fake.opener(), Capture::WhenFull::kWait);
  const std::vector<int> greys = all(capture);
  ASSERT_EQ(greys.size(), 100u);
  for (int k = 0; k < 100; ++k)
    EXPECT_EQ(greys[static_cast<std::size_t>(k)], k);
  EXPECT_EQ(capture.dropped(), 0);
  EXPECT_EQ(capture.rate(), 100);
}

TEST(Capture, DropsTheOldestOfADevice) {
  FakeSource fake;
  fake.images = testing::greyImages(100);
  fake.then = FakeSource::Then::kHang;
  Capture capture(fake.opener(), Capture::WhenFull::kDropOldest);
  constexpr auto kKept = static_cast<int64_t>(Capture::kLongestQueue);
  ASSERT_TRUE(waitFor([&] { return capture.dropped() == 100 - kKept; }));
  EXPECT_EQ(capture.take()->frame, 100 - kKept);
  EXPECT_FALSE(capture.ended());
  *fake.released = true;
  EXPECT_EQ(all(capture).size(), Capture::kLongestQueue - 1);
}

TEST(Capture, ThrowsWhatTheSourceThrewAfterItsImages) {
  FakeSource fake;
  fake.images = testing::greyImages(2);
  fake.then = FakeSource::Then::kFail;
  Capture capture(fake.opener(), Capture::WhenFull::kWait);
  int images = 0;
  EXPECT_THROW(waitFor([&] {
                 images += capture.take() ? 1 : 0;
                 return false;
               }),
               std::runtime_error);
  EXPECT_EQ(images, 2);
  EXPECT_FALSE(capture.ended());
  fake.open_failure = "it is busy";
  Capture unopened(fake.opener(), Capture::WhenFull::kWait);
  EXPECT_THROW(waitFor([&] { return unopened.take().has_value(); }), std::runtime_error);
}

TEST(Capture, DoesNotWaitForADeviceThatHangs) {
  FakeSource fake;
  fake.then = FakeSource::Then::kHang;
  {
    Capture capture(fake.opener(), Capture::WhenFull::kWait);
    EXPECT_FALSE(capture.take());
  }  // would not return
  EXPECT_FALSE(*fake.released);
  *fake.released = true;
}

TEST(Capture, EndsAReaderThatWaitsForRoom) {
  FakeSource fake;
  fake.images = testing::greyImages(100);
  const std::weak_ptr<std::atomic<bool>> held = fake.released;
  {
    Capture capture(fake.opener(), Capture::WhenFull::kWait);
    ASSERT_TRUE(waitFor([&] { return capture.take().has_value(); }));
  }
  fake = {};
  EXPECT_TRUE(waitFor([&] { return held.expired(); })) << "the source has not been closed";
}

}  // namespace
}  // namespace fastball::camera
