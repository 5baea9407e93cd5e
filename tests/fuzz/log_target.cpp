// What `fastball log` and everybody who reads logs make of any file.
#include <sys/mman.h>
#include <unistd.h>

#include <filesystem>
#include <sstream>
#include <stdexcept>

#include "launch/report/run_page.h"
#include "logger/log_edit.h"
#include "logger/log_export.h"
#include "logger/log_reader.h"
#include "logger/log_summary.h"
#include "tests/fuzz/node_target.h"

namespace fastball {
namespace {

/// A file in memory.
class MemoryFile {
 public:
  explicit MemoryFile(const char* name) : fd_(memfd_create(name, MFD_CLOEXEC)) {
    if (fd_ < 0)
      fuzz::die("no memory file");
  }
  void hold(const uint8_t* data, std::size_t size) const {
    if (ftruncate(fd_, 0) != 0 || pwrite(fd_, data, size, 0) != static_cast<ssize_t>(size))
      fuzz::die("the memory file does not take the input");
  }
  std::string path() const { return "/proc/self/fd/" + std::to_string(fd_); }

 private:
  int fd_;
};

std::string repairedPath() {
  return std::filesystem::temp_directory_path() / ("fastball-fuzz-" + std::to_string(getpid()));
}

/// A repaired log holds what the reader found in the damaged one, and is whole.
void checkRepair(const std::string& path, const messaging::TypeLibrary& types) {
  std::filesystem::remove(repairedPath());
  const logger::CopyResult copied = logger::copyLog(path, repairedPath());
  if (copied.messages > 0) {
    const logger::LogSummary summary = logger::summarise(repairedPath(), types);
    if (summary.damages != 0 || summary.messages != copied.messages)
      fuzz::die("the repaired log is not whole");
  }
  std::filesystem::remove(repairedPath());
}

}  // namespace
}  // namespace fastball

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, std::size_t size) {
  using namespace fastball;
  static const MemoryFile file("log");
  static const messaging::TypeLibrary types;
  static const config::Experiment experiment =
      config::loadExperiment(FASTBALL_SOURCE_DIR "/config/experiment.yaml");
  file.hold(data, size);
  const std::string path = file.path();
  try {
    checkRepair(path, types);
    const logger::LogSummary summary = logger::summarise(path, types);
    logger::summaryText(summary);
    (void)summary.faults();
    std::ostringstream csv;
    logger::ExportOptions options;
    options.channel = summary.channels.begin()->first;
    logger::exportCsv(path, options, types, csv);
  } catch (const std::invalid_argument&) {  // holds no message, or none that decodes
  }
  const launch::LoggedRun run = launch::readRun(path);
  const std::string page = launch::runPage(run, experiment, {"", launch::missingOf(run), {}}) +
                           throwsCsv(run, experiment);
  if (page.find("<script") != std::string::npos)
    fuzz::die("the report takes text for HTML");
  return 0;
}
