#pragma once

#include <array>
#include <random>
#include <string>

namespace fastball::sim_bullet {

/// How large one error is. kNone draws no random number. A draw is an offset in the error's unit,
/// or for a relative error the factor on the nominal value less 1.
struct Distribution {
  enum class Shape {
    kNone,
    kNormal,      ///< standard deviation `a`, cut off at three of them
    kHalfNormal,  ///< the magnitude of such a draw: a delay
    kUniform,     ///< even from `a` to `b`
    kLogUniform,  ///< a factor, even on a logarithmic scale from `a` to `b`
  };
  Shape shape = Shape::kNone;
  double a = 0, b = 0;

  /// `size` multiplies the draw; a log-uniform factor is raised to that power.
  double draw(std::mt19937_64& engine, double size) const;
  /// Largest |draw|.
  double largest(double size) const;
};

/// No relative error makes a quantity less than this share of its nominal value.
inline constexpr double kLeastFactor = 0.05;

/// The errors a throw can have. Each may be given for the set-up, for the throw, or for both (then
/// offsets add up and factors multiply), but kEncoderNoise for the throw only, and radius, base,
/// cameras and the images' noise for the set-up only.
enum class Error {
  kGraspOffset,     ///< [m], of the ball in the hand, each axis
  kBallMass,        ///< relative
  kBallRadius,      ///< relative
  kStiffness,       ///< relative, of the ball's Young's modulus
  kUnevenness,      ///< relative, of the modulus under each finger
  kFriction,        ///< relative, of Coulomb's mu between finger and ball
  kDrag,            ///< relative, of the ball's drag coefficient
  kOpeningDelay,    ///< [s], dead time of all fingers' commands
  kFingerDelay,     ///< [s], of each finger's beyond that
  kFingerLag,       ///< relative, of the fingers' drives
  kEncoderOffset,   ///< [rad], of each arm joint's reading
  kEncoderNoise,    ///< [rad], of each arm joint's reading, drawn anew at every tick
  kJointFriction,   ///< relative, of the arm's viscous and Coulomb friction
  kBasePosition,    ///< [m], of the arm in the room, each axis
  kBaseYaw,         ///< [rad], of the arm in the room, about the vertical
  kTargetPosition,  ///< [m], of the net in the room, each axis
  kCameraPosition,  ///< [m], of each camera in the room, each axis
  kCameraRotation,  ///< [rad], of each camera about each of its axes
  kImageNoise,      ///< relative, of the images' noise
};
inline constexpr int kErrors = 19;

/// Name in the file and unit ("relative": of the nominal value).
struct ErrorName {
  Error error;
  const char* name;
  const char* unit;
};
const std::array<ErrorName, kErrors>& errorNames();

/// What is wrong in a set-up and in a throw, as an uncertainty file gives it; an error left out does not happen.
struct Uncertainty {
  /// Of the set-up: drawn once from its seed. Of the throw: drawn anew for each from the scene's seed.
  enum Part { kSetUp, kThrow };
  struct Size {
    Distribution distribution;
    double size = 1;  ///< common scale times the error's own factor
  };
  std::array<std::array<Size, kErrors>, 2> sizes;

  Size& of(Part part, Error error) { return sizes[part][static_cast<std::size_t>(error)]; }
  const Size& of(Part part, Error error) const {
    return sizes[part][static_cast<std::size_t>(error)];
  }
  /// A normal error, for what is made in code.
  void setNormal(Part part, Error error, double sd) {
    of(part, error).distribution = {Distribution::Shape::kNormal, sd, 0};
  }
  void setUniform(Part part, Error error, double low, double high) {
    of(part, error).distribution = {Distribution::Shape::kUniform, low, high};
  }
};

/// Reads an uncertainty file. @throw config::ConfigError for an unknown key, a wrong unit, or a size beyond anything real.
Uncertainty loadUncertainty(const std::string& path);

}  // namespace fastball::sim_bullet
