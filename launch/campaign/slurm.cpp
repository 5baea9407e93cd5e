#include "launch/campaign/slurm.h"

#include <fmt/format.h>
#include <unistd.h>

#include <boost/algorithm/string/trim.hpp>
#include <boost/process.hpp>
#include <boost/process/extend.hpp>
#include <boost/tokenizer.hpp>
#include <chrono>
#include <csignal>
#include <iterator>
#include <sstream>
#include <stdexcept>
#include <thread>

#include "launch/child_setup.h"

namespace fastball::launch {
namespace {

namespace bp = boost::process;
constexpr auto kQuestionInterval = std::chrono::seconds(2);
constexpr int kMostUnanswered = 150;  // questions
constexpr int kQuestionsAfterCancel = 30;
// Slurm forgets a job some minutes after its end.
constexpr const char* kForgotten = "Invalid job id";

struct Answer {
  int exit_status = 0;
  std::string output, errors;
};

std::string textOf(std::istream& stream) {
  std::string text{std::istreambuf_iterator<char>(stream), {}};
  boost::trim(text);
  return text;
}

/// Runs one of Slurm's programs in a process group of its own: a Ctrl-C at the terminal is for fastball, which cancels the job.
Answer ask(const std::string& name, const std::vector<std::string>& words) {
  const auto program = bp::search_path(name);
  if (program.empty())
    throw std::invalid_argument(fmt::format(
        "--engine slurm: there is no program '{}' here; it needs Slurm's programs (on Debian the "
        "package slurm-client) on a machine that may submit jobs",
        name));
  bp::ipstream output, errors;
  bp::group own_group;
  const pid_t parent = getpid();
  bp::child child(
      program, bp::args = words, own_group, bp::std_in<bp::null, bp::std_out> output,
      bp::std_err > errors,
      bp::extend::on_exec_setup = [parent](auto& /*executor*/) { prepareChild(parent, SIGTERM); });
  Answer answer;
  answer.output = textOf(output);
  answer.errors = textOf(errors);
  child.wait();
  answer.exit_status = child.exit_code();
  return answer;
}

}  // namespace

std::vector<std::string> wordsOf(const std::string& line) {
  const boost::escaped_list_separator<char> separator("\\", " ", "\"");
  std::vector<std::string> words;
  for (const std::string& word : boost::tokenizer(line, separator)) {
    if (!word.empty())
      words.push_back(word);
  }
  return words;
}

SlurmJob::SlurmJob(std::vector<std::string> words) {
  words.insert(words.begin(), "--parsable");
  const Answer answer = ask("sbatch", words);
  // "number" or "number;cluster"
  std::istringstream parts(answer.output);
  std::getline(parts, number_, ';');
  std::getline(parts, cluster_);
  if (answer.exit_status != 0 || number_.empty())
    throw std::runtime_error(fmt::format("Slurm does not take the job: {}",
                                         answer.errors.empty() ? answer.output : answer.errors));
}

bool SlurmJob::ended() {
  std::vector<std::string> words = {"--noheader", "--jobs=" + number_, "--format=%T %r"};
  if (!cluster_.empty())
    words.push_back("--clusters=" + cluster_);
  const Answer answer = ask("squeue", words);
  if (answer.errors.find(kForgotten) != std::string::npos)
    return true;
  if (answer.exit_status != 0) {
    if (++unanswered_ > kMostUnanswered)
      throw std::runtime_error(fmt::format(
          "Slurm says nothing about job {} any more: {}; the same command goes on from here",
          number_, answer.errors));
    return false;
  }
  unanswered_ = 0;
  waits_for_.clear();
  std::istringstream states(answer.output);
  for (std::string state, reason; states >> state && std::getline(states >> std::ws, reason);) {
    if (state == "PENDING")
      waits_for_ = reason;
  }
  return answer.output.empty();
}

void SlurmJob::cancel() {
  std::vector<std::string> words = {number_};
  if (!cluster_.empty())
    words.push_back("--clusters=" + cluster_);
  const Answer answer = ask("scancel", words);
  if (answer.exit_status != 0)
    throw std::runtime_error(
        fmt::format("Slurm does not cancel job {}: {}", number_, answer.errors));
  for (int i = 0; i < kQuestionsAfterCancel && !ended(); ++i)
    std::this_thread::sleep_for(kQuestionInterval);
}

}  // namespace fastball::launch
