// Three machines, one of them cut off in mid-throw: everybody notices within the silence limit, the arm comes to
// rest, the run ends and says who is silent, the log can be read, and the next run works once the cable is back.
#include <gmock/gmock.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <string>
#include <vector>

#include "logger/log_reader.h"
#include "messaging/clock.h"
#include "tests/system/watched_hosts.h"

namespace fastball::system_test {
namespace {

using testing::HasSubstr;

constexpr int64_t kLimitUs = 500'000;  ///< silence_limit of a system on several hosts
constexpr int64_t kBeatUs = kLimitUs / 5;
constexpr int64_t kTransitUs = 250'000;
const std::vector<std::string> kHosts = {"robot", "vision", "operator"};

class CutOff : public WatchedHosts {
 protected:
  /// Cuts a host off in mid-swing, and holds everybody to what is promised.
  void cutOff(const std::string& host);
  void expectNoticed(const std::string& process, const std::string& on);
  void expectRecovered();
  void expectReadableLog() const;
  /// In a HEARTBEAT since the cut.
  bool robotSaid(const std::string& words, const std::string& state = "") const {
    return said("robot", "sim_bullet", cut_us_, words, state);
  }

  int64_t cut_us_ = 0;  ///< [us since 1970], of the last cut
};

/// By the stamps of the process's own HEARTBEATs. It must notice within the limit from the cut, by its own time: what
/// it was late with the HEARTBEATs that it says meanwhile it did not run, and nobody can notice anything then. The last
/// HEARTBEATs before the cut may have waited in LCM's thread for kTransitUs on a busy machine, and then for what came
/// before them (the tracker's images): two of its loops. PeerWatchTest holds the limit itself, by a clock of its own.
void CutOff::expectNoticed(const std::string& process, const std::string& on) {
  SCOPED_TRACE(process + " on " + on);
  const std::string key = on + "/" + process;
  int64_t before_us = 0, late_us = 0;
  double loop_us = 0;
  for (const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(20);
       std::chrono::steady_clock::now() < deadline; pause()) {
    before_us = late_us = 0;
    loop_us = 0;
    for (const heartbeat_t& beat : ears_.at(on)->beats(key)) {
      if (before_us != 0 && beat.utime > cut_us_)
        late_us += std::max<int64_t>(0, beat.utime - std::max(before_us, cut_us_) - kBeatUs);
      before_us = beat.utime;
      if (beat.utime > cut_us_ - kLimitUs)
        loop_us = std::max(loop_us, beat.loop_max_us);
      if (beat.utime < cut_us_ ||
          beat.detail.find("nothing has been heard of") == std::string::npos)
        continue;
      EXPECT_LE(beat.utime - cut_us_, kLimitUs + kTransitUs + late_us + std::llround(2 * loop_us));
      RecordProperty(key, std::to_string((beat.utime - cut_us_) / 1000) + " ms");
      return;
    }
  }
  FAIL() << "it has never noticed";
}

void CutOff::cutOff(const std::string& host) {
  SCOPED_TRACE(host + " is cut off");
  const auto thrown = swing("100");
  hosts_->cutLink(host);
  cut_us_ = messaging::SystemClock().wallUs();
  for (const auto& [process, on] : places_)
    expectNoticed(process, on);
  const Outcome outcome = thrown->wait();
  EXPECT_EQ(outcome.exit_status, 1);
  EXPECT_THAT(outcome.output, HasSubstr("nothing has been heard of "));
  // Whoever is cut off has heard nothing of the two others.
  for (const std::string& other : kHosts) {
    const bool is_silent = (other == host) != (host == "operator");
    EXPECT_THAT(outcome.output, HasSubstr(is_silent ? " " + other : ""));
  }
  expectArmAtRest();
  hosts_->restoreLink(host);
}

/// Nobody's HEARTBEAT says any more that somebody is silent; but those who stopped for it remember why until the next throw.
void CutOff::expectRecovered() {
  const std::string words = "nothing has been heard";
  const std::vector<std::string> memories = {"braked: " + words, "kept the ball: " + words};
  for (const auto& [process, host] : places_) {
    const auto says = [&, key = host + "/" + process] {
      std::string detail = ears_.at("operator")->beats(key).back().detail;
      for (const std::string& memory : memories)
        if (detail.rfind(memory, 0) == 0)
          detail.erase(0, detail.find(')'));
      return detail;
    };
    for (const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(20);
         says().find(words) != std::string::npos && std::chrono::steady_clock::now() < deadline;)
      pause();
    EXPECT_THAT(says(), testing::Not(HasSubstr(words))) << process;
  }
}

void CutOff::expectReadableLog() const {
  int records = 0;
  EXPECT_EQ(logger::readLog(log_, [&records](const logger::LogEntry&) { ++records; }), 0)
      << "damaged places";
  EXPECT_GT(records, 1000);
}

TEST_F(CutOff, InLockstepEachIsCutOffAndTheNextRunHits) {
  ASSERT_NO_FATAL_FAILURE(upHere(kUsualPlaces, ""));
  for (const std::string& host : kHosts)
    ASSERT_NO_FATAL_FAILURE(cutOff(host));
  const Outcome next = throwOnce();
  ASSERT_EQ(next.exit_status, 0) << next.output;
  EXPECT_TRUE(next.json.at("throws").at(0).at("hit").get<bool>());
  expectRecovered();
  down();
  expectReadableLog();
}

/// The controller is not on the robot's machine here, so that the robot has nobody but itself.
TEST_F(CutOff, InRealTimeTheRobotBrakesByItself) {
  ASSERT_NO_FATAL_FAILURE(upHere({{"logger", "operator"},
                                  {"planner", "operator"},
                                  {"controller", "operator"},
                                  {"hand_server", "operator"},
                                  {"sim_bullet", "robot"},
                                  {"vision_tracker", "vision"}},
                                 ", --realtime"));
  for (const std::string& host : kHosts) {
    do {
      ASSERT_NO_FATAL_FAILURE(cutOff(host));
    } while (
        !robotSaid("", "running"));  // cut off too late, when the throw was over: a busy machine
    // Where the link between the two holds, the controller brakes the arm.
    EXPECT_TRUE(robotSaid("braking: no ARM_COMMAND for more than 20 ms") || host == "vision")
        << host;
  }
  down();
  expectReadableLog();
}

}  // namespace
}  // namespace fastball::system_test
