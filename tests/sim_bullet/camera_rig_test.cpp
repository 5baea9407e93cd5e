#include "sim_bullet/camera_rig.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgcodecs.hpp>

#include "config/experiment.h"

namespace fastball::sim_bullet {
namespace {

constexpr const char* kExperiment = FASTBALL_SOURCE_DIR "/config/experiment.yaml";
constexpr int64_t kStart = 20000000;  // [us]

class CameraRigTest : public ::testing::Test {
 protected:
  std::unique_ptr<CameraRig> rig(int workers) {
    CameraRigOptions options = readCameraRig(kExperiment);
    options.workers = workers;
    return std::make_unique<CameraRig>(options, experiment_.arm, experiment_.hand,
                                       experiment_.ball.radius);
  }

  /// The ball flies 6 m/s past an arm that swings.
  SceneSnapshot at(int64_t utime) const {
    const double t = static_cast<double>(utime - kStart) * 1e-6;
    SceneSnapshot s;
    s.utime = utime;
    s.p_WBall = {0.5 + 6 * t, 0.05, 0.3 - 4.9 * t * t};
    s.q_arm = {0.2, 0.8 + t, 0, 0.5 - 3 * t};
    return s;
  }

  std::vector<RenderedImage> draw(CameraRig& cameras, int64_t seed, int milliseconds = 100) {
    cameras.begin(3, seed, kStart, kStart + int64_t{1000} * milliseconds, experiment_.target);
    std::vector<RenderedImage> images;
    RenderedImage image;
    for (int k = 0; k <= milliseconds + 5; ++k) {
      cameras.add(at(kStart + int64_t{1000} * k));
      while (cameras.nextImage(image))
        images.push_back(image);
    }
    cameras.flush();
    while (cameras.nextImage(image))
      images.push_back(image);
    return images;
  }

  config::Experiment experiment_ = config::loadExperiment(kExperiment);
};

bool same(const std::vector<RenderedImage>& a, const std::vector<RenderedImage>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const RenderedImage& x, const RenderedImage& y) {
                      return x.utime == y.utime && x.camera == y.camera && x.jpeg == y.jpeg;
                    });
}

TEST_F(CameraRigTest, ImagesDependOnSceneAndSeedAlone) {
  const auto alone = rig(0), one = rig(1), many = rig(3);
  const std::vector<RenderedImage> images = draw(*alone, 5);
  EXPECT_TRUE(same(images, draw(*one, 5)));
  EXPECT_TRUE(same(images, draw(*many, 5)));
  EXPECT_TRUE(same(images, draw(*many, 5))) << "a second scene of the same rig";
  EXPECT_FALSE(same(images, draw(*many, 6)));
}

TEST_F(CameraRigTest, FramesLieOnTheGridInOrder) {
  const auto cameras = rig(2);
  const std::vector<RenderedImage> images = draw(*cameras, 1);
  ASSERT_EQ(images.size(), 2u * 23u);  // frames 4801 to 4823 of the grid
  for (std::size_t i = 0; i < images.size(); ++i) {
    EXPECT_EQ(images[i].camera, static_cast<int>(i % 2));
    EXPECT_EQ(images[i].frame, static_cast<int64_t>(i / 2));
    EXPECT_EQ(images[i].scene_id, 3);
    const std::size_t place = 4801 + i / 2;
    EXPECT_EQ(images[i].utime, std::llround(static_cast<double>(place) * 1e6 / 240));
    EXPECT_LE(images[i].jpeg.size(), 60000u);
    EXPECT_EQ(images[i].width, 640);
    EXPECT_EQ(images[i].height, 480);
  }
}

TEST_F(CameraRigTest, ShowsTheBallWhereItIsInTheMiddleOfTheExposure) {
  const auto cameras = rig(0);
  CameraRigOptions options = readCameraRig(kExperiment);
  for (const RenderedImage& image : draw(*cameras, 1)) {
    const cv::Mat picture = cv::imdecode(image.jpeg, cv::IMREAD_GRAYSCALE);
    const Eigen::Vector2d p =
        options.cameras[static_cast<std::size_t>(image.camera)].camera.project(
            at(image.utime).p_WBall);
    if (at(image.utime).p_WBall.x() < 0.75)
      continue;  // still before the arm
    const int u = static_cast<int>(std::lround(p.x())), v = static_cast<int>(std::lround(p.y()));
    EXPECT_GT(picture.at<uchar>(v, u), 120) << u << " " << v;
    EXPECT_GT(picture.at<uchar>(v - 3, u - 4), picture.at<uchar>(v + 4, u + 4));
    EXPECT_LT(picture.at<uchar>(v - 14, u), 100);
  }
}

TEST_F(CameraRigTest, BothCamerasSeeTheWholeThrowWithABigBall) {
  for (const RigCamera& rig : readCameraRig(kExperiment).cameras) {
    for (const double y : {-0.95, 0.0, 0.95}) {
      // From a release beside or before the robot, past the top of a high arc, to behind the net.
      for (const Eigen::Vector3d& p_W :
           {Eigen::Vector3d(0.05, y, -0.3), Eigen::Vector3d(0.05, y, 0.6),
            Eigen::Vector3d(0.8, y, 0.6), Eigen::Vector3d(1.2, y / 2, 1.2),
            Eigen::Vector3d(3.05, 0.1, -0.6), Eigen::Vector3d(3.05, -0.1, -0.4)}) {
        const Eigen::Vector2d p = rig.camera.project(p_W);
        const double radius =
            rig.camera.fx * experiment_.ball.radius / rig.camera.toCamera(p_W).z();
        EXPECT_GT(radius, 6.4);
        EXPECT_GT(p.minCoeff(), radius + 1) << rig.channel << " " << p_W.transpose();
        EXPECT_LT(p.x(), 639 - radius) << rig.channel << " " << p_W.transpose();
        EXPECT_LT(p.y(), 479 - radius) << rig.channel << " " << p_W.transpose();
      }
    }
  }
}

TEST_F(CameraRigTest, NoiseHasTheSigmaAndChangesFromFrameToFrame) {
  const NoiseField field({640, 480}, 2.0);
  const cv::Mat first = field.at(1, 0, 7);
  cv::Scalar mean, sigma;
  cv::meanStdDev(first, mean, sigma);
  EXPECT_NEAR(mean[0] / 16, 0, 0.02);
  EXPECT_NEAR(sigma[0] / 16, 2.0, 0.02);
  EXPECT_EQ(cv::norm(first, field.at(1, 0, 7), cv::NORM_INF), 0);
  for (const cv::Mat& other : {field.at(1, 0, 8), field.at(1, 1, 7), field.at(2, 0, 7)})
    EXPECT_GT(cv::norm(first, other, cv::NORM_INF), 0);
}

TEST_F(CameraRigTest, IgnoresTicksThatDoNotFollow) {
  const auto cameras = rig(0);
  cameras->add(at(kStart));  // before any scene
  RenderedImage image;
  EXPECT_FALSE(cameras->nextImage(image));
  cameras->begin(1, 1, kStart, kStart + 20000, experiment_.target);
  for (int k = 0; k <= 20; ++k) {
    cameras->add(at(kStart + int64_t{1000} * k));
    cameras->add(at(kStart + int64_t{1000} * k));
    cameras->add(at(kStart));
  }
  int count = 0;
  while (cameras->nextImage(image))
    ++count;
  EXPECT_EQ(count, 2 * 4);
}

TEST_F(CameraRigTest, AnImageThatWouldBeTooLargeIsCompressedMore) {
  CameraRigOptions options = readCameraRig(kExperiment);
  options.workers = 0;
  options.noise = 40;
  options.jpeg_quality = 100;
  CameraRig noisy(options, experiment_.arm, experiment_.hand, experiment_.ball.radius);
  for (const RenderedImage& image : draw(noisy, 1, 10)) {
    EXPECT_LE(image.jpeg.size(), 60000u);
    EXPECT_FALSE(cv::imdecode(image.jpeg, cv::IMREAD_GRAYSCALE).empty());
  }
}

}  // namespace
}  // namespace fastball::sim_bullet
