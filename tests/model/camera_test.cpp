#include "model/camera.h"

#include <gtest/gtest.h>

#include <random>

namespace fastball::model {
namespace {

Camera exampleCamera() {
  Camera camera;
  camera.width = 640;
  camera.height = 480;
  camera.fx = 600;
  camera.fy = 610;
  camera.cx = 319.5;
  camera.cy = 239.5;
  camera.distortion << -0.2, 0.05, 1e-3, -5e-4, -0.01;
  // Looks from (1.5, -3, 0.5) along y of the world: image right = x, image down = -z.
  camera.R_CW << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  camera.p_CW = -camera.R_CW * Eigen::Vector3d(1.5, -3, 0.5);
  return camera;
}

TEST(Camera, SeesItsAxisAtThePrincipalPoint) {
  const Camera camera = exampleCamera();
  EXPECT_LT((camera.project({1.5, 0, 0.5}) - Eigen::Vector2d(319.5, 239.5)).norm(), 1e-9);
  EXPECT_GT(camera.project({1.6, 0, 0.5}).x(), 319.5) << "x of the world is to the right";
  EXPECT_LT(camera.project({1.5, 0, 0.6}).y(), 239.5) << "up in the world is up in the image";
}

TEST(Camera, WithoutDistortionIsAPinhole) {
  Camera camera = exampleCamera();
  camera.distortion.setZero();
  const Eigen::Vector2d pixel = camera.project({2.5, 1, 0});
  EXPECT_NEAR(pixel.x(), 319.5 + 600 * 1.0 / 4, 1e-9);
  EXPECT_NEAR(pixel.y(), 239.5 + 610 * 0.5 / 4, 1e-9);
}

TEST(Camera, DistortsAsOpenCvDocuments) {
  // Values worked out by hand from the formula at x = 0.5, y = -0.25.
  const Camera camera = exampleCamera();
  const double r2 = 0.3125, radial = 1 - 0.2 * r2 + 0.05 * r2 * r2 - 0.01 * r2 * r2 * r2;
  const double x = 0.5 * radial + 2 * 1e-3 * -0.125 - 5e-4 * (r2 + 0.5);
  const double y = -0.25 * radial + 1e-3 * (r2 + 0.125) + 2 * -5e-4 * -0.125;
  const Eigen::Vector2d pixel = camera.distort({0.5, -0.25});
  EXPECT_NEAR(pixel.x(), 319.5 + 600 * x, 1e-9);
  EXPECT_NEAR(pixel.y(), 239.5 + 610 * y, 1e-9);
}

TEST(Camera, UndistortInvertsDistort) {
  const Camera camera = exampleCamera();
  for (int u = -40; u <= 680; u += 20) {
    for (int v = -40; v <= 520; v += 20) {
      const Eigen::Vector2d normalised = camera.undistort({u, v});
      EXPECT_LT((camera.distort(normalised) - Eigen::Vector2d(u, v)).norm(), 1e-6);
    }
  }
  for (const double size : {0.0, 1e-12, 0.1, 0.6}) {
    const Eigen::Vector2d normalised(size, -0.7 * size);
    EXPECT_LT((camera.undistort(camera.distort(normalised)) - normalised).norm(), 1e-10);
  }
}

TEST(Camera, UndistortStaysFiniteOutsideTheLensModel) {
  Camera camera = exampleCamera();
  camera.distortion << -0.5, 0, 0, 0, 0;  // folds over at a radius of 0.82
  for (const double u : {-1e6, -2000.0, 2000.0, 1e6})
    EXPECT_TRUE(camera.undistort({u, u / 2}).allFinite());
}

TEST(Camera, JacobianIsTheDerivative) {
  const Camera camera = exampleCamera();
  std::mt19937 random(6);
  std::uniform_real_distribution<> uniform(-1, 1);
  const double h = 1e-6;
  for (int i = 0; i < 200; ++i) {
    const Eigen::Vector3d p(1.5 + uniform(random), uniform(random), 0.5 + uniform(random));
    Eigen::Matrix<double, 2, 3> jacobian;
    const Eigen::Vector2d pixel = camera.project(p, &jacobian);
    EXPECT_LT((pixel - camera.project(p)).norm(), 1e-12);
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3d step = h * Eigen::Vector3d::Unit(k);
      const Eigen::Vector2d slope = (camera.project(p + step) - camera.project(p - step)) / (2 * h);
      EXPECT_LT((jacobian.col(k) - slope).norm(), 1e-6 * (1 + slope.norm()));
    }
  }
}

}  // namespace
}  // namespace fastball::model
