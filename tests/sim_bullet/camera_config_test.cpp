#include "sim_bullet/camera_config.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "config/strict_yaml.h"

namespace fastball::sim_bullet {
namespace {

using ::testing::HasSubstr;

constexpr const char* kExperiment = FASTBALL_SOURCE_DIR "/config/experiment.yaml";

/// The default experiment with the first `from` replaced by `to`; what reading its cameras says.
std::string complaint(const std::string& from, const std::string& to) {
  std::ifstream file(kExperiment);
  std::stringstream text;
  text << file.rdbuf();
  std::string changed = text.str();
  const std::size_t place = changed.find(from, changed.find("\ncameras:"));
  if (place == std::string::npos)
    return "the default experiment has no '" + from + "'";
  changed.replace(place, from.size(), to);
  const std::string path = ::testing::TempDir() + "camera_config_test_" +
                           ::testing::UnitTest::GetInstance()->current_test_info()->name() +
                           ".yaml";
  std::ofstream(path) << changed;
  try {
    readCameraRig(path);
  } catch (const config::ConfigError& error) {
    return error.what();
  }
  return "no complaint";
}

TEST(CameraConfig, ReadsTheDefault) {
  const CameraRigOptions options = readCameraRig(kExperiment);
  ASSERT_EQ(options.cameras.size(), 2u);
  EXPECT_EQ(options.cameras[0].channel, "CAMERA_LEFT");
  EXPECT_EQ(options.cameras[1].channel, "CAMERA_RIGHT");
  EXPECT_NEAR(options.to_light_W.norm(), 1, 1e-12);
  for (const RigCamera& rig : options.cameras) {
    const Eigen::Matrix3d& R = rig.camera.R_CW;
    EXPECT_LT((R * R.transpose() - Eigen::Matrix3d::Identity()).norm(), 1e-12);
    EXPECT_NEAR(R.determinant(), 1, 1e-12);
    EXPECT_LT(R(1, 2), -0.9) << "y points down";
  }
}

TEST(CameraConfig, LooksAtThePoint) {
  model::Camera camera;
  camera.fx = camera.fy = 500;
  camera.cx = 100;
  camera.cy = 50;
  lookAt({1, -4, 2}, {2, 0, 0}, camera);
  EXPECT_LT((camera.project({2, 0, 0}) - Eigen::Vector2d(100, 50)).norm(), 1e-9);
  EXPECT_LT(camera.project({2, 0, 0.1}).y(), 50) << "up is up";
  EXPECT_GT(camera.project({2.1, 0, 0}).x(), 100)
      << "x lies to the right, seen from the right side of the robot";
  EXPECT_THROW(lookAt({1, 1, 1}, {1, 1, 3}, camera), std::invalid_argument);
}

TEST(CameraConfig, NamesWhatIsWrong) {
  EXPECT_THAT(complaint("rate: 240", "rate: -240"), HasSubstr("rate"));
  EXPECT_THAT(complaint("exposure: 0.001", "exposure: 0.1"), HasSubstr("exposure"));
  EXPECT_THAT(complaint("channel: CAMERA_RIGHT", "channel: CAMERA_LEFT"), HasSubstr("two cameras"));
  EXPECT_THAT(complaint("channel: CAMERA_RIGHT", "channel: CAMERA_TOP"), HasSubstr("channel"));
  EXPECT_THAT(complaint("look_at: [1.45, 0.0, 0.3]", "look_at: [0.3, -5.7, 1.0]"),
              HasSubstr("look_at"));
  EXPECT_THAT(complaint("blur: 0.6", "blurr: 0.6"), HasSubstr("blur"));
}

}  // namespace
}  // namespace fastball::sim_bullet
