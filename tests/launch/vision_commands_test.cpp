// `fastball track` and `fastball calibrate` as a user meets them: files out, and one sentence for bad input.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>
#include <string>

namespace fastball::launch {
namespace {

using ::testing::HasSubstr;

struct Outcome {
  int status = -1;
  std::string text;
};

class VisionCommands : public ::testing::Test {
 protected:
  VisionCommands() { std::filesystem::create_directories(folder_); }
  ~VisionCommands() override { std::filesystem::remove_all(folder_); }

  static Outcome run(const std::string& arguments) {
    Outcome outcome;
    FILE* pipe = popen((FASTBALL_BIN_DIR "/fastball " + arguments + " 2>&1").c_str(), "r");
    char buffer[512];
    while (pipe != nullptr && fgets(buffer, sizeof buffer, pipe) != nullptr)
      outcome.text += buffer;
    outcome.status = WEXITSTATUS(pclose(pipe));
    return outcome;
  }
  std::string video() const {
    const std::string path = folder_ + "/ball.avi";
    cv::VideoWriter writer(path, cv::CAP_OPENCV_MJPEG, cv::VideoWriter::fourcc('M', 'J', 'P', 'G'),
                           60, {320, 240}, true);
    for (int k = 0; k < 40; ++k) {
      cv::Mat frame(240, 320, CV_8UC3, cv::Scalar(60, 90, 70));
      if (k > 8)
        cv::circle(frame, {10 + 9 * (k - 8), 200 - 12 * (k - 8) + (k - 8) * (k - 8) / 2}, 9,
                   {220, 220, 220}, cv::FILLED, cv::LINE_AA);
      writer.write(frame);
    }
    return path;
  }
  std::string folder_ = ::testing::TempDir() + "vision_commands_test";
};

TEST_F(VisionCommands, TrackWritesTableAndPicture) {
  const Outcome outcome = run("track " + video() + " --radius 9 -o " + folder_ + "/out");
  EXPECT_EQ(outcome.status, 0) << outcome.text;
  std::ifstream table(folder_ + "/out/track1.csv");
  std::string line;
  int lines = 0;
  while (std::getline(table, line))
    ++lines;
  EXPECT_GT(lines, 20);
  EXPECT_EQ(cv::imread(folder_ + "/out/track1.png").size(), cv::Size(320, 240));
}

TEST_F(VisionCommands, TrackRefusesBadInputInOneSentence) {
  const Outcome radius = run("track " + video() + " -o " + folder_);
  EXPECT_EQ(radius.status, 2);
  EXPECT_THAT(radius.text, HasSubstr("--radius"));
  const Outcome missing = run("track /nonexistent.avi --radius 9 -o " + folder_);
  EXPECT_EQ(missing.status, 2);
  EXPECT_EQ(missing.text, "fastball: /nonexistent.avi: cannot be read as a video\n");
  const Outcome calibration = run("track " + video() + " --calib /nonexistent.yaml -o " + folder_);
  EXPECT_EQ(calibration.status, 2);
  EXPECT_EQ(calibration.text, "fastball: /nonexistent.yaml: cannot be read\n");
}

TEST_F(VisionCommands, CalibrateRefusesTooFewImages) {
  const std::string image = folder_ + "/grey.png";
  cv::imwrite(image, cv::Mat(240, 320, CV_8U, cv::Scalar(80)));
  const Outcome few = run("calibrate " + image + " --square 0.04 --marker 0.03 -o " + folder_);
  EXPECT_EQ(few.status, 2);
  EXPECT_THAT(few.text, HasSubstr("only 0 of 1 images show"));
  const Outcome missing =
      run("calibrate /nonexistent.png --square 0.04 --marker 0.03 -o " + folder_);
  EXPECT_EQ(missing.status, 2);
  EXPECT_EQ(missing.text, "fastball: /nonexistent.png: cannot be read as an image\n");
}

}  // namespace
}  // namespace fastball::launch
