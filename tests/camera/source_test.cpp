// What the sources and the compression do by themselves.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdio>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/videoio.hpp>
#include <stdexcept>

#include "camera/device.h"
#include "camera/jpeg.h"
#include "camera/video_file.h"

namespace fastball::camera {
namespace {

using ::testing::HasSubstr;

template <class Act>
std::string sentence(Act act) {
  try {
    act();
  } catch (const std::exception& error) {
    return error.what();
  }
  return "no complaint";
}

cv::Mat noise(const cv::Size& size, int type, uint64_t seed) {
  cv::Mat image(size, type);
  cv::RNG(seed).fill(image, cv::RNG::UNIFORM, 0, 256);
  return image;
}

TEST(Jpeg, KeepsItsQualityWhereAnImageFits) {
  JpegEncoder encoder(90, 60000);
  const cv::Mat image(480, 640, CV_8U, cv::Scalar(80));
  const std::vector<uint8_t> bytes = encoder.encode(image);
  EXPECT_LE(bytes.size(), 60000u);
  EXPECT_EQ(encoder.quality(), 90);
  EXPECT_EQ(cv::imdecode(bytes, cv::IMREAD_UNCHANGED).type(), CV_8UC1);
}

TEST(Jpeg, LowersItsQualityForGoodWhereItMust) {
  JpegEncoder encoder(95, 60000);
  EXPECT_LE(encoder.encode(noise({320, 240}, CV_8UC1, 1)).size(), 60000u);
  const int lowered = encoder.quality();
  EXPECT_LT(lowered, 95);
  encoder.encode(cv::Mat(240, 320, CV_8UC1, cv::Scalar(9)));
  EXPECT_EQ(encoder.quality(), lowered);
}

TEST(Jpeg, SaysWhenAnImageFitsAtNoQuality) {
  JpegEncoder encoder(95, 60000);
  EXPECT_THAT(sentence([&] {
                encoder.encode(noise({2000, 1500}, CV_8UC3, 2));
              }),
              HasSubstr("2000 x 1500 pixels has"));
}

TEST(Device, TakesTheMiddleOfTheExposureFromTheDriversStamp) {
  // 3 ms ago the exposure of 10 ms began, says the driver.
  EXPECT_EQ(middleOfExposure(7'000'000, 7'003'000, 1'700'000'000'000'000, 0.010),
            1'700'000'000'000'000 - 3000 + 5000);
}

TEST(Device, TakesItsOwnClockWhereTheStampIsNone) {
  constexpr int64_t kWall = 1'700'000'000'000'000;
  // None at all, a stamp of another clock, one from the future, one too old.
  for (const int64_t stamp : {int64_t{0}, kWall, int64_t{7'003'001}, int64_t{6'000'000}})
    EXPECT_EQ(middleOfExposure(stamp, 7'003'000, kWall, 0.010), kWall - 5000) << stamp;
}

TEST(Device, SaysWhatCannotBeOpened) {
  const messaging::SystemClock clock;
  EXPECT_THAT(sentence([&] {
                Device({"/dev/null", {}, 0, 0}, clock);
              }),
              HasSubstr("/dev/null: cannot be opened as a V4L2 camera"));
}

class VideoFiles : public ::testing::Test {
 protected:
  VideoFiles() {
    cv::VideoWriter video(path_, cv::CAP_OPENCV_MJPEG, cv::VideoWriter::fourcc('M', 'J', 'P', 'G'),
                          50, {64, 48}, true);
    for (int k = 0; k < 5; ++k)
      video.write(cv::Mat(48, 64, CV_8UC3, cv::Scalar::all(40 * k)));
  }
  ~VideoFiles() override { std::remove(path_.c_str()); }
  std::string path_ =
      ::testing::TempDir() + "camera_source_test_" + std::to_string(getpid()) + ".avi";
};

TEST_F(VideoFiles, GiveTheirImagesAndEnd) {
  VideoFile video(path_, false);
  EXPECT_NEAR(video.rate(), 50, 1e-6);
  for (int k = 0; k < 5; ++k) {
    const auto image = video.next();
    ASSERT_TRUE(image);
    EXPECT_NEAR(image->pixels.at<cv::Vec3b>(20, 20)[1], 40 * k, 3);
    EXPECT_FALSE(image->utime);
  }
  EXPECT_FALSE(video.next());
}

TEST_F(VideoFiles, BeginAgain) {
  VideoFile video(path_, true);
  for (int k = 0; k < 12; ++k) {
    const auto image = video.next();
    ASSERT_TRUE(image);
    EXPECT_NEAR(image->pixels.at<cv::Vec3b>(20, 20)[1], 40 * (k % 5), 3);
  }
}

TEST_F(VideoFiles, AreNamedWhenTheyAreNone) {
  EXPECT_THAT(sentence([] { VideoFile("/nonexistent.avi", false); }),
              HasSubstr("/nonexistent.avi: cannot be read as a video"));
  std::ofstream(path_) << "no video";
  EXPECT_THAT(sentence([&] { VideoFile(path_, false); }), HasSubstr("cannot be read as a video"));
}

}  // namespace
}  // namespace fastball::camera
