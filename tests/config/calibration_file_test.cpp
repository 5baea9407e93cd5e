#include "config/calibration_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdio>
#include <fstream>
#include <stdexcept>

#include "sim_bullet/camera_config.h"
#include "tests/vision_tracker/experiment_path.h"

namespace fastball::config {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

class Calibration : public ::testing::Test {
 protected:
  ~Calibration() override { std::remove(path_.c_str()); }
  void write(const std::string& text) const { std::ofstream(path_) << "%YAML:1.0\n---\n" << text; }
  std::string refusal() const {
    try {
      readCalibration(path_);
    } catch (const std::invalid_argument& e) {
      return e.what();
    }
    return "accepted";
  }
  std::string path_ =
      ::testing::TempDir() + "calibration_test_" + std::to_string(getpid()) + ".yaml";
  std::string sound_ =
      "image_width: 640\nimage_height: 480\ncamera_matrix: [900, 0, 320, 0, 901, 240, 0, 0, 1]\n"
      "distortion_coefficients: [-0.1, 0.02, 0.001, 0.002]\n";
};

TEST_F(Calibration, ReadsWhatItWrote) {
  std::vector<model::Camera> cameras;
  for (const sim_bullet::RigCamera& c :
       sim_bullet::readCameraRig(::fastball::testing::experimentPath()).cameras)
    cameras.push_back(c.camera);
  writeCalibration(path_, cameras);
  const std::vector<model::Camera> read = readCalibration(path_);
  ASSERT_EQ(read.size(), cameras.size());
  for (std::size_t i = 0; i < read.size(); ++i) {
    EXPECT_EQ(read[i].width, cameras[i].width);
    EXPECT_EQ(read[i].distortion, cameras[i].distortion);
    const Eigen::Vector3d p_W(1, 0.2, 0.3);
    EXPECT_LT((read[i].project(p_W) - cameras[i].project(p_W)).norm(), 1e-9);
  }
}

TEST_F(Calibration, ReadsOneCameraAsOpenCvsSamplesWriteIt) {
  write(
      "image_width: 640\nimage_height: 480\n"
      "camera_matrix: !!opencv-matrix\n   rows: 3\n   cols: 3\n   dt: d\n"
      "   data: [ 900., 0., 320., 0., 901., 240., 0., 0., 1. ]\n"
      "distortion_coefficients: !!opencv-matrix\n   rows: 5\n   cols: 1\n   dt: d\n"
      "   data: [ -0.1, 0.02, 0.001, 0.002, 0.003 ]\n"
      "R: [0.0, 0.0, 1.5707963267948966]\nT: [1.0, 2.0, 3.0]\n");
  const std::vector<model::Camera> cameras = readCalibration(path_);
  ASSERT_EQ(cameras.size(), 1u);
  EXPECT_EQ(cameras[0].fy, 901);
  EXPECT_EQ(cameras[0].distortion[4], 0.003);
  EXPECT_LT((cameras[0].toCamera({1, 0, 0}) - Eigen::Vector3d(1, 3, 3)).norm(), 1e-12);
}

TEST_F(Calibration, AWorldThatIsNotToldIsTheCamerasOwn) {
  write(sound_);
  EXPECT_EQ(readCalibration(path_)[0].toCamera({1, 2, 3}), Eigen::Vector3d(1, 2, 3));
}

TEST_F(Calibration, NamesFileAndKeyOfWhatItRefuses) {
  EXPECT_THAT(refusal(), AllOf(HasSubstr(path_), HasSubstr("cannot be read")));
  write("camera_matrix: [1");
  EXPECT_THAT(refusal(), HasSubstr(path_));
  write("image_width: 640\n");
  EXPECT_THAT(refusal(), HasSubstr("'image_height' is missing"));
  write(sound_ + "R: [2, 0, 0, 0, 1, 0, 0, 0, 1]\nT: [0, 0, 0]\n");
  EXPECT_THAT(refusal(), HasSubstr("'R' is no rotation"));
  write(sound_ + "R: [1, 0, 0, 0, 1, 0, 0, 0, 1]\n");
  EXPECT_THAT(refusal(), HasSubstr("'T' is missing"));
  write("image_width: 640\nimage_height: 480\ncamera_matrix: [0, 0, 320, 0, 901, 240, 0, 0, 1]\n");
  EXPECT_THAT(refusal(), HasSubstr("focal lengths 0 and 901 px"));
  write("image_width: 640\nimage_height: 480\ncamera_matrix: [9, 0, .nan, 0, 9, 240, 0, 0, 1]\n");
  EXPECT_THAT(refusal(), HasSubstr("'camera_matrix' holds a number that is not finite"));
  write("image_width: 6.5\n");
  EXPECT_THAT(refusal(), HasSubstr("'image_width' must be a whole number"));
  write("cameras: []\n");
  EXPECT_THAT(refusal(), HasSubstr("one to 4 cameras"));
}

}  // namespace
}  // namespace fastball::config
