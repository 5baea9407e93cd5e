#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "model/camera.h"
#include "vision_tracker/flight_estimate.h"

namespace fastball::vision_tracker {

/// One flight fitted to observations by Gauss-Newton: the residuals, the steps and what comes out.
class FlightProblem {
 public:
  static constexpr int kClock = kFlightParameters;  ///< index of the second camera's clock
  static constexpr int kSize = kClock + model::kMostCameras - 1;
  static constexpr int kSizeRate = kSize + 1;
  static constexpr int kUnknowns = kSizeRate + 1;
  /// The flight; the clocks of the other cameras against the first one's [s]; the relative error of the radii at the start, and
  /// how it changes [1/s], for shading and background change along the way.
  using Unknowns = Eigen::Matrix<double, kUnknowns, 1>;
  using Information = Eigen::Matrix<double, kUnknowns, kUnknowns>;

  /// All references must outlive the problem. @param first use the observations from this index on
  FlightProblem(const std::vector<Observation>& observations,
                std::size_t first,
                const std::vector<model::Camera>& cameras,
                const FlightPrior& prior);

  /// [us], of the flight's start.
  int64_t utime() const { return observations_[first_].utime; }
  /// Starts at a state at utime() with the prior's drag, or on a flight that is nearly right.
  void start(const model::BallState& state);
  void start(const FlightEstimate& flight);
  /// Residuals at the present parameters. False if the flight leaves the space before a camera.
  bool evaluate();
  /// Solves for one step. @param cutting far observations are left out, else they weigh less (Huber)
  /// @return information of the observations, without what was known before
  Information step(bool cutting, Unknowns* change) const;
  void move(const Unknowns& change) { x_ += change; }
  /// @param information of the last step, cutting
  FlightEstimate estimate(const Information& information) const;

 private:
  /// One observation against the flight assumed: centre, and radius if it is used.
  struct Residual {
    Eigen::Vector3d error;                                 ///< [px]
    Eigen::Matrix<double, 3, kUnknowns> jacobian;          ///< of the prediction
    Eigen::Matrix<double, 2, kCameraConstants> constants;  ///< d centre / d its camera's constants
    Eigen::Matrix3d weight;                                ///< inverse covariance
    double distance = 0;                                   ///< Mahalanobis
  };
  void compare(const Observation& observation,
               const model::BallState& ball,
               const FlightSensitivity& sensitivity,
               Residual& residual) const;
  void compareRadius(const Observation& observation,
                     const Eigen::Vector3d& p_W,
                     const FlightSensitivity& sensitivity,
                     Residual& residual) const;
  double weight(const Residual& residual, bool cutting) const;
  template <int Rows, int Columns>
  void addEquations(bool cutting, Information& information, Unknowns& gradient) const;
  double clockOf(int camera) const { return camera == 0 ? 0 : x_[kClock + camera - 1]; }
  std::vector<Eigen::MatrixXd> constantSums() const;
  ConstantsEvidence evidence(const Information& inverse, double scale) const;

  const std::vector<Observation>& observations_;
  std::size_t first_;
  const std::vector<model::Camera>& cameras_;
  const FlightPrior& prior_;
  bool with_radius_;
  bool plain_;  ///< nothing but start and drag is estimated
  std::vector<Residual> residuals_;
  Unknowns x_ = Unknowns::Zero(), mean_ = Unknowns::Zero();
  /// Inverse variances of what is known before; 1 for what is not to be estimated, which no observation moves.
  Unknowns prior_weight_ = Unknowns::Zero();
  std::vector<bool> estimated_;
  double spread_ = 1;  ///< of the distances, by their median: the unit of weights and cut
};

}  // namespace fastball::vision_tracker
