#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "logger/recorder.h"

namespace fastball::logger {

/// What a run was, for whoever reads its log later.
struct RunRecord {
  std::string version;
  std::string command_line;
  std::string config_path;
  int64_t seed = 0;
};

/// The same as it was written, with where and when.
struct WrittenRunRecord : RunRecord {
  std::string host;
  int64_t start_utime = 0;  ///< [us since 1970]
  int64_t messages = -1;    ///< that the logger wrote; -1: it did not come to say so
};

/// Path of the record that belongs to a log: the log's path with ".run.json" appended.
std::string runRecordPath(const std::string& log_path);

/// Writes the record beside the log: version, command line, seed, host, start time [us since 1970],
/// and the full text of the configuration file and of every .yaml file in its folder and below, so
/// that the run can be repeated after they have changed. Without a configuration (empty path) there
/// is no text.
/// @throw std::invalid_argument if it cannot be written or the configuration cannot be read.
void writeRunRecord(const std::string& log_path, const RunRecord& record, int64_t start_utime);

/// What the record beside a log says. A member that is missing or makes no sense is left empty.
/// @return nothing if there is no record, or one that is no JSON object.
std::optional<WrittenRunRecord> readRunRecord(const std::string& log_path);

/// Writes the configuration files that the record of a log holds into `folder`, made if absent.
/// @return path of the experiment file, or empty if there is no record or it holds none.
/// @throw std::invalid_argument if a name in the record leads out of the folder.
/// @throw std::runtime_error if a file cannot be written.
std::string restoreConfiguration(const std::string& log_path, const std::string& folder);

/// Adds to the record, if there is one, what became of the recording: files, messages, bytes,
/// `missing` messages by their sequence numbers, and for each channel how many were dropped, from
/// when to when. A failure is said on standard error.
void addRecordingToRunRecord(const std::string& log_path,
                             const Recorder& recorder,
                             int64_t missing);

}  // namespace fastball::logger
