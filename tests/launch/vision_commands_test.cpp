// `fastball track` and `fastball calibrate` as a user meets them: files out, and one sentence for bad input.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>
#include <string>

#include "config/calibration_file.h"
#include "messaging/image_channel.h"
#include "messaging/lcm_endpoint.h"
#include "sim_bullet/camera_config.h"
#include "tests/messaging/child_process.h"
#include "tests/vision_tracker/drawn_board.h"

namespace fastball::launch {
namespace {

using ::testing::HasSubstr;

struct Outcome {
  int status = -1;
  std::string text;
};

/// A board before two cameras, which stand where `pose` says that the world is.
class Board {
 public:
  Board() {
    for (const int i : {0, 1}) {
      model::Camera camera;
      camera.width = 640;
      camera.height = 480;
      camera.fx = camera.fy = 700;
      camera.cx = 320;
      camera.cy = 240;
      sim_bullet::lookAt({-0.2 + 0.4 * i, -0.7, 0}, {0, 0, 0}, camera);
      cameras_.push_back(camera);
      rays_.push_back(::fastball::testing::DrawnBoard::raysOf(camera));
    }
  }
  static std::string name(std::size_t camera) { return camera == 0 ? "CAMERA_A" : "CAMERA_B"; }
  static std::string flags() { return " --square 0.04 --marker 0.03 "; }
  cv::Mat view(std::size_t camera, int k) const {
    const model::Camera& c = cameras_[camera];
    return drawn_.picture(rays_[camera], c.R_CW * R(k), c.toCamera(p(k)));
  }
  image_t message(std::size_t camera, int k) const {
    image_t m{};
    m.width = m.row_stride = 640;
    m.height = 480;
    m.pixelformat = image_t::MJPEG;
    cv::imencode(".jpg", view(camera, k), m.data, {cv::IMWRITE_JPEG_QUALITY, 80});
    m.size = static_cast<int32_t>(m.data.size());
    return m;
  }
  std::string pose(int k) const {
    const Eigen::Vector3d angles = R(k).eulerAngles(2, 1, 0);
    return fmt::format("{} {} {} {} {} {}", p(k).x(), p(k).y(), p(k).z(), angles[2], angles[1],
                       angles[0]);
  }
  /// @param world view that is the world; -1: what pose() said
  void expectCalibrated(const std::string& folder, int world = -1) const {
    for (const std::size_t camera : {0U, 1U}) {
      const model::Camera found =
          config::readCalibration(folder + "/" + name(camera) + ".yaml").at(0);
      const model::Camera& truth = cameras_[camera];
      EXPECT_NEAR(found.fx, truth.fx, 7);
      Eigen::Vector3d p_W(0.05, -0.05, 0.03);
      const Eigen::Vector2d pixel = truth.project(p_W);
      if (world >= 0)
        p_W = R(world).transpose() * (p_W - p(world));
      EXPECT_LT((found.project(p_W) - pixel).norm(), 1.5) << name(camera);
    }
  }

 private:
  Eigen::Matrix3d R(int k) const {
    const Eigen::Matrix3d facing = (Eigen::Matrix3d() << 1, 0, 0, 0, 0, 1, 0, -1, 0).finished();
    const Eigen::Vector3d axis(std::cos(1.3 * k), std::sin(1.3 * k), 0.3);
    return facing * Eigen::AngleAxisd(0.45, axis.normalized()).toRotationMatrix();
  }
  Eigen::Vector3d p(int k) const {
    return drawn_.origin(R(k), {0.1 * (k % 3 - 1), -0.12 + 0.02 * k, 0.07 * (k / 3 % 3 - 1)});
  }

  ::fastball::testing::DrawnBoard drawn_{{8, 6, 0.04, 0.03, "5X5_100"}};
  std::vector<model::Camera> cameras_;
  std::vector<cv::Mat> rays_;
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
  std::string folder_ = ::testing::TempDir() + "vision_commands_test_" + std::to_string(getpid());
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

TEST_F(VisionCommands, TrackTakesOneCalibrationFileForEachVideo) {
  for (const char* name : {"a", "b"}) {
    model::Camera camera;
    camera.width = 320;
    camera.height = 240;
    camera.fx = camera.fy = 500;
    camera.cx = 160;
    camera.cy = 120;
    config::writeCalibration(folder_ + "/" + name + ".yaml", {camera});
  }
  const std::string both = " --calib " + folder_ + "/a.yaml --calib " + folder_ + "/b.yaml ";
  const Outcome two =
      run("track " + both + video() + " " + video() + " --radius 9 -o " + folder_ + "/two");
  EXPECT_EQ(two.status, 0) << two.text;
  EXPECT_THAT(two.text, HasSubstr("no flight: the calibration has no pose"));
  EXPECT_TRUE(std::filesystem::exists(folder_ + "/two/track2.csv"));
  const Outcome one = run("track" + both + video() + " -o " + folder_);
  EXPECT_EQ(one.status, 2);
  EXPECT_THAT(one.text, HasSubstr("2 cameras, but there are 1 videos"));
}

TEST_F(VisionCommands, CalibrateTakesAFolderForEachCamera) {
  Board board;
  for (const std::size_t camera : {0U, 1U}) {
    const std::string images = folder_ + "/" + board.name(camera);
    std::filesystem::create_directories(images);
    for (int k = 0; k < 10; ++k)
      cv::imwrite(images + "/" + std::to_string(k) + ".png", board.view(camera, k));
  }
  const Outcome outcome =
      run("calibrate " + folder_ + "/CAMERA_A " + folder_ + "/CAMERA_B/" + board.flags() +
          " --world 3.png --board-pose " + board.pose(3) + " -o " + folder_ + "/rig");
  ASSERT_EQ(outcome.status, 0) << outcome.text;
  EXPECT_THAT(outcome.text, HasSubstr("CAMERA_B: 10 of 10 images"));
  EXPECT_THAT(outcome.text, HasSubstr("the cameras to each other"));
  board.expectCalibrated(folder_ + "/rig");
  EXPECT_EQ(cv::imread(folder_ + "/rig/CAMERA_B-residuals.png").size(), cv::Size(640, 480));
  EXPECT_EQ(config::readCalibration(folder_ + "/rig/calibration.yaml").size(), 2u);
  const Outcome mixed =
      run("calibrate " + folder_ + "/CAMERA_A " + video() + board.flags() + " -o " + folder_);
  EXPECT_EQ(mixed.status, 2);
  EXPECT_THAT(mixed.text, HasSubstr("a folder for each camera, not both"));
  const Outcome twice = run("calibrate " + folder_ + "/CAMERA_A " + folder_ + "/CAMERA_A" +
                            board.flags() + " -o " + folder_);
  EXPECT_EQ(twice.status, 2);
  EXPECT_THAT(twice.text, HasSubstr("there are two cameras 'CAMERA_A'"));
}

/// This test is the cameras.
TEST_F(VisionCommands, CalibrateCollectsViewsFromRunningCameras) {
  Board board;
  messaging::LcmEndpoint cameras(messaging::defaultLcmUrl());
  messaging::ChildProcess command({"/bin/sh", "-c",
                                   FASTBALL_BIN_DIR
                                       "/fastball calibrate --channel CAMERA_A --channel CAMERA_B "
                                       "--views 8" +
                                       board.flags() + " -o " + folder_ + "/live"});
  ASSERT_TRUE(command.waitForOutput("hold the board still"));
  int64_t frame = 0;
  for (int k = 0; k < 8; ++k) {
    std::vector<image_t> shown;
    for (const std::size_t camera : {0U, 1U})
      shown.push_back(board.message(camera, k));
    const std::string taken = "CAMERA_B: " + std::to_string(k + 1) + " of 8 views";
    // Until it has seen the board lie still.
    for (int i = 0; i < 1000 && command.output().find(taken) == std::string::npos; ++i) {
      for (const std::size_t camera : {0U, 1U}) {
        shown[camera].utime = shown[camera].seq = frame++;
        cameras.publish(messaging::imageChannel(board.name(camera).c_str()), shown[camera]);
      }
      command.waitForOutput(taken, 50);
    }
  }
  EXPECT_EQ(command.wait(), 0) << command.output();
  board.expectCalibrated(folder_ + "/live", 0);
  EXPECT_TRUE(std::filesystem::exists(folder_ + "/live/CAMERA_A/view008.png"));
}

TEST_F(VisionCommands, CalibrateEndsWithTheViewsThereAreOnCtrlC) {
  messaging::LcmEndpoint cameras(messaging::defaultLcmUrl());
  Board board;
  messaging::ChildProcess command(
      std::vector<std::string>{FASTBALL_BIN_DIR "/fastball", "calibrate", "--channel", "CAMERA_A",
                               "--square", "0.04", "--marker", "0.03", "-o", folder_ + "/few"});
  ASSERT_TRUE(command.waitForOutput("hold the board still"));
  EXPECT_EQ(command.stop(SIGINT), 2);
  EXPECT_THAT(command.output(), HasSubstr("CAMERA_A: only 0 of 0 images show"));
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
