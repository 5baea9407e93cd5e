#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "config/experiment.h"
#include "launch/judge.h"
#include "launch/results.h"
#include "launch/throw_record.h"
#include "logger/log_summary.h"
#include "logger/run_record.h"

namespace fastball::launch {

/// A throw as a log tells it, with the truth: a report judges, as the results of the run do.
struct LoggedThrow {
  ThrowRecord record;
  Truth truth;
  std::vector<ball_observation_t> observations;  ///< in order
  std::vector<sim_truth_t> flight;               ///< samples of the true ball, in order
  std::string brake;                             ///< why the arm braked, or empty

  bool isMeasured() const { return record.landing && record.landing->measured == 1; }
  bool hasTruth() const { return truth.finished || truth.landing || truth.release_utime; }
};

/// A process of the run, by what its HEARTBEATs say. There is at least one.
struct LoggedProcess {
  std::vector<heartbeat_t> heartbeats;  ///< in order
  const heartbeat_t& last() const { return heartbeats.back(); }
};

/// Everything that a report shows of a run.
struct LoggedRun {
  std::string path;
  std::optional<logger::LogSummary> summary;  ///< none: the log holds no message
  std::optional<logger::WrittenRunRecord> record;
  std::map<int64_t, LoggedThrow> throws;         ///< by number
  std::vector<LoggedProcess> processes;          ///< in the order of their first words
  std::map<std::string, camera_info_t> cameras;  ///< the last CAMERA_INFO of each channel of images
  std::vector<std::string> stops;                ///< reasons of ESTOP
};

/// @throw std::invalid_argument if the file cannot be read.
LoggedRun readRun(const std::string& log_path);

/// The net that a throw was made for: of its PLAN_REQUEST or SCENE, or else the experiment's.
model::Target targetOf(const LoggedThrow& thrown, const config::Experiment& experiment);

/// A throw as the run's own results have it: the same numbers as in `fastball run --json`. Without SIM_TRUTH in the log a hit is
/// one that was measured.
JudgedThrow judgedThrow(int64_t number,
                        const LoggedThrow& thrown,
                        const config::Experiment& experiment);

/// Whether the log tells how the throw ended: not that of one which was cut off.
bool isDecided(const LoggedThrow& thrown);

/// The landing by which a throw is judged [m]: the true one, or where the log has no truth the measured one; or nothing.
std::optional<Eigen::Vector2d> decidingLanding(const LoggedThrow& thrown);

/// The whole ball passed the ring.
bool isClean(const LoggedThrow& thrown, const config::Experiment& experiment);

}  // namespace fastball::launch
