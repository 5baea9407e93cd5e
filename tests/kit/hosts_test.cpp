#include "tests/kit/hosts.h"

#include <gtest/gtest.h>
#include <poll.h>

#include <chrono>
#include <filesystem>
#include <memory>
#include <thread>

#include "messaging/lcm_endpoint.h"
#include "tests/config/temporary_folder.h"
#include "tests/kit/unreliable_relay.h"

namespace fastball::test_kit {
namespace {

using Steady = std::chrono::steady_clock;

constexpr const char* kChannel = "TEST";

/// Somebody on a host who can be asked what he hears.
class Listener {
 public:
  Listener(const Hosts& hosts, const std::string& host) {
    hosts.on(host, [&] {
      endpoint_ = std::make_unique<messaging::LcmEndpoint>(Hosts::lcmUrl());
      endpoint_->subscribeRaw(
          kChannel, [this](const std::string&, const void*, std::size_t, int64_t) { ++heard_; });
    });
  }
  void say() { endpoint_->publishBytes(kChannel, "x", 1); }
  /// Waits until so many have been heard, ten seconds at most.
  bool await(int count) {
    const auto end = Steady::now() + std::chrono::seconds(10);
    while (heard_ < count && Steady::now() < end) {
      pollfd wait{endpoint_->fileDescriptor(), POLLIN, 0};
      poll(&wait, 1, 10);
      endpoint_->drain();
    }
    return heard_ >= count;
  }
  int heard() {
    endpoint_->drain();
    return heard_;
  }

 private:
  std::unique_ptr<messaging::LcmEndpoint> endpoint_;
  int heard_ = 0;
};

class HostsTest : public testing::Test {
 protected:
  void SetUp() override {
    if (const std::string why = Hosts::whyNot(); !why.empty())
      GTEST_SKIP() << why;
    hosts = std::make_unique<Hosts>(std::vector<std::string>{"robot", "vision", "operator"});
  }
  std::unique_ptr<Hosts> hosts;
};

TEST_F(HostsTest, HearEachOtherUnlessACableIsOut) {
  Listener robot(*hosts, "robot"), vision(*hosts, "vision"), people(*hosts, "operator");
  robot.say();
  EXPECT_TRUE(vision.await(1) && people.await(1) && robot.await(1));
  hosts->cutLink("vision");
  robot.say();
  vision.say();
  EXPECT_TRUE(people.await(2) && robot.await(2));
  EXPECT_TRUE(vision.await(2)) << "its own word";
  hosts->restoreLink("vision");
  robot.say();
  EXPECT_TRUE(vision.await(3) && people.await(3) && robot.await(3));
  EXPECT_EQ(vision.heard(), 3);
  EXPECT_EQ(people.heard(), 3);
}

TEST_F(HostsTest, HaveNamesAndProgramsOfTheirOwn) {
  EXPECT_EQ(hosts->run("robot", {"sh", "-c", "test $(hostname) = robot"}), 0);
  EXPECT_EQ(hosts->run("vision", {"sh", "-c", "exit 3"}), 3);
  EXPECT_EQ(hosts->run("vision", {hosts->sshStandIn(), "robot", "test $(hostname) = robot"}), 0);
}

TEST(UnreliableRelayTest, DelaysEveryMessage) {
  const std::string near = "udpm://239.255.76.67:7668?ttl=0",
                    far = "udpm://239.255.76.67:7669?ttl=0";
  Mischief slow;
  slow.delay = 0.2;
  const UnreliableRelay relay(near, far, slow);
  messaging::LcmEndpoint speaker(near), listener(far);
  Steady::time_point said, heard;
  listener.subscribeRaw(kChannel, [&heard](const std::string&, const void*, std::size_t, int64_t) {
    heard = Steady::now();
  });
  // Again until the relay is there.
  const auto end = Steady::now() + std::chrono::seconds(20);
  for (int i = 0; heard == Steady::time_point() && Steady::now() < end; ++i) {
    if (i == 0)
      said = Steady::now();
    if (i % 50 == 0)
      speaker.publishBytes(kChannel, "x", 1);
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    listener.drain();
  }
  EXPECT_GE(heard - said, std::chrono::milliseconds(200));
}

TEST_F(HostsTest, LoseTheShareOfPacketsThatIsAskedFor) {
  if (hosts->run("robot", {"sh", "-c", "nft list ruleset >/dev/null 2>&1"}) != 0)
    GTEST_SKIP() << "nft does not work here (package nftables, kernel)";
  Listener robot(*hosts, "robot"), vision(*hosts, "vision");
  hosts->losePackets("robot", 0.5);
  constexpr int kSaid = 400;
  for (int i = 0; i < kSaid; ++i)
    vision.say();
  ASSERT_TRUE(vision.await(kSaid));
  hosts->losePackets("robot", 0);
  const int before = robot.heard();
  vision.say();
  ASSERT_TRUE(robot.await(before + 1));
  // Six standard deviations of 10 to either side.
  EXPECT_NEAR(robot.heard(), kSaid / 2, 60);
}

TEST_F(HostsTest, FreezeAndThawWithAllThatRunsOnThem) {
  const config::TemporaryFolder folder;
  const std::string mark = (folder.path() / "mark").string();
  hosts->start("robot", {"sh", "-c", "while :; do echo x >> " + mark + "; sleep 0.01; done"});
  const auto size = [&mark] {
    std::error_code none;
    const auto bytes = std::filesystem::file_size(mark, none);
    return none ? 0 : bytes;
  };
  const auto grows = [&](int looks) {
    for (const auto before = size(); looks > 0 && size() == before; --looks)
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    return looks > 0;
  };
  ASSERT_TRUE(grows(1000));
  hosts->freeze("robot");
  EXPECT_FALSE(grows(10));
  hosts->thaw("robot");
  EXPECT_TRUE(grows(1000));
  hosts->kill("robot");
  EXPECT_FALSE(grows(10));
}

TEST_F(HostsTest, CanHaveASmallDisk) {
  const config::TemporaryFolder folder;
  const std::string write = "head -c 100000 /dev/zero > " + folder.path().string() + "/file";
  hosts->mountDisk("robot", folder.path().string(), 65536);
  EXPECT_NE(hosts->run("robot", {"sh", "-c", write + " 2>/dev/null"}), 0);
  EXPECT_EQ(hosts->run("vision", {"sh", "-c", write}), 0);
}

}  // namespace
}  // namespace fastball::test_kit
