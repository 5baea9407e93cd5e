#pragma once

#include <functional>
#include <string>
#include <vector>

namespace fastball::launch {

/// Works on a campaign's folder with processes of this machine, each with every `jobs`-th of the units in `todo` (runPart()).
/// @param watch called ten times a second meanwhile; returns false to stop: the processes do not
///   end the units that they are at, and what they have made of them is lost.
/// @return one sentence for each process that failed; none if it was stopped.
std::vector<std::string> workLocally(const std::string& folder,
                                     const std::string& todo,
                                     int jobs,
                                     const std::function<bool()>& watch);

struct SlurmOptions {
  int parts = 1;                 ///< of the array job; fewer if there are fewer units to do
  std::string sbatch_arguments;  ///< words for sbatch's command line, such as "--partition=short"
};

/// Works on a campaign's folder with an array job of Slurm. Its nodes must see the folder, the
/// program and the files of the campaign's cases under the same paths as this machine. What is
/// missing when the job has ended is submitted again, at most three times.
/// @param watch as for workLocally(); when it returns false the job is cancelled.
/// @param say is told in one line each what becomes of the job.
/// @return one sentence with the units that failed, if any did.
/// @throw std::invalid_argument if Slurm's programs are not installed; std::runtime_error if Slurm refuses the job.
std::vector<std::string> workWithSlurm(const std::string& folder,
                                       const std::string& todo,
                                       const SlurmOptions& options,
                                       const std::function<bool()>& watch,
                                       const std::function<void(const std::string&)>& say);

}  // namespace fastball::launch
