// The camera as a real process over LCM.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <csignal>
#include <map>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/videoio.hpp>
#include <thread>

#include "config/calibration_file.h"
#include "messaging/image_channel.h"
#include "messaging/lcm_endpoint.h"
#include "tests/config/temporary_folder.h"
#include "tests/messaging/child_process.h"
#include "tests/vision_tracker/messages.h"

namespace fastball::camera {
namespace {

using ::testing::HasSubstr;

constexpr const char* kCamera = FASTBALL_BIN_DIR "/fastball-camera";

class CameraProcess : public ::testing::Test {
 protected:
  /// @return false if `done()` has not come true after 60 s
  template <class Done>
  bool waitFor(messaging::LcmEndpoint& peer, Done done) {
    for (int i = 0; i < 60000; ++i) {
      peer.drain();
      if (done())
        return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return false;
  }
  std::string path(const std::string& name) const { return (folder_.path() / name).string(); }
  std::string video(const std::string& name, double rate, const std::vector<cv::Mat>& images) {
    cv::VideoWriter writer(path(name), cv::CAP_OPENCV_MJPEG,
                           cv::VideoWriter::fourcc('M', 'J', 'P', 'G'), rate, images[0].size(),
                           images[0].channels() == 3);
    for (const cv::Mat& image : images)
      writer.write(image);
    return path(name);
  }
  std::string shortVideo() {
    return video("short.avi", 100,
                 std::vector<cv::Mat>(20, cv::Mat(48, 64, CV_8UC3, cv::Scalar(40, 80, 120))));
  }
  config::TemporaryFolder folder_;
};

/// Two recorded cameras, the real tracker, and a landing that is known.
TEST_F(CameraProcess, TwoVideosGiveTheTrackerALanding) {
  const std::string config_path = ::fastball::testing::experimentPath();
  const config::Experiment experiment = config::loadExperiment(config_path);
  sim_bullet::CameraRigOptions rig_options = sim_bullet::readCameraRig(config_path);
  rig_options.workers = 2;
  sim_bullet::CameraRig rig(rig_options, experiment.arm, experiment.hand, experiment.ball.radius);
  const bench::SyntheticThrow made = bench::makeThrow(experiment, 3);
  std::vector<std::vector<cv::Mat>> images(2);
  for (const sim_bullet::RenderedImage& image : bench::renderThrow(rig, experiment, made, 3))
    images[static_cast<std::size_t>(image.camera)].push_back(
        cv::imdecode(image.jpeg, cv::IMREAD_COLOR));

  messaging::LcmEndpoint peer(messaging::defaultLcmUrl());
  std::vector<landing_t> landings;
  std::map<std::string, std::string> states;
  peer.subscribe<landing_t>(messaging::kLanding,
                            [&](const landing_t& m) { landings.push_back(m); });
  peer.subscribe<heartbeat_t>(messaging::kHeartbeat,
                              [&](const heartbeat_t& m) { states[m.name] = m.state; });
  messaging::ChildProcess tracker(
      {FASTBALL_BIN_DIR "/fastball-vision-tracker", "--config", config_path});
  std::vector<std::unique_ptr<messaging::ChildProcess>> cameras;
  for (std::size_t c = 0; c < 2; ++c) {
    const std::string number = std::to_string(c);
    config::writeCalibration(path(number + ".yaml"), {rig.cameras()[c].camera});
    // At a quarter of its pace the one may begin 0.8 s after the other, and the tracker has time.
    cameras.push_back(std::make_unique<messaging::ChildProcess>(std::vector<std::string>{
        kCamera, "--video", video(number + ".avi", rig.cameras()[c].rate, images[c]), "--channel",
        rig.cameras()[c].channel, "--calib", path(number + ".yaml"), "--exposure", "0.001",
        "--gray", "--speed", "0.25", "--on-request"}));
  }
  ASSERT_TRUE(waitFor(peer,
                      [&] {
                        return states["vision_tracker"] == "idle" &&
                               states["camera_left"] == "waiting" &&
                               states["camera_right"] == "waiting";
                      }))
      << tracker.output() << cameras[0]->output();
  const plan_request_t request = ::fastball::testing::requestMessage(experiment, 1);
  for (int again = 0; again < 3; ++again)
    peer.publish(messaging::kPlanRequest, request);
  ASSERT_TRUE(waitFor(peer, [&] { return !landings.empty(); }));
  ASSERT_EQ(landings[0].measured, 1) << landings[0].message;
  for (int i = 0; i < 2; ++i)
    EXPECT_NEAR(landings[0].landing[i], made.landing.landing[i], 3e-3);
  for (const auto& camera : cameras)
    EXPECT_EQ(camera->stop(SIGINT), 0);
  EXPECT_EQ(tracker.stop(SIGINT), 0);
}

TEST_F(CameraProcess, EndsWithItsVideoAndSaysHowManyImagesThereWere) {
  messaging::ChildProcess camera({kCamera, "--video", shortVideo(), "--channel", "CAMERA_2"});
  EXPECT_EQ(camera.wait(), 0);
  EXPECT_THAT(camera.output(), HasSubstr("20 images said on CAMERA_2"));
  EXPECT_THAT(camera.output(), HasSubstr("without --calib there is no CAMERA_INFO"));
}

TEST_F(CameraProcess, StampsByTheTimeThatItIsGiven) {
  messaging::LcmEndpoint peer(messaging::defaultLcmUrl());
  std::vector<int64_t> times;
  peer.subscribe<image_t>(messaging::imageChannel("CAMERA_2"),
                          [&](const image_t& m) { times.push_back(m.utime); });
  messaging::ChildProcess camera({kCamera, "--video", shortVideo(), "--channel", "CAMERA_2",
                                  "--loop", "--start-utime", "7000000"});
  ASSERT_TRUE(waitFor(peer, [&] { return times.size() >= 50; }));
  for (const int64_t frame : {0, 19, 20, 49})
    EXPECT_EQ(times[static_cast<std::size_t>(frame)], 7'000'000 + 10'000 * frame);
  EXPECT_EQ(camera.stop(SIGTERM), 0);
}

TEST_F(CameraProcess, EndsThoughItsSourceHangs) {
  // Nobody writes into it, so reading it never ends.
  ASSERT_EQ(mkfifo(path("hangs.avi").c_str(), 0600), 0);
  messaging::LcmEndpoint peer(messaging::defaultLcmUrl());
  std::string state;
  peer.subscribe<heartbeat_t>(messaging::kHeartbeat,
                              [&](const heartbeat_t& m) { state = m.state; });
  messaging::ChildProcess camera({kCamera, "--video", path("hangs.avi")});
  ASSERT_TRUE(waitFor(peer, [&] { return state == "opening"; }));
  EXPECT_EQ(camera.stop(SIGINT), 0);
}

TEST_F(CameraProcess, RefusesBadUsageInOneSentence) {
  const std::string file = shortVideo();
  const std::vector<std::pair<std::vector<std::string>, std::string>> cases = {
      {{}, "give either --device or --video"},
      {{"--device", "0", "--video", file}, "give either --device or --video"},
      {{"--device", "94"}, "--device: /dev/video94 does not exist"},
      {{"--video", "/nonexistent.avi"}, "/nonexistent.avi: cannot be read as a video"},
      {{"--video", file, "--channel", "LEFT"}, "--channel: 'LEFT' is no channel of images"},
      {{"--video", file, "--size", "64"}, "--size: '64' is not WIDTHxHEIGHT"},
      {{"--video", file, "--size", "640x480"}, "have 64 x 48 pixels, --size says 640 x 480"},
      {{"--video", file, "--calib", "/nonexistent.yaml"}, "/nonexistent.yaml: cannot be read"},
      {{"--video", file, "--loop", "--on-request"}, "exclude each other"},
      {{"--device", "/dev/null", "--loop"}, "are for --video"},
      {{"--video", file, "--rate", "0"}, "--rate"}};
  for (const auto& [arguments, why] : cases) {
    std::vector<std::string> command = {kCamera};
    command.insert(command.end(), arguments.begin(), arguments.end());
    messaging::ChildProcess camera(command);
    EXPECT_EQ(camera.wait(), 2) << why;
    EXPECT_THAT(camera.output(), HasSubstr(why));
  }
}

TEST_F(CameraProcess, FailsWithADeviceThatIsNoCamera) {
  messaging::ChildProcess camera({kCamera, "--device", "/dev/null"});
  EXPECT_EQ(camera.wait(), 1);
  EXPECT_THAT(camera.output(), HasSubstr("/dev/null: cannot be opened as a V4L2 camera"));
}

}  // namespace
}  // namespace fastball::camera
