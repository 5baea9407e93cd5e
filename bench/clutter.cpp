#include "bench/clutter.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <random>

#include "sim_bullet/camera_ball.h"
#include "vision_tracker/sphere_outline.h"

namespace fastball::bench {
namespace {

using Motion = std::function<Eigen::Vector3d(double)>;  // [s] since the release -> [m]

/// @param kind 0 swings, 1 rolls, 2 is carried, 3 flies
Motion motionOf(int kind, double gravity, double radius, std::mt19937& random) {
  const auto uniform = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  const double way = uniform(0, 1) < 0.5 ? -1 : 1;
  const double y = uniform(-0.8, 1.0);
  switch (kind) {
    case 0: {
      const Eigen::Vector3d pivot(uniform(0.6, 2.4), y, 1.9);
      const double length = uniform(1.3, 1.8), size = uniform(0.4, 0.7), phase = uniform(0, 6);
      return [=](double t) {
        const double angle = size * std::sin(std::sqrt(gravity / length) * t + phase);
        return (pivot + length * Eigen::Vector3d(std::sin(angle), 0, -std::cos(angle))).eval();
      };
    }
    case 1: {
      const double speed = way * uniform(1.2, 3.0), x = uniform(1.0, 2.0);
      return [=](double t) { return Eigen::Vector3d(x + speed * (t - 0.25), y, -1.15 + radius); };
    }
    case 2: {
      const double speed = way * uniform(1.1, 1.6), x = uniform(0.8, 2.2), z = uniform(-0.4, 0.5);
      const double phase = uniform(0, 6);
      return [=](double t) {
        return Eigen::Vector3d(x + speed * (t - 0.25), y, z + 0.03 * std::sin(11 * t + phase));
      };
    }
    default: {
      const Eigen::Vector3d start(uniform(2.2, 2.8), y, uniform(0.0, 0.5));
      const Eigen::Vector3d v(-uniform(2.5, 4.5), uniform(-0.5, 0.5), uniform(1.0, 2.5));
      return [=](double t) {
        return (start + t * v - Eigen::Vector3d(0, 0, gravity * t * t / 2)).eval();
      };
    }
  }
}

}  // namespace

Clutter::Clutter(const sim_bullet::CameraRigOptions& rig, const config::Experiment& experiment)
    : rig_(rig), ball_radius_(experiment.ball.radius), gravity_(experiment.arm.gravity) {
  for (const sim_bullet::RigCamera& c : rig_.cameras)
    rays_.push_back(sim_bullet::rayMap(c.camera));
}

void Clutter::addTo(DrawnThrow& drawn, int seed) const {
  constexpr double kLampRadius = 0.055;  // [m]
  constexpr double kMains = 100;         // [1/s], of the lamp's flicker
  constexpr double kMargin = 4;          // [px], between two outlines that do not touch
  std::mt19937 random(static_cast<unsigned>(seed));
  std::uniform_real_distribution<double> uniform;
  const double radius = ball_radius_ * (0.85 + 0.3 * uniform(random));
  const Motion motion = motionOf(seed % 4, gravity_, radius, random);
  const Eigen::Vector3d p_WLamp(3 * uniform(random), 2.9, 0.7 + 0.6 * uniform(random));
  drawn.covered.assign(drawn.images.size(), false);
  for (std::size_t i = 0; i < drawn.images.size(); ++i) {
    sim_bullet::RenderedImage& image = drawn.images[i];
    const auto c = static_cast<std::size_t>(image.camera);
    const model::Camera& camera = rig_.cameras[c].camera;
    const double t = static_cast<double>(image.utime - drawn.made.release_utime) * 1e-6;
    cv::Mat picture = cv::imdecode(image.jpeg, cv::IMREAD_GRAYSCALE);
    const Eigen::Vector2d lamp = camera.project(p_WLamp);
    const double lamp_radius = camera.fx * kLampRadius / camera.toCamera(p_WLamp).z();
    cv::circle(picture, cv::Point(static_cast<int>(lamp.x() * 16), static_cast<int>(lamp.y() * 16)),
               static_cast<int>(lamp_radius * 16),
               cv::Scalar(215 + 25 * std::sin(2 * M_PI * kMains * t)), cv::FILLED, cv::LINE_AA, 4);
    sim_bullet::SceneSnapshot second;
    second.p_WBall = motion(t);
    second.R_WBall = Eigen::Matrix3d::Identity();
    sim_bullet::drawBall({rig_.cameras[c], rays_[c], {}, {}}, second,
                         {radius, rig_.blur, rig_.to_light_W}, {0, 0}, picture);
    cv::imencode(".jpg", picture, image.jpeg, {cv::IMWRITE_JPEG_QUALITY, rig_.jpeg_quality});
    const vision_tracker::Outline ball = trueOutline(drawn, ball_radius_, image);
    const vision_tracker::Outline other =
        vision_tracker::sphereOutline(camera, second.p_WBall, radius);
    drawn.covered[i] =
        (ball.centre - other.centre).norm() < ball.meanRadius() + other.meanRadius() + kMargin ||
        (ball.centre - lamp).norm() < ball.meanRadius() + lamp_radius + kMargin;
  }
}

}  // namespace fastball::bench
