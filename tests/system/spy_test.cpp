// `fastball spy` as scripts use it: what it says about a publisher whose every message is known.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "messaging/lcm_endpoint.h"
#include "tests/messaging/child_process.h"
#include "tests/messaging/examples.h"

namespace fastball::system_test {
namespace {

using messaging::ChildProcess;
using testing::HasSubstr;

constexpr const char* kFastball = FASTBALL_BIN_DIR "/fastball";

/// Bytes on the network of this test, once the spy hears it.
class Publisher {
 public:
  void awaitListener(ChildProcess& spy) {
    do {
      endpoint_.publishBytes("START", "start", 5);
    } while (!spy.waitForOutput("START", 50) && ++tries_ < 400);
  }
  void say(const std::string& channel, const std::string& bytes) {
    endpoint_.publishBytes(channel, bytes.data(), bytes.size());
  }
  template <class T>
  void say(const std::string& channel, const T& message) {
    std::string bytes(static_cast<std::size_t>(message.getEncodedSize()), '\0');
    message.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
    say(channel, bytes);
  }

 private:
  messaging::LcmEndpoint endpoint_{messaging::defaultLcmUrl()};
  int tries_ = 0;
};

/// The last object of each channel. Every line must be one.
std::map<std::string, nlohmann::json> lastOfEachChannel(const std::string& output) {
  std::map<std::string, nlohmann::json> last;
  std::istringstream lines(output);
  for (std::string line; std::getline(lines, line);) {
    const auto object = nlohmann::json::parse(line, nullptr, false);
    EXPECT_TRUE(object.is_object()) << line;
    if (object.is_object())
      last[object.at("channel")] = object;
  }
  return last;
}

TEST(Spy, CountsWhatAPublisherSays) {
  ChildProcess spy({kFastball, "spy", "--json", "--rate", "20"});
  Publisher publisher;
  publisher.awaitListener(spy);
  auto state = messaging::examples::example<arm_state_t>();
  for (state.seq = 0; state.seq < 200; ++state.seq)
    publisher.say("ARM_STATE", state);
  state.seq = 210;
  state.q[1] = 0.5;
  publisher.say("ARM_STATE", state);
  for (const std::string bytes : {"", "x", "no message of any type at all"})
    publisher.say("JUNK", bytes);
  publisher.say("END", std::string("end"));
  EXPECT_TRUE(spy.waitForOutput("\"END\"")) << spy.output();
  EXPECT_EQ(spy.stop(SIGINT), 0);
  auto last = lastOfEachChannel(spy.output());
  EXPECT_EQ(last["ARM_STATE"]["type"], "fastball_arm_state_t");
  EXPECT_EQ(last["ARM_STATE"]["count"], 201);
  EXPECT_EQ(last["ARM_STATE"]["lost"], 10);
  EXPECT_EQ(last["ARM_STATE"]["undecodable"], 0);
  EXPECT_EQ(last["ARM_STATE"]["fields"]["seq"], 210);
  EXPECT_EQ(last["ARM_STATE"]["fields"]["q"]["values"][1], 0.5);
  EXPECT_GT(last["ARM_STATE"]["rate_hz"], 0);
  EXPECT_EQ(last["JUNK"]["count"], 3);
  EXPECT_EQ(last["JUNK"]["undecodable"], 3);
  EXPECT_TRUE(last["JUNK"]["lost"].is_null());
}

TEST(Spy, HearsOnlyTheChannelsThatAreWanted) {
  ChildProcess spy({kFastball, "spy", "--json", "--rate", "20", "--channel", "START|ARM_.*"});
  Publisher publisher;
  publisher.awaitListener(spy);
  publisher.say("HAND_STATE", std::string("x"));
  publisher.say("ARM_STATE", std::string("x"));
  EXPECT_TRUE(spy.waitForOutput("\"ARM_STATE\""));
  EXPECT_EQ(spy.stop(SIGTERM), 0);
  EXPECT_THAT(spy.output(), Not(HasSubstr("HAND_STATE")));
}

TEST(Spy, EndsAfterItsDuration) {
  ChildProcess spy({kFastball, "spy", "--json", "--duration", "2", "--rate", "20"});
  Publisher publisher;
  publisher.awaitListener(spy);
  EXPECT_EQ(spy.wait(), 0);
  EXPECT_GE(lastOfEachChannel(spy.output())["START"]["count"], 1);
}

TEST(Spy, PrintsATableWhereThereIsNoTerminal) {
  ChildProcess spy({kFastball, "spy", "--rate", "20"});
  Publisher publisher;
  publisher.awaitListener(spy);
  publisher.say("HEARTBEAT", messaging::examples::example<heartbeat_t>());
  EXPECT_TRUE(spy.waitForOutput("fastball_heartbeat_t"));
  EXPECT_EQ(spy.stop(SIGINT), 0);
  EXPECT_THAT(spy.output(), HasSubstr("channel"));
  EXPECT_THAT(spy.output(), Not(HasSubstr("\x1b")));
}

TEST(Spy, DrawsOnATerminal) {
  // `script` gives it one.
  ChildProcess spy({"env", "TERM=xterm", "script", "-qec",
                    std::string(kFastball) + " spy --rate 20 --duration 3", "/dev/null"});
  Publisher publisher;
  publisher.awaitListener(spy);
  publisher.say("HEARTBEAT", messaging::examples::example<heartbeat_t>());
  EXPECT_TRUE(spy.waitForOutput("HEARTBEAT")) << spy.output();
  EXPECT_EQ(spy.wait(), 0);
  EXPECT_THAT(spy.output(), HasSubstr("\x1b["));
}

TEST(Spy, RefusesWhatCannotBeInOneSentence) {
  const std::vector<std::pair<std::vector<std::string>, std::string>> wrong{
      {{"--channel", "*"}, "cannot subscribe to *"},
      {{"--types", "/no/such.so"}, "/no/such.so"},
      {{"--rate", "0"}, "--rate"},
      {{"--duration", "-1"}, "--duration"}};
  for (const auto& [arguments, sentence] : wrong) {
    std::vector<std::string> command{kFastball, "spy", "--json"};
    command.insert(command.end(), arguments.begin(), arguments.end());
    ChildProcess spy(command);
    EXPECT_EQ(spy.wait(), 2) << sentence;
    EXPECT_THAT(spy.output(), HasSubstr(sentence));
  }
}

TEST(Spy, SaysWhatTheStockOneLacks) {
  ChildProcess spy({"env", "-u", "DISPLAY", kFastball, "spy", "--gui"});
  EXPECT_EQ(spy.wait(), 1);
  EXPECT_THAT(spy.output(), HasSubstr("lcm-spy cannot start: there is no "));
}

}  // namespace
}  // namespace fastball::system_test
