#pragma once

#include <random>

#include "bench/ceiling.h"
#include "config/experiment.h"
#include "planner/config.h"

namespace fastball::bench {

/// The default experiment's throw, and random motions of its arm.
struct FreeThrows {
  std::string path = FASTBALL_SOURCE_DIR "/config/experiment.yaml";
  planner::PlannerConfig config = planner::loadConfig(path);
  model::Target target = config::loadExperiment(path).target;
  model::Arm arm{config.arm, config.hand.payload};
  std::mt19937_64 engine{7};

  FreeThrow task(const CeilingOptions& options = {}) const {
    return freeThrow(config, arm, target, options);
  }
  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine);
  }
  Eigen::VectorXd uniform(int count, double low, double high) {
    Eigen::VectorXd x(count);
    for (double& value : x)
      value = uniform(low, high);
    return x;
  }
  /// Anywhere in the ranges, speeds to their limits times `share`.
  model::ArmMotion motion(double share) {
    model::ArmMotion motion;
    const Eigen::Vector4d s = uniform(4, 0, 1);
    motion.q = config.arm.q_min + s.cwiseProduct(config.arm.q_max - config.arm.q_min);
    motion.qd = share * config.arm.qd_max.cwiseProduct(Eigen::Vector4d(uniform(4, -1, 1)));
    motion.qdd = share * 50 * Eigen::Vector4d(uniform(4, -1, 1));
    return motion;
  }
};

/// `derivative` against central differences of f, relative to its size.
template <typename Function>
void expectSlope(const Function& f,
                 const Eigen::VectorXd& x,
                 const Eigen::MatrixXd& derivative,
                 double tolerance) {
  constexpr double kStep = 1e-6;
  Eigen::MatrixXd expected(derivative.rows(), x.size());
  for (int i = 0; i < x.size(); ++i) {
    const Eigen::VectorXd shift = kStep * Eigen::VectorXd::Unit(x.size(), i);
    expected.col(i) = (f(x + shift) - f(x - shift)) / (2 * kStep);
  }
  EXPECT_LT((derivative - expected).cwiseAbs().maxCoeff(),
            tolerance * (1 + expected.cwiseAbs().maxCoeff()));
}

}  // namespace fastball::bench
