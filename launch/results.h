#pragma once

#include <Eigen/Core>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "launch/judge.h"

namespace fastball::launch {

/// One throw as the experiment itself saw it, without the truth.
struct Throw {
  int number = 0;                                           ///< 1, 2, ... in this run
  int64_t scene_id = 0;                                     ///< in messages, also the plan's
  double plan_ms = 0;                                       ///< [ms], wall time of the planner
  double planned_speed = 0;                                 ///< [m/s], of the ball when it leaves
  double duration = 0;                                      ///< [s], simulated, of the scene
  bool measured = false;                                    ///< the tracker saw it land
  Eigen::Vector2d landing = Eigen::Vector2d::Zero();        ///< [m], target plane (right, up)
  Eigen::Vector2d landing_sigma = Eigen::Vector2d::Zero();  ///< [m], standard deviations
  std::string note;                                         ///< what went wrong, or empty
};

/// A throw with its truth.
struct JudgedThrow {
  Throw seen;
  Truth truth;
  bool hit = false;  ///< the ball's centre crossed the target plane within the net's radius
};

/// What touched the ball after its release is put into the note.
/// @param target_radius [m], inner, of the net's ring
JudgedThrow judge(const Throw& seen, const Truth& truth, double target_radius);

/// Everything a run leaves behind.
struct RunResult {
  std::string version;
  int64_t seed = 0;
  std::string strategy;
  std::string arm;  ///< profile of the arm
  std::string log;  ///< path of the log, empty: none
  std::vector<JudgedThrow> throws;
  std::vector<double> throw_wall_s;  ///< [s], wall time from one throw's request to its landing
  std::string error;                 ///< why the run failed, empty: it did not

  int hits() const;
};

/// The object of `fastball run --json`. Lengths in mm, what was not measured or did not happen is
/// null.
nlohmann::json toJson(const RunResult& result);

/// "throw 1: planned in 35 ms, released at 5.04 m/s (plan 5.04), landing (+12.1, -3.0) mm +- (1.1,
/// 1.3), true (+11.8, -2.7) mm: hit", and the note in brackets, if there is one.
std::string throwLine(const JudgedThrow& judged);

/// Writes the object to a file. @throw std::runtime_error if it cannot.
void writeJson(const nlohmann::json& object, const std::string& path);

}  // namespace fastball::launch
