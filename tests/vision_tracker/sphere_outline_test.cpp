// The outline of a sphere against points of its silhouette, projected by OpenCV.
#include "vision_tracker/sphere_outline.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>
#include <random>

#include "sim_bullet/camera_config.h"

namespace fastball::vision_tracker {
namespace {

constexpr double kRadius = 0.05;

model::Camera testCamera(double k1) {
  model::Camera camera;
  camera.width = 640;
  camera.height = 480;
  camera.fx = camera.fy = 600;
  camera.cx = 319.5;
  camera.cy = 239.5;
  camera.distortion << k1, -0.2 * k1, 0, 0, 0;
  sim_bullet::lookAt({0.5, -3.5, 0.4}, {1.6, 0, 0.2}, camera);
  return camera;
}

/// The circle along which lines of sight touch the sphere, as pixels.
std::vector<cv::Point2d> silhouette(const model::Camera& camera, const Eigen::Vector3d& p_W) {
  const Eigen::Vector3d c = camera.toCamera(p_W);
  const double sine = kRadius / c.norm();
  const Eigen::Vector3d centre = c * (1 - sine * sine);
  const Eigen::Vector3d a = c.unitOrthogonal(), b = c.normalized().cross(a);
  std::vector<cv::Point3d> points;
  for (int i = 0; i < 720; ++i) {
    const double angle = 2 * M_PI * i / 720;
    const Eigen::Vector3d p =
        centre + kRadius * std::sqrt(1 - sine * sine) * (std::cos(angle) * a + std::sin(angle) * b);
    points.emplace_back(p.x(), p.y(), p.z());
  }
  const cv::Matx33d K(camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1);
  const cv::Vec<double, 5> D(camera.distortion.data());
  std::vector<cv::Point2d> pixels;
  cv::projectPoints(points, cv::Vec3d(0, 0, 0), cv::Vec3d(0, 0, 0), K, D, pixels);
  return pixels;
}

struct Moments {
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();
  Eigen::Matrix2d shape = Eigen::Matrix2d::Zero();
};

/// Centre and shape of the area that the pixels enclose (an ellipse's second moments are a quarter of its shape).
Moments enclosed(const std::vector<cv::Point2d>& outline) {
  std::vector<cv::Point2f> small;
  small.reserve(outline.size());
  for (const cv::Point2d& p : outline)
    small.emplace_back(static_cast<float>(p.x - outline[0].x),
                       static_cast<float>(p.y - outline[0].y));
  const cv::Moments m = cv::moments(small);
  Moments moments;
  moments.centre << m.m10 / m.m00 + outline[0].x, m.m01 / m.m00 + outline[0].y;
  moments.shape << m.mu20, m.mu11, m.mu11, m.mu02;
  moments.shape *= 4 / m.m00;
  return moments;
}

std::vector<Eigen::Vector3d> places() {
  std::vector<Eigen::Vector3d> points = {{1.6, 0, 0.2}, {0, -1, 0.6}, {3, 0, -0.5}, {0.8, 1, -0.3}};
  std::mt19937 random(1);
  const auto uniform = [&](double low, double high) {
    return low + (high - low) * (random() / 4294967296.0);
  };
  for (int i = 0; i < 20; ++i)
    points.emplace_back(uniform(0, 3), uniform(-1, 1), uniform(-0.5, 1));
  return points;
}

TEST(SphereOutline, IsTheSilhouetteThatOpenCvProjects) {
  for (const double k1 : {0.0, -0.1}) {
    const model::Camera camera = testCamera(k1);
    for (const Eigen::Vector3d& p_W : places()) {
      const Outline outline = sphereOutline(camera, p_W, kRadius);
      if (!cv::Rect(0, 0, 640, 480)
               .contains(
                   {static_cast<int>(outline.centre.x()), static_cast<int>(outline.centre.y())}))
        continue;
      const Moments truth = enclosed(silhouette(camera, p_W));
      const double radius = outline.meanRadius();
      const double tolerance = k1 == 0 ? 1e-3 : 4e-5 * radius * radius;
      EXPECT_LT((outline.centre - truth.centre).norm(), tolerance) << p_W.transpose();
      EXPECT_LT((outline.shape - truth.shape).norm(), 5e-3 * radius * radius) << p_W.transpose();
      EXPECT_LT((outlineCentre(camera, p_W, kRadius) - outline.centre).norm(), 1e-9);
    }
  }
}

TEST(SphereOutline, CentreLiesOutsideOfTheImageOfTheSpheresCentre) {
  const model::Camera camera = testCamera(0);
  const Eigen::Vector3d p_W(0.1, 0, 0.9);
  const Eigen::Vector2d middle(camera.cx, camera.cy);
  const Eigen::Vector2d image = camera.project(p_W), centre = outlineCentre(camera, p_W, kRadius);
  const double radius = sphereOutline(camera, p_W, kRadius).meanRadius();
  const double tangent = (image - middle).norm() / camera.fx;
  // r^2 / f tan(angle off the axis); r is larger off the axis than on it.
  EXPECT_NEAR((centre - middle).norm() - (image - middle).norm(),
              radius * radius / camera.fx * tangent, 0.01);
  EXPECT_NEAR((centre - image).normalized().dot((image - middle).normalized()), 1, 1e-9);
}

TEST(SphereOutline, JacobianMatchesFiniteDifferences) {
  const model::Camera camera = testCamera(-0.1);
  for (const Eigen::Vector3d& p_W : places()) {
    Eigen::Matrix<double, 2, 3> jacobian;
    outlineCentre(camera, p_W, kRadius, &jacobian);
    for (int i = 0; i < 3; ++i) {
      const Eigen::Vector3d h = 1e-6 * Eigen::Vector3d::Unit(i);
      const Eigen::Vector2d slope =
          (outlineCentre(camera, p_W + h, kRadius) - outlineCentre(camera, p_W - h, kRadius)) /
          2e-6;
      EXPECT_LT((slope - jacobian.col(i)).norm(), 1e-3 * slope.norm());
    }
  }
}

TEST(PlaceBySize, IsThatOfTheSphereWhoseOutlineItIs) {
  for (const double k1 : {0.0, -0.1}) {
    const model::Camera camera = testCamera(k1);
    for (const Eigen::Vector3d& p_W : places()) {
      const Outline outline = sphereOutline(camera, p_W, kRadius);
      const auto place = placeBySize(camera, outline.centre, outline.meanRadius(), kRadius);
      ASSERT_TRUE(place);
      EXPECT_LT((place->p_W - p_W).norm(), 2e-3) << p_W.transpose();
      EXPECT_NEAR(place->depth, camera.toCamera(place->p_W).z(), 1e-12);
      const Eigen::Vector3d ray_W = place->p_W + camera.R_CW.transpose() * camera.p_CW;
      EXPECT_LT((place->along_W - ray_W.normalized()).norm(), 1e-12);
    }
  }
  const model::Camera camera = testCamera(0);
  EXPECT_FALSE(placeBySize(camera, {320, 240}, camera.fx / 2, kRadius)) << "two radii away";
}

}  // namespace
}  // namespace fastball::vision_tracker
