#pragma once

#include <string>
#include <vector>

namespace fastball::launch {

/// Splits a command line's words at spaces; double quotes hold words together, a backslash takes the next character as it is.
std::vector<std::string> wordsOf(const std::string& line);

/// An array job of Slurm, by its own programs sbatch, squeue and scancel.
class SlurmJob {
 public:
  /// Submits it. @param words of sbatch's command line: options, script, the script's arguments.
  /// @throw std::invalid_argument if sbatch is not installed; std::runtime_error with its words if it refuses.
  explicit SlurmJob(std::vector<std::string> words);

  const std::string& number() const { return number_; }
  /// Asks Slurm; while it gives no answer, the job is taken to go on.
  /// @throw std::runtime_error if it has not answered for five minutes.
  bool ended();
  /// Why some of it waits, in Slurm's words ("Resources"), as of the last question; empty: nothing waits.
  const std::string& waitsFor() const { return waits_for_; }
  /// Cancels it and waits until Slurm has ended it, at most a minute.
  /// @throw std::runtime_error with Slurm's words if it refuses.
  void cancel();

 private:
  std::string number_, cluster_, waits_for_;
  int unanswered_ = 0;
};

}  // namespace fastball::launch
