// Each process is killed, and each is stopped, in each phase of a throw: the run ends and names it, the arm stays within its
// limits and comes to rest within its braking distance, the log can be read, and no process is left.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <map>
#include <set>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "logger/log_reader.h"
#include "messaging/channels.h"
#include "tests/system/arm_witness.h"
#include "tests/system/fastball_run.h"

namespace fastball::system_test {
namespace {

using messaging::LcmEndpoint;
using testing::HasSubstr;

const std::array<std::string, 6> kNames = {"planner",    "controller",     "hand_server",
                                           "sim_bullet", "vision_tracker", "logger"};
/// Who must answer for simulated time to go on: without them the arm stands still in mid-motion.
const std::set<std::string> kInLockstep = {"controller", "hand_server", "sim_bullet"};

/// A phase of a throw, and the message that says that it has begun.
struct Moment {
  const char* name;
  std::function<void(LcmEndpoint&, const std::function<void()>& begun)> subscribe;
};
template <class T, class Is>
Moment moment(const char* name, const messaging::Channel<T>& channel, Is is) {
  return {name, [channel, is](LcmEndpoint& endpoint, const std::function<void()>& begun) {
            endpoint.subscribe<T>(channel, [begun, is](const T& m) {
              if (is(m))
                begun();
            });
          }};
}

constexpr std::size_t kWindingUp = 2;
const std::array<Moment, 6> kMoments = {
    moment("planning", messaging::kPlanRequest, [](const plan_request_t&) { return true; }),
    moment("settling", messaging::kArmState, [](const arm_state_t& m) { return m.tick >= 100; }),
    moment("winding_up",
           messaging::kControllerStatus,
           [](const controller_status_t& m) { return m.phase == arm_command_t::SWING; }),
    moment("releasing",
           messaging::kRelease,
           [](const release_t& m) { return m.event == release_t::COMMANDED; }),
    moment("braking",
           messaging::kControllerStatus,
           [](const controller_status_t& m) { return m.phase == arm_command_t::FOLLOW_THROUGH; }),
    moment("landed", messaging::kSimTruth, [](const sim_truth_t& m) {
      return m.event == sim_truth_t::LANDED;
    })};

std::string programOf(std::string name) {
  std::replace(name.begin(), name.end(), '_', '-');
  return "fastball-" + name;
}

/// Every record of the log can be read. @return damaged places.
int checkLog(const std::string& path) {
  return logger::readLog(path, [](const logger::LogEntry&) {});
}

/// One run, one signal to one of its processes. `number` gives it a network of its own.
void signalOne(const std::string& name,
               int signal,
               const Moment& moment,
               const std::string& config,
               int number) {
  SCOPED_TRACE(fmt::format("{} {}, signal {}", name, moment.name, signal));
  const int port = 40000 + static_cast<int>((getpid() * kNames.size() + number) % 20000);
  FastballRun run({"run", "--throws", "100", "--config", config, "--lcm-url",
                   fmt::format("udpm://239.255.76.67:{}?ttl=0", port)});
  ArmWitness arm;
  std::map<std::string, int> children;
  run.await([&](LcmEndpoint& endpoint, bool&) {
    arm.listen(endpoint);
    moment.subscribe(endpoint, [&] {
      if (!children.empty())
        return;
      children = run.children();
      kill(children.at(programOf(name)), signal);
    });
  });
  const Outcome outcome = run.wait();
  ASSERT_EQ(children.size(), kNames.size()) << "ended before: " << outcome.output;
  EXPECT_EQ(outcome.exit_status, 1);
  const std::string sentence = name + (signal == SIGKILL ? " was ended by signal 9 (Killed)"
                                                         : " has said no HEARTBEAT for ");
  EXPECT_THAT(outcome.output, HasSubstr(sentence));
  EXPECT_THAT(outcome.json.dump(), HasSubstr(sentence));
  for (const auto& [program, pid] : children)
    EXPECT_FALSE(isRunning(pid)) << program << " is left";
  arm.expectLimitsKept();
  if (kInLockstep.count(name) == 0)
    arm.expectRest();
  // Only the logger's own end can cut a record.
  EXPECT_LE(checkLog(run.logPath()), name == "logger" ? 1 : 0);
}

/// One run for each process, at the same time: most of the time of each is waiting.
void signalEach(int signal,
                const std::function<const Moment&(std::size_t)>& moment,
                const std::string& config) {
  std::vector<std::thread> runs;
  for (std::size_t i = 0; i < kNames.size(); ++i) {
    runs.emplace_back(
        [&, i] { signalOne(kNames[i], signal, moment(i), config, static_cast<int>(i)); });
  }
  for (std::thread& run : runs)
    run.join();
}

class KilledProcess : public testing::TestWithParam<std::size_t> {};

TEST_P(KilledProcess, EndsTheRunAndIsNamed) {
  signalEach(
      SIGKILL, [](std::size_t) -> const Moment& { return kMoments[GetParam()]; },
      FASTBALL_SOURCE_DIR "/config/experiment.yaml");
}

INSTANTIATE_TEST_SUITE_P(At,
                         KilledProcess,
                         testing::Range<std::size_t>(0, kMoments.size()),
                         [](const auto& test) { return kMoments[test.param].name; });

/// A stopped process is there and says nothing; the parameter turns the moments against the processes.
class StoppedProcess : public testing::TestWithParam<std::size_t> {};

TEST_P(StoppedProcess, EndsTheRunAndIsNamed) {
  const EditedConfig hasty("experiment.yaml", "answer_timeout: 30.0", "answer_timeout: 4.0");
  signalEach(
      SIGSTOP,
      [](std::size_t i) -> const Moment& { return kMoments[(i + GetParam()) % kMoments.size()]; },
      hasty.experiment());
}

INSTANTIATE_TEST_SUITE_P(Turned, StoppedProcess, testing::Range<std::size_t>(0, kMoments.size()));

/// In real time nobody waits for a process that is stopped in the swing.
class StoppedInRealTime : public testing::Test {
 protected:
  /// Stops the process in the swing, and listens until the run ends.
  Outcome stop(const std::string& name) {
    const EditedConfig hasty("experiment.yaml", "answer_timeout: 30.0", "answer_timeout: 4.0");
    FastballRun run({"run", "--throws", "100", "--realtime", "--config", hasty.experiment()});
    bool stopped = false;
    run.await([&](LcmEndpoint& endpoint, bool&) {
      arm_.listen(endpoint);
      kMoments[kWindingUp].subscribe(endpoint, [&] {
        const auto children = run.children();
        if (!std::exchange(stopped, true) && children.count(programOf(name)) == 1)
          kill(children.at(programOf(name)), SIGSTOP);
      });
      endpoint.subscribe<heartbeat_t>(messaging::kHeartbeat, [&](const heartbeat_t& m) {
        details_.push_back(m.name + ": " + m.detail);
      });
    });
    return run.wait();
  }

  ArmWitness arm_;
  std::vector<std::string> details_;
};

TEST_F(StoppedInRealTime, WithoutItsControllerTheArmComesToRest) {
  const Outcome outcome = stop("controller");
  EXPECT_EQ(outcome.exit_status, 1);
  EXPECT_THAT(outcome.output, HasSubstr("controller has said no HEARTBEAT for "));
  EXPECT_THAT(details_, testing::Contains(HasSubstr("sim_bullet: braking: no ARM_COMMAND for more "
                                                    "than 20 ms")));
  // How fast and far the arm goes meanwhile is a matter of how late a busy machine obeys: the tests in lockstep hold it.
  arm_.expectRest();
}

TEST_F(StoppedInRealTime, WithoutItsRobotTheControllerBrakesAndSaysSo) {
  const Outcome outcome = stop("sim_bullet");
  EXPECT_EQ(outcome.exit_status, 1);
  EXPECT_THAT(outcome.output, HasSubstr("sim_bullet has said no HEARTBEAT for "));
  EXPECT_THAT(details_,
              testing::Contains(HasSubstr("controller: braked: no ARM_STATE for more than 20 ms")));
}

}  // namespace
}  // namespace fastball::system_test
