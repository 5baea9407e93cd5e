#include "vision_tracker/background.h"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

namespace fastball::vision_tracker {
namespace {

/// A textured scene with normal noise of 2 grey levels.
class Scene {
 public:
  cv::Mat image() {
    cv::Mat noise(kSize, CV_16S), noisy;
    random_.fill(noise, cv::RNG::NORMAL, 0, 2);
    cv::add(scene_, noise, noisy, cv::noArray(), CV_8U);
    return noisy;
  }
  cv::Mat& still() { return scene_; }
  static double error(const Background& background, const cv::Mat& truth, const cv::Rect& part) {
    cv::Mat mean;
    background.mean()(part).convertTo(mean, CV_64F, 1.0 / Background::kScale);
    cv::Mat expected;
    truth(part).convertTo(expected, CV_64F);
    return cv::norm(mean, expected, cv::NORM_L2) / std::sqrt(static_cast<double>(part.area()));
  }
  inline static const cv::Size kSize{640, 480};
  inline static const cv::Rect kAll{0, 0, 640, 480};

 private:
  static cv::Mat texture() {
    cv::Mat scene(kSize, CV_8U);
    for (int v = 0; v < scene.rows; ++v)
      for (int u = 0; u < scene.cols; ++u)
        scene.at<uint8_t>(v, u) = static_cast<uint8_t>(50 + (u * 7 + v * 3) % 40);
    return scene;
  }
  cv::Mat scene_ = texture();
  cv::RNG random_{1};
};

TEST(Background, LearnsTheMeanBetterThanOneImageShowsIt) {
  Scene scene;
  Background background;
  background.learn(scene.image(), {});
  EXPECT_NEAR(Scene::error(background, scene.still(), Scene::kAll), 2.0, 0.3);
  for (int i = 0; i < 60; ++i)
    background.learn(scene.image(), {});
  EXPECT_LT(Scene::error(background, scene.still(), Scene::kAll), 0.6);
  EXPECT_NEAR(background.noise(scene.image()), 2.0, 0.4);
}

TEST(Background, AdoptsWhatHasBeenUncoveredAndStandsStill) {
  Scene scene;
  Background background;
  const cv::Rect arm(40, 30, 50, 20);
  const cv::Mat behind = scene.still()(arm).clone();
  scene.still()(arm).setTo(200);
  for (int i = 0; i < 10; ++i)
    background.learn(scene.image(), {});
  behind.copyTo(scene.still()(arm));
  for (int i = 0; i < 30; ++i)
    background.learn(scene.image(), {});
  EXPECT_LT(Scene::error(background, scene.still(), arm), 1.2);
}

TEST(Background, DoesNotAdoptABallThatFlies) {
  Scene scene;
  Background background;
  for (int i = 0; i < 20; ++i)
    background.learn(scene.image(), {});
  for (int i = 0; i < 30; ++i) {
    cv::Mat image = scene.image();
    // 16 px wide, 4 px an image: a slow throw.
    cv::circle(image, {100 + 4 * i, 60}, 8, cv::Scalar(180), cv::FILLED);
    background.learn(image, {});
  }
  EXPECT_LT(Scene::error(background, scene.still(), Scene::kAll), 1.0);
}

TEST(Background, LeavesWhatItIsToldToLeave) {
  Scene scene;
  Background background;
  background.learn(scene.image(), {});
  const cv::Mat before = background.mean().clone();
  const cv::Rect leave(500, 80, 500, 30);  // beyond the image too
  for (int i = 0; i < 10; ++i)
    background.learn(scene.image(), leave);
  const cv::Rect inside = leave & Scene::kAll;
  EXPECT_EQ(cv::norm(before(inside), background.mean()(inside), cv::NORM_INF), 0);
  EXPECT_GT(cv::norm(before, background.mean(), cv::NORM_INF), 0);
}

TEST(Background, LearnsOnlyWhereItIsToldTo) {
  Scene scene;
  Background background, whole;
  const cv::Mat first = scene.image();
  background.learn(first, {});
  whole.learn(first, {});
  const cv::Mat before = background.mean().clone();
  const cv::Rect only(101, 63, 300, 77), leave(150, 80, 40, 200);
  for (int i = 0; i < 10; ++i) {
    const cv::Mat image = scene.image();
    background.learn(image, leave, only);
    whole.learn(image, leave);
  }
  cv::Mat outside = background.mean().clone();
  before(only).copyTo(outside(only));
  EXPECT_EQ(cv::norm(before, outside, cv::NORM_INF), 0);
  EXPECT_EQ(cv::norm(whole.mean()(only), background.mean()(only), cv::NORM_INF), 0);
  EXPECT_GT(cv::norm(before(only), background.mean()(only), cv::NORM_INF), 0);
}

}  // namespace
}  // namespace fastball::vision_tracker
