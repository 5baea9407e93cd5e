// The planner's node in one process, a scripted experiment beside it.

#include "planner/node.h"

#include <gmock/gmock.h>

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <set>

#include "messaging/local_network.h"
#include "tests/planner/plan_requests.h"

namespace fastball::planner {
namespace {

using testing::HasSubstr;
using testing::SizeIs;

class PlannerNode : public testing::Test {
 protected:
  PlannerNode() {
    network_.addNode(*node_, planner_end_);
    peer_.subscribe<swing_plan_t>(messaging::kSwingPlan,
                                  [this](const swing_plan_t& m) { plans_.push_back(m); });
    peer_.subscribe<heartbeat_t>(messaging::kHeartbeat, [this](const heartbeat_t& m) {
      states_.insert(m.state);
      heartbeat_ = m;
    });
  }
  void ask(const plan_request_t& request) {
    requests_.publish(request_ = request);
    network_.run([] { return false; });
  }

  /// Without an atlas, as the library below plans.
  const int no_cache_ = setenv("XDG_CACHE_HOME", "/nonexistent", 1);
  DefaultThrow example_;
  messaging::ManualClock clock_;
  messaging::LocalNetwork network_{clock_};
  messaging::Endpoint& planner_end_ = network_.addEndpoint();
  messaging::Endpoint& peer_ = network_.addEndpoint();
  std::unique_ptr<messaging::Node> node_ = makeNode(planner_end_, clock_, options());
  messaging::Publisher<plan_request_t> requests_{peer_, messaging::kPlanRequest};
  plan_request_t request_{};
  std::vector<swing_plan_t> plans_;
  std::set<std::string> states_;
  heartbeat_t heartbeat_{};

 private:
  messaging::ProcessOptions options() const {
    messaging::ProcessOptions result;
    result.config = example_.path;
    return result;
  }
};

TEST_F(PlannerNode, AnswersARequestWithItsPlan) {
  ask(requestMessage(example_, 7));
  ASSERT_THAT(plans_, SizeIs(1));
  const swing_plan_t& plan = plans_[0];
  EXPECT_TRUE(plan.status == swing_plan_t::OK) << plan.message;
  EXPECT_EQ(plan.plan_id, 7);
  EXPECT_EQ(plan.strategy, "paper");
  EXPECT_LT(bytesOf(plan).size(), 60000U);
  EXPECT_EQ(plan.q.front(), std::vector<double>(request_.q_arm, request_.q_arm + 4));
  EXPECT_EQ(heartbeat_.plan_id, 7);
  EXPECT_THAT(states_, testing::UnorderedElementsAre("idle", "planning"));
  EXPECT_EQ(heartbeat_.state, "idle");
}

TEST_F(PlannerNode, CarriesThePlanOfTheLibrary) {
  ask(requestMessage(example_, 1));
  ASSERT_THAT(plans_, SizeIs(1));
  const auto plan = std::get<Plan>(Planner(example_.config).plan(example_.request()));
  ASSERT_EQ(plans_[0].n_samples, static_cast<int>(plan.trajectory.samples().size()));
  for (int k = 0; k < plans_[0].n_samples; ++k) {
    for (int j = 0; j < model::kArmJoints; ++j) {
      ASSERT_EQ(plans_[0].q[k][j], plan.trajectory.samples()[k].q[j]);
      ASSERT_EQ(plans_[0].qd[k][j], plan.trajectory.samples()[k].qd[j]);
      ASSERT_EQ(plans_[0].qdd[k][j], plan.trajectory.samples()[k].qdd[j]);
    }
  }
  EXPECT_EQ(plans_[0].v_WBall_release[2], plan.release.v_WBall.z());
  EXPECT_EQ(plans_[0].t_release_command, plan.t_release_command);
  EXPECT_EQ(plans_[0].q_wrist[0], plan.wrist_roll);
}

TEST_F(PlannerNode, RepeatsItsAnswerToARepeatedRequest) {
  plan_request_t request = requestMessage(example_, 1);
  ask(request);
  request.utime = 123;
  ask(request);
  ASSERT_THAT(plans_, SizeIs(2));
  EXPECT_EQ(bytesOf(plans_[0]), bytesOf(plans_[1]));
}

TEST_F(PlannerNode, AnswersOnceWhenARequestIsRepeatedMeanwhile) {
  plan_request_t request = requestMessage(example_, 1);
  requests_.publish(request);
  ask(request);
  EXPECT_THAT(plans_, SizeIs(1));
}

TEST_F(PlannerNode, DoesNotTakeAnOldAnswerForANewQuestionOfTheSameNumber) {
  plan_request_t request = requestMessage(example_, 1);
  ask(request);
  request.p_WTarget[1] = 0.3;
  ask(request);
  ASSERT_THAT(plans_, SizeIs(2));
  EXPECT_NE(plans_[0].q, plans_[1].q);
}

TEST_F(PlannerNode, SaysWhyItRefuses) {
  plan_request_t request = requestMessage(example_, 3);
  request.p_WTarget[0] = 10;
  ask(request);
  ASSERT_THAT(plans_, SizeIs(1));
  EXPECT_TRUE(plans_[0].status == swing_plan_t::REFUSED);
  EXPECT_EQ(plans_[0].plan_id, 3);
  EXPECT_EQ(plans_[0].n_samples, 0);
  EXPECT_THAT(plans_[0].message, HasSubstr("out of reach"));
  EXPECT_EQ(heartbeat_.detail, plans_[0].message);
}

TEST(PlannerConfig, RefusesAShareAboveOne) {
  const std::string path = testing::TempDir() + "planner_share.yaml";
  std::string text;
  {
    std::ifstream in(DefaultThrow{}.path);
    text.assign(std::istreambuf_iterator<char>(in), {});
  }
  const std::string folder = FASTBALL_SOURCE_DIR "/config/";
  const auto replace = [&](const std::string& from, const std::string& to) {
    const auto at = text.find(from);
    ASSERT_NE(at, std::string::npos) << from;
    text.replace(at, from.size(), to);
  };
  replace("arm: arm/", "arm: " + folder + "arm/");
  replace("hand: hand", "hand: " + folder + "hand");
  replace("ball: ball", "ball: " + folder + "ball");
  replace("limit_share: 0.998", "limit_share: 1.5");
  std::ofstream(path) << text;
  try {
    loadConfig(path);
    FAIL() << "no error";
  } catch (const config::ConfigError& e) {
    EXPECT_THAT(e.what(), testing::AllOf(HasSubstr("limit_share"), HasSubstr("1.5")));
  }
}

}  // namespace
}  // namespace fastball::planner
