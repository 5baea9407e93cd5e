#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <deque>
#include <filesystem>
#include <fstream>
#include <set>
#include <stdexcept>
#include <thread>

#include "launch/campaign/campaign.h"
#include "launch/campaign/engine.h"
#include "launch/campaign/part.h"
#include "launch/campaign/slurm.h"
#include "launch/processes.h"

namespace fastball::launch {
namespace {

namespace fs = std::filesystem;

constexpr int kResubmissions = 3;
constexpr auto kWatchInterval = std::chrono::milliseconds(100);
constexpr int kWatchesPerQuestion = 20;
constexpr std::size_t kLastLines = 3;
constexpr std::size_t kMostNamed = 5;

using Say = std::function<void(const std::string&)>;

std::vector<std::size_t> numbersIn(const std::string& todo) {
  std::ifstream file(todo);
  std::vector<std::size_t> numbers;
  for (std::size_t number = 0; file >> number;)
    numbers.push_back(number);
  return numbers;
}

/// The script that every part of an array job runs. Arguments: program, folder, file of units, number of parts.
std::string writeScript(const std::string& folder) {
  const fs::path path = fs::path(folder) / "part.sh";
  std::ofstream file(path);
  file << "#!/bin/sh\nexec \"$1\" campaign-part \"$2\" --todo \"$3\" --part "
          "\"$SLURM_ARRAY_TASK_ID\" --parts \"$4\"\n";
  if (!file.flush())
    throw std::runtime_error(fmt::format("{}: cannot be written", path.string()));
  return path.string();
}

SlurmJob submit(const std::string& folder,
                const std::string& todo,
                int parts,
                const std::string& sbatch_arguments) {
  // What comes last counts: the user's words overrule the first options, but not the last.
  std::vector<std::string> words = {"--job-name=fastball-campaign", "--ntasks=1",
                                    "--cpus-per-task=1"};
  for (const std::string& word : wordsOf(sbatch_arguments))
    words.push_back(word);
  for (const std::string& word :
       {fmt::format("--array=0-{}", parts - 1), "--chdir=" + folder,
        std::string("--output=slurm-%A-%a.txt"), writeScript(folder), programFolder() + "/fastball",
        folder, todo, std::to_string(parts)})
    words.push_back(word);
  return SlurmJob(words);
}

/// @return false if `watch` said to stop.
bool awaitEnd(SlurmJob& job, const std::function<bool()>& watch, const Say& say) {
  std::set<std::string> said = {"", "None", "Resources", "Priority"};
  for (int i = 1; watch(); ++i) {
    std::this_thread::sleep_for(kWatchInterval);
    if (i % kWatchesPerQuestion != 0)
      continue;
    if (job.ended())
      return true;
    if (said.insert(job.waitsFor()).second)
      say(fmt::format("Slurm's job {} waits: {}", job.number(), job.waitsFor()));
  }
  return false;
}

std::string lastLines(const fs::path& path) {
  std::ifstream file(path);
  std::deque<std::string> lines;
  for (std::string line; std::getline(file, line);) {
    if (!line.empty())
      lines.push_back(line);
    if (lines.size() > kLastLines)
      lines.pop_front();
  }
  std::string text;
  for (const std::string& line : lines)
    text += "\n  " + line;
  return text.empty() ? " nothing" : text;
}

/// What is missing after the last attempt, and what the part that should have done the first of it said.
std::string faultOf(const Campaign& campaign,
                    const std::string& folder,
                    const SlurmJob& job,
                    const std::string& todo,
                    int parts,
                    const std::vector<std::size_t>& missing) {
  const std::vector<Unit> units = unitsOf(campaign);
  std::string names;
  for (std::size_t i = 0; i < missing.size() && i < kMostNamed; ++i) {
    const Unit& unit = units.at(missing[i]);
    names += fmt::format("{}{} seed {}", i == 0 ? "" : ", ",
                         campaign.cases.at(static_cast<std::size_t>(unit.case_index)).name,
                         campaign.seed + unit.set_up);
  }
  if (missing.size() > kMostNamed)
    names += ", ...";
  const std::vector<std::size_t> asked = numbersIn(todo);
  const auto place = std::find(asked.begin(), asked.end(), missing.front()) - asked.begin();
  const std::string output = fmt::format("slurm-{}-{}.txt", job.number(), place % parts);
  return fmt::format("{} set-up{} failed {} times ({}); {} ends with:{}", missing.size(),
                     missing.size() == 1 ? "" : "s", kResubmissions + 1, names, output,
                     lastLines(fs::path(folder) / output));
}

}  // namespace

std::vector<std::string> workWithSlurm(const std::string& folder,
                                       const std::string& first_todo,
                                       const SlurmOptions& options,
                                       const std::function<bool()>& watch,
                                       const Say& say) {
  const std::string where = fs::absolute(folder).lexically_normal().string();
  const Campaign campaign = readCampaign(where);
  std::string todo = fs::absolute(first_todo).lexically_normal().string();
  for (int attempt = 0;; ++attempt) {
    const int parts = std::min(options.parts, static_cast<int>(numbersIn(todo).size()));
    SlurmJob job = submit(where, todo, parts, options.sbatch_arguments);
    say(fmt::format("Slurm's job {} has {} part{}", job.number(), parts, parts == 1 ? "" : "s"));
    if (!awaitEnd(job, watch, say)) {
      job.cancel();
      return {};
    }
    const std::string rest = writeTodo(where, campaign);
    if (rest.empty())
      return {};
    const std::vector<std::size_t> missing = numbersIn(rest);
    if (attempt == kResubmissions)
      return {faultOf(campaign, where, job, todo, parts, missing)};
    say(fmt::format("Slurm's job {} ended without {} of its set-ups; they are submitted again",
                    job.number(), missing.size()));
    todo = rest;
  }
}

}  // namespace fastball::launch
