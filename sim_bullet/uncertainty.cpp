#include "sim_bullet/uncertainty.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "config/strict_yaml.h"

namespace fastball::sim_bullet {
namespace {

/// Draws beyond this many standard deviations are moved to it.
constexpr double kMostSigmas = 3;

using Shape = Distribution::Shape;

/// Largest |offset| of the set-up's and the throw's draw together that still is an arm, a hand, a ball and a room.
double mostOf(Error error) {
  switch (error) {
    case Error::kGraspOffset:
      return 0.1;
    case Error::kOpeningDelay:
    case Error::kFingerDelay:
      return 0.1;
    case Error::kEncoderOffset:
      return 0.06;
    case Error::kEncoderNoise:
      return 0.01;
    case Error::kBasePosition:
    case Error::kTargetPosition:
    case Error::kCameraPosition:
      return 0.2;
    case Error::kBaseYaw:
    case Error::kCameraRotation:
      return 0.1;
    case Error::kBallRadius:
      return 0.2;
    case Error::kBallMass:
    case Error::kUnevenness:
    case Error::kFriction:
    case Error::kDrag:
    case Error::kFingerLag:
    case Error::kJointFriction:
    case Error::kStiffness:
    case Error::kImageNoise:
      return 30;  // kLeastFactor holds them from below
  }
  return 0;
}

bool isDelay(Error error) {
  return error == Error::kOpeningDelay || error == Error::kFingerDelay;
}

/// Where the arm, the cameras and the ball's outline stand: the cameras are placed once.
bool isFixed(Error error) {
  return error == Error::kBallRadius || error == Error::kBasePosition || error == Error::kBaseYaw ||
         error == Error::kCameraPosition || error == Error::kCameraRotation ||
         error == Error::kImageNoise;
}

/// The shape and its numbers; exactly one is given.
Distribution readShape(config::Section& entry,
                       const config::Section& part,
                       const ErrorName& error) {
  const bool relative = std::string(error.unit) == "relative";
  std::optional<Distribution> read;
  const auto take = [&](const char* key, const Distribution& distribution) {
    if (read)
      throw entry.error(key, "is a second distribution of the same error");
    read = distribution;
  };
  if (entry.has("normal"))
    take("normal", {Shape::kNormal, entry.number("normal", config::kNonNegative), 0});
  if (entry.has("half_normal"))
    take("half_normal", {Shape::kHalfNormal, entry.number("half_normal", config::kNonNegative), 0});
  for (const char* key : {"uniform", "log_uniform"}) {
    if (!entry.has(key))
      continue;
    const bool factor = std::string(key) == "log_uniform";
    if (factor && !relative)
      throw entry.error(key, fmt::format("is a range of factors, and {} has the unit {}",
                                         error.name, error.unit));
    const Eigen::VectorXd ends =
        entry.vector(key, 2, factor ? config::Range{0.05, 20} : config::Range{});
    if (ends[0] > ends[1])
      throw entry.error(key, "must give the lower end first");
    take(key, {factor ? Shape::kLogUniform : Shape::kUniform, ends[0], ends[1]});
  }
  if (!read)
    throw part.error(error.name, "needs one of normal, half_normal, uniform and log_uniform");
  return *read;
}

void readPart(config::Section part, Uncertainty::Part which, double scale, Uncertainty& result) {
  for (const ErrorName& error : errorNames()) {
    if (!part.has(error.name))
      continue;
    config::Section entry = part.section(error.name);
    const std::string unit = entry.text("unit");
    if (unit != error.unit)
      throw entry.error("unit",
                        fmt::format("is '{}'; {} is in '{}'", unit, error.name, error.unit));
    Uncertainty::Size& size = result.of(which, error.error);
    size.distribution = readShape(entry, part, error);
    size.size = scale * (entry.has("times") ? entry.number("times", {0, 100}) : 1.0);
    entry.ignore("reason");
    entry.finish();
    if (error.error == Error::kEncoderNoise && which == Uncertainty::kSetUp)
      throw part.error(error.name, "is drawn at every tick: it belongs to 'throw'");
    if (isFixed(error.error) && which == Uncertainty::kThrow)
      throw part.error(error.name, "does not change from throw to throw: it belongs to 'set_up'");
    if (isDelay(error.error) && (size.distribution.shape == Shape::kNormal ||
                                 std::min(size.distribution.a, size.distribution.b) < 0))
      throw part.error(error.name, "is a delay and cannot be negative: half_normal, or uniform");
    const double largest =
        result.of(Uncertainty::kSetUp, error.error)
            .distribution.largest(result.of(Uncertainty::kSetUp, error.error).size) +
        result.of(Uncertainty::kThrow, error.error)
            .distribution.largest(result.of(Uncertainty::kThrow, error.error).size);
    if (!(largest <= mostOf(error.error)))
      throw part.error(error.name,
                       fmt::format("can be as large as {:.4g} {} with its scale; at most {:.4g} is "
                                   "anything real",
                                   largest, error.unit, mostOf(error.error)));
  }
  part.finish();
}

}  // namespace

const std::array<ErrorName, kErrors>& errorNames() {
  static constexpr std::array<ErrorName, kErrors> kNames{{
      {Error::kGraspOffset, "grasp_offset", "m"},
      {Error::kBallMass, "ball_mass", "relative"},
      {Error::kBallRadius, "ball_radius", "relative"},
      {Error::kStiffness, "stiffness", "relative"},
      {Error::kUnevenness, "unevenness", "relative"},
      {Error::kFriction, "friction", "relative"},
      {Error::kDrag, "drag", "relative"},
      {Error::kOpeningDelay, "opening_delay", "s"},
      {Error::kFingerDelay, "finger_delay", "s"},
      {Error::kFingerLag, "finger_lag", "relative"},
      {Error::kEncoderOffset, "encoder_offset", "rad"},
      {Error::kEncoderNoise, "encoder_noise", "rad"},
      {Error::kJointFriction, "joint_friction", "relative"},
      {Error::kBasePosition, "base_position", "m"},
      {Error::kBaseYaw, "base_yaw", "rad"},
      {Error::kTargetPosition, "target_position", "m"},
      {Error::kCameraPosition, "camera_position", "m"},
      {Error::kCameraRotation, "camera_rotation", "rad"},
      {Error::kImageNoise, "image_noise", "relative"},
  }};
  return kNames;
}

double Distribution::draw(std::mt19937_64& engine, double size) const {
  const auto normal = [&] {
    return a * std::clamp(std::normal_distribution<double>()(engine), -kMostSigmas, kMostSigmas);
  };
  const auto even = [&](double low, double high) {
    return low + (high - low) * std::uniform_real_distribution<double>()(engine);
  };
  switch (shape) {
    case Shape::kNone:
      return 0;
    case Shape::kNormal:
      return size * normal();
    case Shape::kHalfNormal:
      return size * std::abs(normal());
    case Shape::kUniform:
      return size * even(a, b);
    case Shape::kLogUniform:
      return std::exp(size * even(std::log(a), std::log(b))) - 1;
  }
  return 0;
}

double Distribution::largest(double size) const {
  switch (shape) {
    case Shape::kNone:
      return 0;
    case Shape::kNormal:
    case Shape::kHalfNormal:
      return size * kMostSigmas * a;
    case Shape::kUniform:
      return size * std::max(std::abs(a), std::abs(b));
    case Shape::kLogUniform:
      return std::max(std::abs(std::pow(a, size) - 1), std::abs(std::pow(b, size) - 1));
  }
  return 0;
}

Uncertainty loadUncertainty(const std::string& path) {
  config::Section file = config::Section::fromFile(path);
  const double scale = file.has("scale") ? file.number("scale", {0, 100}) : 1.0;
  Uncertainty result;
  if (file.has("set_up"))
    readPart(file.section("set_up"), Uncertainty::kSetUp, scale, result);
  if (file.has("throw"))
    readPart(file.section("throw"), Uncertainty::kThrow, scale, result);
  file.finish();
  return result;
}

}  // namespace fastball::sim_bullet
