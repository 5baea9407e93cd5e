#include "bench/ball_image_rows.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bench/ball_images.h"

namespace fastball::bench {
namespace {

constexpr int kBallsPerCell = 40;

/// Balls of several sizes, contrasts and lamps.
struct CentreResult {
  double bias = 0;  ///< [px], of the worst kind of ball, along or across the light
  double rms = 0;   ///< [px] per axis, of the worst kind of ball
  int missed = 0, balls = 0;
};

CentreResult measureCentres() {
  CentreResult result;
  int seed = 1;
  for (const double radius : {5.0, 8.0, 12.0, 20.0}) {
    for (const double contrast : {20.0, 50.0}) {
      for (const double lamp : {30.0, 100.0}) {
        BallImageOptions options;
        options.radius = radius;
        options.contrast = contrast;
        options.lamp = lamp;
        Eigen::Vector2d sum = Eigen::Vector2d::Zero();
        double squares = 0;
        int found = 0;
        for (int i = 0; i < kBallsPerCell; ++i) {
          const BallImageTrial trial = ballImageTrial(options, seed++);
          ++result.balls;
          if (!trial.found)
            continue;
          ++found;
          const Eigen::Vector2d across(-trial.light.y(), trial.light.x());
          sum += Eigen::Vector2d(trial.error.dot(trial.light), trial.error.dot(across));
          squares += trial.error.squaredNorm();
        }
        result.missed += kBallsPerCell - found;
        result.bias = std::max(result.bias, (sum / found).cwiseAbs().maxCoeff());
        result.rms = std::max(result.rms, std::sqrt(squares / (2 * found)));
      }
    }
  }
  return result;
}

const CentreResult& centres() {
  static const CentreResult result = measureCentres();
  return result;
}

std::string centreNote() {
  return fmt::format(
      "worst of 16 kinds of ball: radius 5 to 20 px, contrast 20 and 50 levels, lamp 30 and 100 "
      "levels; side "
      "light, clutter, blur, 1 px of motion, noise, JPEG; {} of {} balls missed",
      centres().missed, centres().balls);
}

}  // namespace

Row centreBias() {
  return {"vision.centre_bias_px", centres().bias, "px", "none", {}, centreNote()};
}

Row centreRms() {
  return {"vision.centre_rms_px", centres().rms, "px", "none", {}, centreNote()};
}

}  // namespace fastball::bench
