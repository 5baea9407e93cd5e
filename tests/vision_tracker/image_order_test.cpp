#include "vision_tracker/image_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <opencv2/imgcodecs.hpp>

namespace fastball::vision_tracker {
namespace {

using Verdict = ImageOrder::Verdict;

ReceivedImage image(int camera, int64_t utime) {
  ReceivedImage made;
  made.camera = camera;
  made.utime = utime;
  return made;
}

std::vector<std::pair<int64_t, int>> drained(ImageOrder& order) {
  std::vector<std::pair<int64_t, int>> out;
  while (const auto next = order.next())
    out.emplace_back(next->utime, next->camera);
  return out;
}

TEST(ImageOrder, IsTheSameHoweverTheStreamsAreWoven) {
  const std::vector<std::pair<int64_t, int>> expected = {
      {10, 0}, {10, 1}, {20, 0}, {20, 1}, {30, 0}};
  ImageOrder woven(2), apart(2);
  for (const int64_t utime : {10, 20, 30}) {
    woven.push(image(0, utime));
    woven.push(image(1, utime));
  }
  for (const int camera : {1, 0})
    for (const int64_t utime : {10, 20, 30})
      apart.push(image(camera, utime));
  auto first = drained(woven), second = drained(apart);
  ASSERT_GE(first.size(), 5u);
  first.resize(5);
  second.resize(5);
  EXPECT_EQ(first, expected);
  EXPECT_EQ(second, expected);
}

TEST(ImageOrder, WaitsForTheOtherCamera) {
  ImageOrder order(2);
  order.push(image(0, 10));
  EXPECT_FALSE(order.next());
  order.push(image(1, 20));  // the image of time 10 was lost
  EXPECT_EQ(drained(order), (std::vector<std::pair<int64_t, int>>{{10, 0}}));
}

TEST(ImageOrder, DoesNotWaitForeverForACameraThatIsSilent) {
  ImageOrder order(2);
  for (int i = 0; i < 60; ++i)
    order.push(image(0, i));
  EXPECT_EQ(drained(order).size(), 60 - ImageOrder::kLongestQueue);
  EXPECT_EQ(order.push(image(1, 3)), Verdict::kBackwards);
}

TEST(ImageOrder, RefusesRepeatedAndLateImages) {
  ImageOrder order(2);
  EXPECT_EQ(order.push(image(0, 10)), Verdict::kAccepted);
  EXPECT_EQ(order.push(image(0, 10)), Verdict::kRepeated);
  ReceivedImage other = image(0, 10);
  other.data = {1};
  EXPECT_EQ(order.push(other), Verdict::kSameTime);
  EXPECT_EQ(order.push(image(0, 5)), Verdict::kBackwards);
  order.reset();
  EXPECT_EQ(order.push(image(0, 5)), Verdict::kAccepted);
}

ReceivedImage encoded() {
  ReceivedImage made = image(0, 1);
  made.width = 64;
  made.height = 48;
  cv::Mat picture(48, 64, CV_8U, cv::Scalar(77));
  cv::imencode(".jpg", picture, made.data);
  return made;
}

TEST(Decode, TakesJpegAndPlainGrey) {
  cv::Mat decoded;
  EXPECT_EQ(decode(encoded(), {64, 48}, decoded), "");
  EXPECT_EQ(decoded.at<uint8_t>(20, 20), 77);
  ReceivedImage plain = encoded();
  plain.jpeg = false;
  plain.row_stride = 70;
  plain.data.assign(std::size_t{70} * 48, 5);
  EXPECT_EQ(decode(plain, {64, 48}, decoded), "");
  EXPECT_EQ(decoded.at<uint8_t>(47, 63), 5);
}

TEST(Decode, SaysWhatIsWrong) {
  cv::Mat decoded;
  EXPECT_EQ(decode(encoded(), {640, 480}, decoded),
            "is 64 x 48 pixels, but its camera has 640 x 480");
  ReceivedImage cut = encoded();
  cut.data.resize(cut.data.size() / 2);
  EXPECT_NE(decode(cut, {64, 48}, decoded).find("no whole JPEG"), std::string::npos);
  ReceivedImage scrambled = encoded();
  for (std::size_t i = 2; i + 2 < scrambled.data.size(); ++i)
    scrambled.data[i] = static_cast<uint8_t>(i * 37);
  EXPECT_NE(decode(scrambled, {64, 48}, decoded), "");
  ReceivedImage other = encoded();
  other.width = 32;
  EXPECT_EQ(decode(other, {32, 48}, decoded),
            "decodes to 64 x 48 pixels, but its camera has 32 x 48");
  // It claims a gigabyte, which must not be tried.
  ReceivedImage huge = encoded();
  const std::vector<uint8_t> frame_header = {0xFF, 0xC0, 0x00, 0x0B, 0x08};
  const auto header =
      std::search(huge.data.begin(), huge.data.end(), frame_header.begin(), frame_header.end());
  ASSERT_NE(header, huge.data.end());
  std::fill(header + 5, header + 9, uint8_t{0x7F});
  EXPECT_EQ(decode(huge, {64, 48}, decoded),
            "decodes to 32639 x 32639 pixels, but its camera has 64 x 48");
  ReceivedImage empty = encoded();
  empty.data.clear();
  EXPECT_NE(decode(empty, {64, 48}, decoded), "");
}

}  // namespace
}  // namespace fastball::vision_tracker
