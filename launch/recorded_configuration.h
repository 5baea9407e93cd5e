#pragma once

#include <filesystem>
#include <string>

namespace fastball::launch {

/// The experiment file that a log's run had, with all the files it names: put into a temporary
/// folder from the record beside the log while this object lives. One at a time in a process: the
/// folder bears the process id.
class RecordedConfiguration {
 public:
  /// @param named an experiment file to be taken in place of the recorded one; empty: the recorded one, or the default experiment
  /// if none is recorded.
  /// @throw std::invalid_argument if the record names a file outside its folder.
  /// @throw std::runtime_error if the temporary folder cannot be written.
  RecordedConfiguration(const std::string& log, const std::string& named);
  ~RecordedConfiguration();
  RecordedConfiguration(const RecordedConfiguration&) = delete;
  RecordedConfiguration& operator=(const RecordedConfiguration&) = delete;

  /// Path of the experiment file.
  const std::string& experiment() const { return experiment_; }
  /// It is the one that was recorded.
  bool isRecorded() const { return is_recorded_; }

 private:
  std::filesystem::path folder_;
  std::string experiment_;
  bool is_recorded_ = false;
};

}  // namespace fastball::launch
