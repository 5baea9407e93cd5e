#include "launch/experiment_node.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <iterator>
#include <ostream>
#include <string>

#include "launch/judge.h"
#include "tests/launch/scripted_peers.h"

namespace fastball::launch {
namespace {

using messaging::LocalNetwork;
using messaging::ManualClock;
using testing::HasSubstr;
using Phase = ExperimentNode::Phase;

RunSettings threeThrows(const std::string& strategy) {
  RunSettings settings;
  settings.throws = 3;
  settings.seed = 7;
  settings.strategy = strategy;
  settings.q_rest = {-1.0, 1.2, 0.0, 1.5};
  settings.target.p_WTarget = {3.0, 0.0, -0.5};
  settings.target.radius = 0.1;
  settings.ball.mass = 0.1;
  settings.config.adaptive = {0.1, 0.1, 0.01, 0.1, 0.03, 3.0};
  settings.config.settle = 0.6;
  settings.config.scene_period = 10.0;
  settings.config.camera_lead = 0.15;
  settings.config.camera_tail = 0.1;
  settings.config.scene_tail = 0.2;
  settings.config.repeat_interval = 0.1;
  settings.config.answer_timeout = 30.0;
  return settings;
}

class ExperimentNodeTest : public testing::Test {
 protected:
  explicit ExperimentNodeTest(const std::string& strategy = "paper")
      : experiment(endpoint, clock, roster, threeThrows(strategy)) {
    network.addNode(experiment, endpoint);
  }

  /// Lets messages flow until the run is over or all stand still.
  bool flow() {
    return network.run([this] { return experiment.finished(); });
  }
  void wait(double seconds) { clock.advanceUs(static_cast<int64_t>(seconds * 1e6)); }

  ManualClock clock;
  LocalNetwork network{clock};
  ScriptedPeers peers{network};
  messaging::Endpoint& endpoint = network.addEndpoint();
  Roster roster{endpoint};
  Judge judge{network.addEndpoint()};
  ExperimentNode experiment;
};

TEST_F(ExperimentNodeTest, ConductsThreeThrowsOneAfterTheOther) {
  ASSERT_TRUE(flow());
  EXPECT_EQ(experiment.phase(), Phase::kDone) << experiment.error();
  ASSERT_EQ(experiment.throws().size(), 3U);
  ASSERT_EQ(peers.scenes.size(), 3U);
  for (int k = 1; k <= 3; ++k) {
    EXPECT_EQ(peers.requests[k - 1].request_id, k);
    EXPECT_EQ(peers.starts[k - 1].plan_id, k);
    EXPECT_EQ(peers.scenes[k - 1].scene_id, k);
    EXPECT_EQ(peers.scenes[k - 1].utime, k * 10000000);
    EXPECT_EQ(peers.starts[k - 1].start_utime, k * 10000000 + 600000);
    EXPECT_EQ(experiment.throws()[k - 1].number, k);
    EXPECT_DOUBLE_EQ(experiment.throws()[k - 1].landing.x(), 0.01);
    EXPECT_DOUBLE_EQ(experiment.throws()[k - 1].landing_sigma.y(), 0.002);
    EXPECT_DOUBLE_EQ(experiment.throws()[k - 1].planned_speed, 6.0);
    EXPECT_TRUE(judge.of(k).finished);
  }
}

TEST_F(ExperimentNodeTest, SaysAnOrderAgainUntilItIsAnswered) {
  peers.arms = false;
  EXPECT_FALSE(flow());
  EXPECT_EQ(peers.starts.size(), 1U);
  wait(0.1);
  EXPECT_FALSE(flow());
  EXPECT_EQ(peers.starts.size(), 2U);
  EXPECT_TRUE(peers.scenes.empty());
  peers.arms = true;
  wait(0.1);
  EXPECT_TRUE(flow());
  EXPECT_EQ(experiment.phase(), Phase::kDone);
}

TEST_F(ExperimentNodeTest, FailsWithTheSentenceOfThePlanner) {
  peers.refusal = "the target is 9.2 m away";
  EXPECT_TRUE(flow());
  EXPECT_EQ(experiment.phase(), Phase::kFailed);
  EXPECT_THAT(experiment.error(), HasSubstr("the target is 9.2 m away"));
  EXPECT_TRUE(peers.scenes.empty());
}

TEST_F(ExperimentNodeTest, FailsWithTheSentenceOfAProcessThatRefusesThePlan) {
  peers.arms = false;
  EXPECT_FALSE(flow());
  peers.controller.own_state = {"refused", "plan 1 starts elsewhere", 1};
  EXPECT_TRUE(flow());
  EXPECT_THAT(experiment.error(), HasSubstr("controller refused: plan 1 starts elsewhere"));
}

struct Silence {
  const char* who;
  bool ScriptedPeers::*answers;
  const char* sentence;
};
std::ostream& operator<<(std::ostream& out, const Silence& silence) {
  return out << silence.who;
}

class SilenceTest : public ExperimentNodeTest, public testing::WithParamInterface<Silence> {};

TEST_P(SilenceTest, IsNamedAfterTheTimeout) {
  peers.*GetParam().answers = false;
  EXPECT_FALSE(flow());
  wait(29.9);
  EXPECT_FALSE(flow());
  wait(0.2);
  EXPECT_TRUE(flow());
  EXPECT_EQ(experiment.phase(), Phase::kFailed);
  EXPECT_THAT(experiment.error(), HasSubstr(GetParam().sentence));
  network.run([] { return false; });
  EXPECT_EQ(peers.estops.size(), 1U) << "whatever still moves shall brake";
}

INSTANTIATE_TEST_SUITE_P(OfEachPeer,
                         SilenceTest,
                         testing::Values(Silence{"planner", &ScriptedPeers::plans,
                                                 "planner did not answer PLAN_REQUEST"},
                                         Silence{"controller", &ScriptedPeers::arms,
                                                 "not taken by controller (planned)"},
                                         Silence{"sim_bullet", &ScriptedPeers::plays,
                                                 "sim_bullet did not answer SCENE"}),
                         [](const auto& test) { return test.param.who; });

TEST_F(ExperimentNodeTest, AThrowThatStopsIsNamedWithWhatTheRobotSaysOfIt) {
  peers.plays = false;
  EXPECT_FALSE(flow());
  peers.sim_bullet.own_state = {"running", "refused 1 ARM_COMMAND of a second sender", 1};
  EXPECT_FALSE(flow());
  EXPECT_EQ(experiment.phase(), Phase::kThrowing);
  wait(30.1);
  EXPECT_TRUE(flow());
  EXPECT_THAT(experiment.error(), HasSubstr("the scene stopped at "));
  EXPECT_THAT(experiment.error(), HasSubstr("(sim_bullet: refused 1 ARM_COMMAND"));
}

TEST_F(ExperimentNodeTest, APlannerThatDoesNotAnswerIsQuoted) {
  peers.plans = false;
  peers.planner.own_state = {"idle", "refused 1 PLAN_REQUEST", 0};
  EXPECT_FALSE(flow());
  wait(30.1);
  EXPECT_TRUE(flow());
  EXPECT_THAT(experiment.error(), HasSubstr("(planner: refused 1 PLAN_REQUEST)"));
}

TEST_F(ExperimentNodeTest, AThrowWithoutALandingIsAResult) {
  peers.measures = false;
  EXPECT_FALSE(flow());
  for (int k = 1; k <= 3; ++k) {
    wait(30.1);
    flow();
  }
  EXPECT_EQ(experiment.phase(), Phase::kDone);
  ASSERT_EQ(experiment.throws().size(), 3U);
  EXPECT_FALSE(experiment.throws()[2].measured);
  EXPECT_THAT(experiment.throws()[2].note, HasSubstr("no LANDING"));
}

TEST_F(ExperimentNodeTest, AsksAgainForALandingThatWasLost) {
  peers.measures = false;
  EXPECT_FALSE(flow());
  EXPECT_EQ(peers.scenes.size(), 1U);
  peers.measures = true;
  wait(0.1);
  EXPECT_TRUE(flow());
  ASSERT_EQ(experiment.throws().size(), 3U);
  EXPECT_TRUE(experiment.throws()[0].measured);
  EXPECT_EQ(peers.scenes.size(), 4U);
}

TEST_F(ExperimentNodeTest, AThrowSaysThatTheHandKeptTheBallAndWhy) {
  peers.kept = "kept the ball: nothing has been heard of one";
  ASSERT_TRUE(flow());
  EXPECT_EQ(experiment.throws().at(0).note,
            "the hand kept the ball: nothing has been heard of one");
}

class AdaptiveExperiment : public ExperimentNodeTest {
 protected:
  AdaptiveExperiment() : ExperimentNodeTest("adaptive") {}
  /// Of the last throw's aim.
  bool hasLearned() {
    flow();
    const auto& biases = peers.requests.back().biases;
    return std::any_of(std::begin(biases), std::end(biases), [](double b) { return b != 0; });
  }
};

TEST_F(AdaptiveExperiment, LearnsFromThrows) {
  EXPECT_TRUE(hasLearned());
  EXPECT_EQ(experiment.throws().size(), 3U);
}

TEST_F(AdaptiveExperiment, LearnsNothingFromThrowsInWhichTheArmBraked) {
  peers.braked = "braked: pushed";
  EXPECT_FALSE(hasLearned());
  ASSERT_EQ(experiment.throws().size(), 3U);
  EXPECT_EQ(experiment.throws()[2].note, "the arm braked: pushed");
}

TEST_F(ExperimentNodeTest, AnEstopIsSaidHoweverLongItsReason) {
  peers.plays = false;
  EXPECT_FALSE(flow());
  experiment.stop(std::string(5000, 'x'));
  network.run([] { return false; });
  ASSERT_EQ(peers.estops.size(), 1U);
  EXPECT_EQ(experiment.error().size(), 5000U);
}

TEST_F(ExperimentNodeTest, StopSaysEstop) {
  peers.plays = false;
  EXPECT_FALSE(flow());
  experiment.stop("interrupted");
  flow();
  EXPECT_EQ(experiment.phase(), Phase::kFailed);
  network.run([] { return false; });
  ASSERT_EQ(peers.estops.size(), 1U);
  EXPECT_EQ(peers.estops[0].reason, "interrupted");
}

}  // namespace
}  // namespace fastball::launch
