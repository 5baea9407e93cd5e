// Images that a tracker answers one by one, on a network that loses some.
#include "sim_bullet/image_flow.h"

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "messaging/local_network.h"

namespace fastball::sim_bullet {
namespace {

class Flow : public testing::Test {
 protected:
  Flow() {
    for (const auto& channel : {messaging::kCameraLeft, messaging::kCameraRight}) {
      tracker_.subscribe<image_t>(channel, [this, channel](const image_t& m) {
        heard_.push_back(m.utime);
        if (answers_)
          answer(channel.name, m.utime);
      });
    }
  }
  void sayHeartbeat(const std::string& state) {
    heartbeat_t heartbeat{};
    heartbeat.name = "vision_tracker";
    heartbeat.host = "seeing";
    heartbeat.pid = 1;
    heartbeat.version = "0.1.0";
    heartbeat.state = state;
    tracker_.publish(messaging::kHeartbeat, heartbeat);
    deliver();
  }
  void answer(const char* channel, int64_t utime) {
    ball_observation_t answer{};
    answer.channel = channel;
    answer.utime = utime;
    tracker_.publish(messaging::kBallObservation, answer);
  }
  void add(ImageFlow& flow, std::size_t camera, int64_t utime) {
    image_t message{};
    message.utime = utime;
    message.width = message.height = message.row_stride = message.size = 1;
    message.pixelformat = image_t::MJPEG;
    message.data = {0};
    flow.add(camera, message);
  }
  void deliver() {
    network_.run([] { return false; });
  }
  void sayAndDeliver(ImageFlow& flow) {
    flow.say();
    deliver();
  }
  /// What came since the last call: times of the images.
  std::vector<int64_t> heard() { return std::exchange(heard_, {}); }

  using Times = std::vector<int64_t>;
  messaging::ManualClock clock_;
  messaging::LocalNetwork network_{clock_};
  messaging::Endpoint& tracker_ = network_.addEndpoint();
  messaging::Endpoint& endpoint_ = network_.addEndpoint();
  ImageFlow flow_{endpoint_, clock_, {"CAMERA_LEFT", "CAMERA_RIGHT"}, true};
  bool answers_ = true;
  std::vector<int64_t> heard_;
};

TEST_F(Flow, SaysAllAtOnceWhereNoTrackerIs) {
  add(flow_, 0, 1);
  add(flow_, 0, 2);
  sayAndDeliver(flow_);
  EXPECT_EQ(heard(), (Times{1, 2}));
  EXPECT_TRUE(flow_.empty());
}

TEST_F(Flow, SaysTheNextImageOfACameraWhenTheOneBeforeIsAnswered) {
  sayHeartbeat("idle");
  for (const int64_t utime : {1, 2})
    for (const std::size_t camera : {0, 1})
      add(flow_, camera, 10 * utime + static_cast<int64_t>(camera));
  sayAndDeliver(flow_);
  EXPECT_EQ(heard(), (Times{10, 11}));
  EXPECT_FALSE(flow_.empty());
  sayAndDeliver(flow_);
  EXPECT_EQ(heard(), (Times{20, 21}));
  EXPECT_TRUE(flow_.empty());
}

TEST_F(Flow, SaysAnImageAgainUntilItIsAnswered) {
  sayHeartbeat("idle");
  answers_ = false;
  add(flow_, 0, 1);
  add(flow_, 0, 2);
  sayAndDeliver(flow_);
  sayAndDeliver(flow_);
  EXPECT_EQ(heard(), (Times{1}));
  clock_.advanceUs(50000);
  sayAndDeliver(flow_);
  EXPECT_EQ(heard(), (Times{1}));
  answer("CAMERA_RIGHT", 1);  // another camera's
  answer("CAMERA_LEFT", 0);   // another image's
  deliver();
  sayAndDeliver(flow_);
  EXPECT_EQ(heard(), Times{});
  answers_ = true;
  clock_.advanceUs(50000);
  sayAndDeliver(flow_);
  sayAndDeliver(flow_);
  EXPECT_EQ(heard(), (Times{1, 2}));
  EXPECT_TRUE(flow_.empty());
}

TEST_F(Flow, IsBehindWhenManyImagesWait) {
  sayHeartbeat("idle");
  int64_t utime = 0;
  while (!flow_.behind() && utime < 100)
    add(flow_, 1, ++utime);
  EXPECT_EQ(utime, 9);
  sayAndDeliver(flow_);
  EXPECT_FALSE(flow_.behind());
}

TEST_F(Flow, DoesNotWaitForeverNorAgainForATrackerThatDoesNotAnswer) {
  sayHeartbeat("idle");
  answers_ = false;
  add(flow_, 0, 1);
  add(flow_, 0, 2);
  sayAndDeliver(flow_);
  clock_.advanceUs(1000000);
  sayAndDeliver(flow_);
  EXPECT_TRUE(flow_.empty());
  flow_.beginScene();
  add(flow_, 0, 3);
  sayAndDeliver(flow_);
  EXPECT_EQ(heard(), (Times{1, 2, 3}));
  answer("CAMERA_LEFT", 3);  // it is back
  deliver();
  add(flow_, 0, 4);
  sayAndDeliver(flow_);
  EXPECT_FALSE(flow_.empty());
}

TEST_F(Flow, DoesNotWaitForATrackerThatHasEnded) {
  sayHeartbeat("idle");
  sayHeartbeat("ended");
  answers_ = false;
  add(flow_, 0, 1);
  sayAndDeliver(flow_);
  EXPECT_TRUE(flow_.empty());
}

TEST_F(Flow, SaysTheRestWithoutAnswers) {
  sayHeartbeat("idle");
  answers_ = false;
  for (const int64_t utime : {1, 2, 3})
    add(flow_, 0, utime);
  sayAndDeliver(flow_);
  flow_.sayRest();
  deliver();
  EXPECT_EQ(heard(), (Times{1, 2, 3}));
}

TEST_F(Flow, DoesNotWaitInRealTime) {
  ImageFlow flow(endpoint_, clock_, {"CAMERA_LEFT"}, false);
  sayHeartbeat("idle");
  answers_ = false;
  add(flow, 0, 1);
  add(flow, 0, 2);
  sayAndDeliver(flow);
  EXPECT_EQ(heard(), (Times{1, 2}));
}

}  // namespace
}  // namespace fastball::sim_bullet
