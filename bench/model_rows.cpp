#include "bench/model_rows.h"

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <kdl/chainidsolver_recursive_newton_euler.hpp>

#include "bench/kdl_arm.h"
#include "bench/timing.h"
#include "config/experiment.h"
#include "model/arm.h"
#include "model/arm_derivatives.h"
#include "model/ball_flight.h"

namespace fastball::bench {
namespace {

constexpr double kMicro = 1e6;
constexpr double kControlTickUs = 1000;

Row inverseDynamics() {
  const config::Experiment experiment = config::loadExperiment(config::defaultExperimentPath());
  const model::Arm arm(experiment.arm, experiment.hand.payload);
  model::Vector4 q = experiment.q_rest;
  const model::Vector4 qd = 0.5 * experiment.arm.qd_max;
  const model::Vector4 qdd = model::Vector4::Constant(10.0);
  const double rnea = secondsPerCall("dynamics.inverse_us", [&] {
    benchmark::DoNotOptimize(q);
    benchmark::DoNotOptimize(arm.inverseDynamics(q, qd, qdd));
  });
  return {"dynamics.inverse_us", rnea * kMicro,  "us",
          "control tick",        kControlTickUs, "4 joints, payload, drive inertia"};
}

/// The same motion for both; KDL's arrays are allocated beforehand.
Row inverseDynamicsDerivatives() {
  const std::string id = "dynamics.derivatives_vs_kdl";
  const config::Experiment experiment = config::loadExperiment(config::defaultExperimentPath());
  const model::RigidBody& payload = experiment.hand.payload;
  const model::Arm arm(experiment.arm, payload);
  model::Vector4 q = experiment.q_rest;
  const model::Vector4 qd = 0.5 * experiment.arm.qd_max;
  const model::Vector4 qdd = model::Vector4::Constant(10.0);
  const double ours = secondsPerCall(id, [&] {
    benchmark::DoNotOptimize(q);
    benchmark::DoNotOptimize(arm.inverseDynamicsDerivatives(q, qd, qdd));
  });

  const KDL::Chain chain = kdlArm(experiment.arm, payload);
  KDL::ChainIdSolver_RNE solver(chain, KDL::Vector(0, 0, -experiment.arm.gravity));
  const KDL::Wrenches none(chain.getNrOfSegments(), KDL::Wrench::Zero());
  const KDL::JntArray kdl_q = toKdl(q);
  const KDL::JntArray kdl_qd = toKdl(qd);
  const KDL::JntArray kdl_qdd = toKdl(qdd);
  KDL::JntArray torques(model::kArmJoints);
  const double kdl = secondsPerCall(id + ".kdl", [&] {
    solver.CartToJnt(kdl_q, kdl_qd, kdl_qdd, none, torques);
    benchmark::ClobberMemory();
  });
  return {id,
          ours / kdl,
          "1",
          "Orocos KDL inverse dynamics",
          1.0,
          fmt::format("{:.2f} us with all first derivatives; KDL {:.2f} us without any",
                      ours * kMicro, kdl * kMicro)};
}

Row landing() {
  const config::Experiment experiment = config::loadExperiment(config::defaultExperimentPath());
  const model::BallState start{{0.5, 0.0, 0.5}, {6.0, 0.0, 1.0}};
  double drag = experiment.ball.dragPerMetre();
  const double seconds = secondsPerCall("flight.land_us", [&] {
    benchmark::DoNotOptimize(drag);
    benchmark::DoNotOptimize(model::land(start, experiment.target, drag, experiment.arm.gravity));
  });
  return {
      "flight.land_us", seconds * kMicro, "us",
      "none",           std::nullopt,     "Runge-Kutta 4 with drag, to the target plane 3 m away"};
}

}  // namespace

std::vector<Benchmark> modelBenchmarks() {
  return {{"dynamics.inverse_us", inverseDynamics},
          {"dynamics.derivatives_vs_kdl", inverseDynamicsDerivatives},
          {"flight.land_us", landing}};
}

}  // namespace fastball::bench
