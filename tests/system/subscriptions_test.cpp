// Who hears what. The truth is for judging afterwards: no process of the experiment may listen to it.
#include <gmock/gmock.h>

#include "controller/node.h"
#include "hand_server/node.h"
#include "launch/experiment_node.h"
#include "launch/judge.h"
#include "planner/node.h"
#include "sim_bullet/node.h"
#include "tests/system/recording_endpoint.h"
#include "vision_tracker/node.h"

namespace fastball::system_test {
namespace {

using testing::ElementsAre;
using testing::UnorderedElementsAre;

using MakeNode = std::unique_ptr<messaging::Node> (*)(messaging::Endpoint&,
                                                      const messaging::Clock&,
                                                      const messaging::ProcessOptions&);

/// What a process of the default experiment subscribes to.
std::set<std::string> subscriptions(MakeNode make_node) {
  const messaging::ManualClock clock;
  RecordingEndpoint endpoint;
  make_node(endpoint, clock, messaging::ProcessOptions{});
  return endpoint.subscriptions();
}

TEST(Subscriptions, AreThoseOfTheDesign) {
  EXPECT_THAT(subscriptions(planner::makeNode), UnorderedElementsAre("PLAN_REQUEST"));
  EXPECT_THAT(subscriptions(controller::makeNode),
              UnorderedElementsAre("SWING_PLAN", "THROW_START", "ARM_STATE", "GRIP", "ESTOP"));
  EXPECT_THAT(
      subscriptions(hand_server::makeNode),
      UnorderedElementsAre("SWING_PLAN", "THROW_START", "ARM_STATE", "HAND_STATE", "ESTOP"));
  // The last two pace the images.
  EXPECT_THAT(subscriptions(sim_bullet::makeNode),
              UnorderedElementsAre("ARM_COMMAND", "HAND_COMMAND", "SCENE", "BALL_OBSERVATION",
                                   "HEARTBEAT"));
  EXPECT_THAT(
      subscriptions(vision_tracker::makeNode),
      UnorderedElementsAre("CAMERA_LEFT", "CAMERA_RIGHT", "CAMERA_INFO", "PLAN_REQUEST", "SCENE"));
}

TEST(Subscriptions, TheExperimentDoesNotHearTheTruth) {
  const messaging::ManualClock clock;
  RecordingEndpoint endpoint;
  const launch::Roster roster(endpoint);
  const launch::ExperimentNode experiment(endpoint, clock, roster, {});
  EXPECT_THAT(endpoint.subscriptions(),
              UnorderedElementsAre("HEARTBEAT", "SWING_PLAN", "CONTROLLER_STATUS",
                                   "BALL_OBSERVATION", "LANDING"));
}

TEST(Subscriptions, TheJudgeHearsNothingElse) {
  RecordingEndpoint endpoint;
  const launch::Judge judge(endpoint);
  EXPECT_THAT(endpoint.subscriptions(), ElementsAre("SIM_TRUTH"));
}

}  // namespace
}  // namespace fastball::system_test
