// A machine that hangs for a while in mid-throw, and thaws: the run ends and says who was silent, or, where it hung itself,
// what the robot did meanwhile; nothing goes on from where it was; the next run hits.
#include <gmock/gmock.h>

#include <chrono>
#include <string>

#include "messaging/clock.h"
#include "tests/system/watched_hosts.h"

namespace fastball::system_test {
namespace {

using testing::HasSubstr;

class FrozenHost : public WatchedHosts {
 protected:
  void expectNextThrowHits() {
    expectArmAtRest();
    const Outcome next = throwOnce();
    ASSERT_EQ(next.exit_status, 0) << next.output;
    EXPECT_TRUE(next.json.at("throws").at(0).at("hit").get<bool>()) << next.output;
  }
};

TEST_F(FrozenHost, IsNamedByTheRunAndTheNextThrowHits) {
  ASSERT_NO_FATAL_FAILURE(upHere(kUsualPlaces, ""));
  for (const std::string host : {"robot", "vision"}) {
    SCOPED_TRACE(host);
    const auto thrown = swing("100");
    hosts_->freeze(host);
    const Outcome outcome = thrown->wait();
    hosts_->thaw(host);
    EXPECT_EQ(outcome.exit_status, 1);
    EXPECT_THAT(outcome.output, HasSubstr("nothing has been heard of "));
    EXPECT_THAT(outcome.output, HasSubstr(" " + host));
    ASSERT_NO_FATAL_FAILURE(expectNextThrowHits());
  }
}

/// The run hangs too. The robot does not wait for it, and the throw that was cut short says so.
TEST_F(FrozenHost, OfTheOperatorLeavesABrakedArmAndAThrowThatSaysWhy) {
  ASSERT_NO_FATAL_FAILURE(upHere(kUsualPlaces, ""));
  const auto thrown = swing("1");
  const int64_t frozen_us = messaging::SystemClock().wallUs();
  hosts_->freeze("operator");
  while (!said("robot", "controller", frozen_us, "nothing has been heard of"))
    pause();
  hosts_->thaw("operator");
  const Outcome outcome = thrown->wait();
  EXPECT_THAT(outcome.output, HasSubstr("nothing has been heard of ")) << outcome.output;
  ASSERT_NO_FATAL_FAILURE(expectNextThrowHits());
}

}  // namespace
}  // namespace fastball::system_test
