// fastball-planner as a real process, asked over LCM.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <boost/process.hpp>
#include <chrono>
#include <thread>

#include "messaging/lcm_endpoint.h"
#include "tests/planner/plan_requests.h"

namespace fastball::planner {
namespace {

using namespace std::chrono_literals;
namespace process = boost::process;

/// The experiment's side of a planner process.
class PlannerProcess : public testing::Test {
 protected:
  PlannerProcess() {
    peer_.subscribe<swing_plan_t>(messaging::kSwingPlan,
                                  [this](const swing_plan_t& m) { plans_.push_back(m); });
    peer_.subscribe<heartbeat_t>(messaging::kHeartbeat,
                                 [this](const heartbeat_t& m) { heartbeat_ = m; });
  }
  /// @return false if the condition does not come true within 60 s.
  template <class Condition>
  bool waitFor(Condition condition) {
    for (int i = 0; i < 6000; ++i) {
      peer_.drain();
      if (condition())
        return true;
      std::this_thread::sleep_for(10ms);
    }
    return false;
  }
  void end() {
    kill(planner_.id(), SIGTERM);
    planner_.wait();
  }

  DefaultThrow example_;
  messaging::LcmEndpoint peer_{messaging::defaultLcmUrl()};
  messaging::Publisher<plan_request_t> requests_{peer_, messaging::kPlanRequest};
  std::vector<swing_plan_t> plans_;
  heartbeat_t heartbeat_{};
  process::child planner_{FASTBALL_BIN_DIR "/fastball-planner", "--config", example_.path,
                          process::std_out > process::null};
};

TEST_F(PlannerProcess, PlansAndRepeatsAndEnds) {
  ASSERT_TRUE(waitFor([&] { return heartbeat_.name == "planner"; }));
  EXPECT_EQ(heartbeat_.state, "idle");
  plan_request_t request = requestMessage(example_, 1);
  requests_.publish(request);
  ASSERT_TRUE(waitFor([&] { return plans_.size() == 1; }));
  EXPECT_TRUE(plans_[0].status == swing_plan_t::OK) << plans_[0].message;
  ASSERT_TRUE(waitFor([&] { return heartbeat_.plan_id == 1; }));
  requests_.publish(request);
  ASSERT_TRUE(waitFor([&] { return plans_.size() == 2; }));
  EXPECT_EQ(bytesOf(plans_[0]), bytesOf(plans_[1]));
  end();
  EXPECT_EQ(planner_.exit_code(), 0);
}

TEST_F(PlannerProcess, RefusesWhatItCannotDo) {
  ASSERT_TRUE(waitFor([&] { return heartbeat_.name == "planner"; }));
  plan_request_t request = requestMessage(example_, 1);
  request.strategy = "luck";
  requests_.publish(request);
  ASSERT_TRUE(waitFor([&] { return plans_.size() == 1; }));
  EXPECT_TRUE(plans_[0].status == swing_plan_t::REFUSED);
  EXPECT_THAT(plans_[0].message, testing::HasSubstr("known strategies: paper"));
  end();
}

TEST(PlannerCommandLine, EndsWithStatus2ForAMissingConfiguration) {
  EXPECT_EQ(process::system(FASTBALL_BIN_DIR "/fastball-planner", "--config", "/nowhere.yaml",
                            process::std_out > process::null, process::std_err > process::null),
            2);
}

}  // namespace
}  // namespace fastball::planner
