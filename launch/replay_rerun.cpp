#include "launch/replay_rerun.h"

#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <deque>
#include <functional>
#include <stdexcept>

#include "config/experiment.h"
#include "launch/processes.h"
#include "launch/roster.h"
#include "logger/log_reader.h"
#include "messaging/lcm_endpoint.h"

namespace fastball::launch {
namespace {

constexpr double kStartTimeout = 30;  ///< [s] wall time
constexpr double kImpatience = 4;
/// [us] An answer stands no further before its input in a log.
constexpr int64_t kLogOrderUs = 5000;

/// What a process of the experiment hears and says.
struct Part {
  std::string name;       ///< for the user
  std::string heartbeat;  ///< its name in HEARTBEAT
  std::string program;
  std::vector<std::string> inputs, outputs;
  double patience;  ///< [s] wall time within which an answer comes, if it comes
};

const std::vector<Part>& parts() {
  using namespace messaging;
  static const std::vector<Part> all{
      {"planner", "planner", "fastball-planner", {kPlanRequest.name}, {kSwingPlan.name}, 120},
      {"controller",
       "controller",
       "fastball-controller",
       {kSwingPlan.name, kThrowStart.name, kArmState.name, kGrip.name, kEstop.name},
       {kArmCommand.name, kControllerStatus.name},
       5},
      {"hand",
       "hand_server",
       "fastball-hand-server",
       {kSwingPlan.name, kThrowStart.name, kArmState.name, kHandState.name, kEstop.name},
       {kHandCommand.name, kGrip.name, kRelease.name},
       5},
      {"tracker",
       "vision_tracker",
       "fastball-vision-tracker",
       {kCameraInfo.name, kPlanRequest.name},  // and the images
       {kBallObservation.name, kBallTrack.name, kLanding.name},
       30}};
  return all;
}

Part partCalled(const std::string& name, const std::string& config_path) {
  const auto found = std::find_if(parts().begin(), parts().end(),
                                  [&](const Part& part) { return part.name == name; });
  if (found == parts().end())
    throw std::invalid_argument(fmt::format("there is no process '{}' to run again", name));
  Part part = *found;
  if (name == "tracker") {
    for (const std::string& camera :
         config::processSection(config_path, "tracker").texts("cameras"))
      part.inputs.push_back(camera);
  }
  return part;
}

bool holds(const std::vector<std::string>& channels, const std::string& channel) {
  return std::find(channels.begin(), channels.end(), channel) != channels.end();
}

/// A URL that no other run uses: LCM tells runs apart by port.
std::string privateUrl() {
  return fmt::format("udpm://239.255.76.67:{}?ttl=0", 20000 + getpid() % 20000);
}

/// One process, fed from a log.
class Rerun {
 public:
  Rerun(const Part& part, const std::string& config_path)
      : part_(part), endpoint_(privateUrl()), roster_(endpoint_) {
    for (const std::string& output : part.outputs) {
      endpoint_.subscribeRaw(output, [this](const std::string& channel, const void* data,
                                            std::size_t size, int64_t /*utime*/) {
        const char* bytes = static_cast<const char*>(data);
        comparison_.say(channel, {bytes, bytes + size});
      });
    }
    processes_.start({part.heartbeat,
                      programFolder() + "/" + part.program,
                      {"--lcm-url", endpoint_.url(), "--config", config_path}});
    if (!waitFor([this] { return roster_.newest(part_.heartbeat) != nullptr; }, kStartTimeout))
      throw std::runtime_error(
          fmt::format("the {} did not start within {} s", part.name, kStartTimeout));
  }

  /// What the recording says next is waited for before the recording goes on: that keeps the process as far behind its inputs
  /// as it was. Only an answer that names its input may stand a little before it in the log, and is waited for a little later.
  void feed(const logger::LogEntry& entry) {
    while (!awaited_.empty() && awaited_.front().first + kLogOrderUs < entry.utime) {
      await(awaited_.front().second);
      awaited_.pop_front();
    }
    if (holds(part_.inputs, entry.channel))
      endpoint_.publishBytes(entry.channel, entry.data.data(), entry.data.size());
    if (!holds(part_.outputs, entry.channel))
      return;
    const auto recorded = comparison_.record(entry.channel, entry.data);
    if (comparison_.isAnswer(entry.data))
      awaited_.emplace_back(entry.utime, recorded);
    else
      await(recorded);
  }

  std::map<std::string, ComparedChannel> finish() {
    waitFor([this] { return comparison_.pending() == 0; }, part_.patience);
    return comparison_.channels();
  }

 private:
  /// What does not come is not said; the next one is waited for less long.
  void await(const MessageComparison::Key& recorded) {
    if (!waitFor([&] { return !comparison_.isPending(recorded); }, patience_))
      patience_ /= kImpatience;
  }

  bool waitFor(const std::function<bool()>& condition, double timeout) {
    using Steady = std::chrono::steady_clock;
    const auto deadline = Steady::now() + std::chrono::duration<double>(timeout);
    while (endpoint_.drain(), !condition()) {
      if (const auto sentence = processes_.ended())
        throw std::runtime_error(*sentence);
      if (Steady::now() > deadline)
        return false;
      pollfd waiting{endpoint_.fileDescriptor(), POLLIN, 0};
      poll(&waiting, 1, 50);
    }
    return true;
  }

  const Part& part_;
  messaging::LcmEndpoint endpoint_;
  Roster roster_;
  Processes processes_;
  MessageComparison comparison_;
  std::deque<std::pair<int64_t, MessageComparison::Key>> awaited_;  // with receive times
  double patience_ = part_.patience;
};

}  // namespace

std::vector<std::string> rerunProcesses() {
  std::vector<std::string> names;
  for (const Part& part : parts())
    names.push_back(part.name);
  return names;
}

std::map<std::string, ComparedChannel> rerun(const std::string& process,
                                             const std::string& log_path,
                                             const std::string& config_path) {
  const Part part = partCalled(process, config_path);
  logger::LogReader reader(log_path);
  Rerun rerun(part, config_path);
  for (logger::LogEntry entry; reader.next(entry);)
    rerun.feed(entry);
  auto channels = rerun.finish();
  const bool any = std::any_of(channels.begin(), channels.end(),
                               [](const auto& channel) { return channel.second.recorded > 0; });
  if (!any)
    throw std::invalid_argument(
        fmt::format("'{}' holds nothing that a {} says, to compare with", log_path, process));
  return channels;
}

}  // namespace fastball::launch
