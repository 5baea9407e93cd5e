// The drawn ball against the sphere's silhouette as OpenCV projects it.
#include "sim_bullet/camera_ball.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

namespace fastball::sim_bullet {
namespace {

constexpr double kRadius = 0.05;

View blackView() {
  View view;
  model::Camera& camera = view.rig.camera;
  camera.width = 640;
  camera.height = 480;
  camera.fx = camera.fy = 900;
  camera.cx = 319.5;
  camera.cy = 239.5;
  camera.distortion << -0.1, 0.02, 0, 0, 0;
  lookAt({0.3, -5.7, 0.4}, {1.5, 0, 0.3}, camera);
  view.rays = rayMap(camera);
  view.background = cv::Mat::zeros(480, 640, CV_8U);
  return view;
}

/// The circle along which lines of sight touch the sphere, as pixels relative to `middle`.
std::vector<cv::Point2f> silhouette(const model::Camera& camera,
                                    const Eigen::Vector3d& p_W,
                                    const cv::Point2d& middle) {
  const Eigen::Vector3d c = camera.toCamera(p_W);
  const double sine = kRadius / c.norm(), cosine = std::sqrt(1 - sine * sine);
  const Eigen::Vector3d a = c.unitOrthogonal(), b = c.normalized().cross(a);
  std::vector<cv::Point3d> points;
  for (int i = 0; i < 360; ++i) {
    const double angle = 2 * M_PI * i / 360;
    const Eigen::Vector3d p =
        c * cosine * cosine + kRadius * cosine * (std::cos(angle) * a + std::sin(angle) * b);
    points.emplace_back(p.x(), p.y(), p.z());
  }
  std::vector<cv::Point2d> pixels;
  cv::projectPoints(points, cv::Vec3d(0, 0, 0), cv::Vec3d(0, 0, 0),
                    cv::Matx33d(camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1),
                    cv::Vec<double, 5>(camera.distortion.data()), pixels);
  std::vector<cv::Point2f> relative;
  relative.reserve(pixels.size());
  for (const cv::Point2d& p : pixels)
    relative.emplace_back(p - middle);
  return relative;
}

TEST(DrawnBall, CoversTheSilhouette) {
  const View view = blackView();
  // No lamp: the ball is evenly grey, and its grey values are its area.
  const BallLook look{kRadius, 0.6, Eigen::Vector3d::Zero()};
  for (const Eigen::Vector3d& p_W :
       {Eigen::Vector3d(1.5, 0, 0.3), Eigen::Vector3d(0.02, -0.9, 0.6), Eigen::Vector3d(3, 0, -0.5),
        Eigen::Vector3d(0.813, 0.677, -0.211)}) {
    SceneSnapshot snapshot;
    snapshot.p_WBall = p_W;
    cv::Mat image = view.background.clone();
    drawBall(view, snapshot, look, {0, 0}, image);
    const cv::Moments drawn = cv::moments(image);
    const cv::Point2d middle(drawn.m10 / drawn.m00, drawn.m01 / drawn.m00);
    const cv::Moments truth = cv::moments(silhouette(view.rig.camera, p_W, middle));
    EXPECT_NEAR(truth.m10 / truth.m00, 0, 0.03) << p_W.transpose();
    EXPECT_NEAR(truth.m01 / truth.m00, 0, 0.03) << p_W.transpose();
    const double grey = image.at<uchar>(cvRound(middle.y), cvRound(middle.x));
    EXPECT_NEAR(std::sqrt(drawn.m00 / grey / M_PI), std::sqrt(std::abs(truth.m00) / M_PI), 0.15);
    // Longer away from the image's centre: the second moments show the ellipse.
    EXPECT_NEAR((drawn.mu20 - drawn.mu02) / drawn.m00, (truth.mu20 - truth.mu02) / truth.m00, 0.15);
  }
}

TEST(DrawnBall, IsBrighterTowardsTheLamp) {
  const View view = blackView();
  SceneSnapshot snapshot;
  snapshot.p_WBall = {1.5, 0, 0.3};
  cv::Mat image = view.background.clone();
  drawBall(view, snapshot, {kRadius, 0.6, {-0.8, -0.3, 0.5}}, {0, 0}, image);
  const Eigen::Vector2d p = view.rig.camera.project(snapshot.p_WBall);
  const int u = static_cast<int>(p.x()), v = static_cast<int>(p.y());
  EXPECT_GT(image.at<uchar>(v - 2, u - 4), image.at<uchar>(v + 2, u + 4) + 50);
  // The dark side still stands out from a black background.
  EXPECT_GT(image.at<uchar>(v + 3, u + 5), 60);
}

TEST(DrawnBall, IsNotDrawnOutsideOfTheImageOrBehindTheCamera) {
  const View view = blackView();
  for (const Eigen::Vector3d& p_W : {Eigen::Vector3d(0.3, -5.75, 0.4),
                                     Eigen::Vector3d(0.3, -9, 0.4), Eigen::Vector3d(-30, 0, 0.3)}) {
    SceneSnapshot snapshot;
    snapshot.p_WBall = p_W;
    cv::Mat image = view.background.clone();
    drawBall(view, snapshot, {kRadius, 0.6, Eigen::Vector3d::UnitZ()}, {0, 0}, image);
    EXPECT_EQ(cv::countNonZero(image), 0) << p_W.transpose();
  }
}

}  // namespace
}  // namespace fastball::sim_bullet
