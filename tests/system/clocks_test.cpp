// A machine whose clock is wrong is named, and nothing is started on it: by peers who say that they are somewhere else.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <poll.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "messaging/clock.h"
#include "messaging/lcm_endpoint.h"
#include "tests/config/temporary_folder.h"
#include "tests/system/fastball_run.h"

namespace fastball::system_test {
namespace {

using testing::HasSubstr;
using testing::Not;

/// Says HEARTBEAT for processes of the experiment and tells the time of their machines, with clocks that are off.
class Elsewhere {
 public:
  struct Machine {
    std::string name;
    double clock_ahead;  ///< [s]
    std::vector<std::string> processes;
  };

  Elsewhere(const std::string& url, std::vector<Machine> machines)
      : machines_(std::move(machines)), endpoint_(url) {
    endpoint_.subscribe<clock_probe_t>(messaging::kClock, [this](const clock_probe_t& question) {
      if (question.asked_utime != 0)
        return;
      for (const Machine& machine : machines_) {
        const int64_t now = clock_.wallUs() + std::llround(machine.clock_ahead * 1e6);
        clock_probe_t answer{};
        answer.utime = answer.heard_utime = now;
        answer.asked_utime = question.utime;
        answer.asker_host = question.host;
        answer.asker_pid = question.pid;
        answer.name = machine.processes.front();
        answer.host = machine.name;
        endpoint_.publish(messaging::kClock, answer);
      }
    });
    thread_ = std::thread([this] { work(); });
  }
  ~Elsewhere() {
    end_ = true;
    thread_.join();
  }

 private:
  void work() {
    for (int64_t next = 0; !end_;) {
      pollfd wait{endpoint_.fileDescriptor(), POLLIN, 0};
      poll(&wait, 1, 5);
      endpoint_.drain();
      if (!talks_ || clock_.monotonicUs() < next)
        continue;
      next = clock_.monotonicUs() + 50'000;
      for (const Machine& machine : machines_) {
        for (const std::string& process : machine.processes) {
          heartbeat_t beat{};
          beat.utime = clock_.wallUs();
          beat.name = process;
          beat.host = machine.name;
          beat.version = "test";
          beat.state = "idle";
          beat.pid = 1;
          endpoint_.publish(messaging::kHeartbeat, beat);
        }
      }
    }
  }

 public:
  std::atomic<bool> talks_ = true;

 private:
  std::vector<Machine> machines_;
  messaging::LcmEndpoint endpoint_;
  messaging::SystemClock clock_;
  std::atomic<bool> end_ = false;
  std::thread thread_;
};

class Clocks : public testing::Test {
 protected:
  Clocks() { setenv("XDG_RUNTIME_DIR", folder_.path().c_str(), 1); }
  std::vector<Elsewhere::Machine> machines(double vision_ahead) const {
    return {{"operator", 0, {"logger", "planner"}},
            {"robot", 0.001, {"controller", "hand_server", "sim_bullet"}},
            {"vision", vision_ahead, {"vision_tracker"}}};
  }
  config::TemporaryFolder folder_;
  std::string url_ = messaging::defaultLcmUrl();
};

TEST_F(Clocks, ThatAreTooFarOffAreNamedByTheRunAndNothingIsThrown) {
  const std::string file = folder_.write(
      "system.yaml", fmt::format("lcm_url: '{}'\nclock_limit: 0.5\nprocesses:\n"
                                 "  - {{name: planner, command: [fastball-planner]}}\n",
                                 url_));
  const Elsewhere peers(url_, machines(-3.0));
  const Outcome outcome = fastball({"run", "--system", file, "--throws", "1"});
  EXPECT_EQ(outcome.exit_status, 1);
  EXPECT_THAT(outcome.output, HasSubstr("clocks: operator "));
  EXPECT_THAT(outcome.output, HasSubstr("the clock of vision is "));
  EXPECT_THAT(outcome.output, HasSubstr(" ms behind that of "));
  EXPECT_THAT(outcome.output, HasSubstr("clock_limit is 500.0 ms"));
  EXPECT_THAT(outcome.output, Not(HasSubstr("throw 1")));
}

TEST_F(Clocks, ThatAreTooFarOffAreNamedByUp) {
  const std::string file = folder_.write(
      "system.yaml", fmt::format("lcm_url: '{}'\nclock_limit: 0.5\nprocesses:\n"
                                 "  - {{name: vision_tracker, command: [sleep, '100']}}\n",
                                 url_));
  Elsewhere peers(url_, {{"vision", 2, {"vision_tracker"}}});
  peers.talks_ = false;  // `up` listens first and refuses whom it hears; then it is listed by `ps`
  FastballRun up({"up", file});
  while (up.running() && fastball({"ps", file}).exit_status != 0)
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  peers.talks_ = true;
  const Outcome outcome = up.wait();
  EXPECT_EQ(outcome.exit_status, 1);
  EXPECT_THAT(outcome.output,
              testing::ContainsRegex("the clock of vision is [12][0-9]*\\.[0-9] ms ahead of"));
}

TEST_F(Clocks, AreMeasuredByTheDoctorToWhatTheNetworkAllows) {
  const Elsewhere peers(url_, machines(2.0));
  const Outcome outcome = fastball({"doctor", "--lcm-url", url_});
  EXPECT_EQ(outcome.exit_status, 1);
  EXPECT_THAT(outcome.output, HasSubstr("clock of vision"));
  EXPECT_THAT(outcome.output, HasSubstr("ms from ours, to "));
  EXPECT_THAT(outcome.output, HasSubstr("mend: sudo apt install chrony"));
}

}  // namespace
}  // namespace fastball::system_test
