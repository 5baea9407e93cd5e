// The simulator paced by the clock, and with its cameras.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/sim_bullet/simulator_in_process.h"

namespace fastball::sim_bullet {
namespace {

using testing::HasSubstr;

class RealtimeSimulator : public Simulator {
 protected:
  RealtimeSimulator() : Simulator(true) {}
  void runMilliseconds(int ms) {
    for (int i = 0; i < ms; ++i) {
      clock_.advanceUs(1000);
      settle();
    }
  }
};

TEST_F(RealtimeSimulator, KeepsPaceWithTheClock) {
  peers_.sendScene(sceneMessage(1, 0.1));
  settle();
  EXPECT_EQ(peers_.tick(), 0);
  runMilliseconds(10);
  EXPECT_EQ(peers_.tick(), 10);
  clock_.advanceUs(5000);  // the machine was busy
  settle();
  EXPECT_EQ(peers_.tick(), 15);
  runMilliseconds(85);
  EXPECT_EQ(node_.state().state, "finished");
}

TEST_F(RealtimeSimulator, BrakesWhenCommandsStopComing) {
  peers_.sendScene(sceneMessage(1, 2));
  peers_.push = 20;
  settle();
  runMilliseconds(100);
  EXPECT_EQ(node_.state().detail, "");
  const auto speed = [&] { return node_.scene()->state().qd.arm.norm(); };
  const double fast = speed();
  EXPECT_GT(fast, 0.5);
  peers_.answers_arm = false;
  runMilliseconds(20);
  EXPECT_EQ(node_.state().detail, "");  // the last command holds
  runMilliseconds(3);
  EXPECT_THAT(node_.state().detail, HasSubstr("braking"));
  runMilliseconds(500);
  EXPECT_LT(speed(), 0.1 * fast);
  peers_.answers_arm = true;
  peers_.push = 0;
  runMilliseconds(3);
  EXPECT_EQ(node_.state().detail, "");
}

TEST_F(RealtimeSimulator, ARestartedControllerDoesNotGetTheArmInMidScene) {
  peers_.sendScene(sceneMessage(1, 0.5));
  settle();
  runMilliseconds(100);
  peers_.answers_arm = false;
  ScriptedPeers restarted(network_.addEndpoint());
  restarted.answers_hand = false;
  runMilliseconds(30);
  EXPECT_THAT(node_.state().detail, HasSubstr("braking"));
  EXPECT_THAT(node_.state().detail, HasSubstr("has seq 0 at tick "));
}

TEST_F(RealtimeSimulator, BrakesUntilTheFirstCommand) {
  peers_.answers_arm = peers_.answers_hand = false;
  peers_.sendScene(sceneMessage(1, 0.5));
  settle();
  runMilliseconds(300);
  EXPECT_THAT(node_.state().detail, HasSubstr("no ARM_COMMAND for more"));
  EXPECT_LT((node_.scene()->state().q.arm - experiment().q_rest).norm(), 0.01);
}

TEST(SimulatorWithCameras, SaysImagesInTheirWindowAndHowTheCamerasStand) {
  SimulatorSetup with_cameras = setup(false);
  with_cameras.cameras = readCameraRig(kExperimentFile);
  const messaging::ManualClock clock;
  messaging::LocalNetwork network(clock);
  messaging::Endpoint& endpoint = network.addEndpoint();
  messaging::Endpoint& peer_endpoint = network.addEndpoint();
  SimNode node(endpoint, clock, with_cameras);
  network.addNode(node, endpoint);
  ScriptedPeers peers(peer_endpoint);
  std::vector<image_t> left, right;
  std::vector<camera_info_t> infos;
  peer_endpoint.subscribe<image_t>(messaging::kCameraLeft,
                                   [&](const image_t& m) { left.push_back(m); });
  peer_endpoint.subscribe<image_t>(messaging::kCameraRight,
                                   [&](const image_t& m) { right.push_back(m); });
  peer_endpoint.subscribe<camera_info_t>(messaging::kCameraInfo,
                                         [&](const camera_info_t& m) { infos.push_back(m); });
  scene_t scene = sceneMessage(1, 0.1);
  scene.camera_start = 0.02;
  scene.camera_end = 0.06;
  peers.sendScene(scene);
  network.run([] { return false; });
  EXPECT_EQ(node.state().state, "finished");
  ASSERT_EQ(infos.size(), 2u);
  EXPECT_EQ(infos[0].channel, "CAMERA_LEFT");
  const auto expected = static_cast<std::size_t>(0.04 * infos[0].rate);
  EXPECT_NEAR(static_cast<double>(left.size()), static_cast<double>(expected), 1);
  ASSERT_EQ(left.size(), right.size());
  for (std::size_t i = 0; i < left.size(); ++i) {
    EXPECT_EQ(left[i].utime, right[i].utime);
    EXPECT_EQ(left[i].seq, static_cast<int64_t>(i));
    EXPECT_GT(left[i].utime, scene.utime + 20'000);
    EXPECT_LT(left[i].utime, scene.utime + 60'000);
  }
}

}  // namespace
}  // namespace fastball::sim_bullet
