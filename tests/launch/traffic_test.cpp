// What `fastball spy` makes of the messages it hears: types, gaps in their numbers, and bytes that
// are no message.
#include "launch/spy/traffic.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <laboratory/whole_t.hpp>
#include <limits>
#include <nlohmann/json.hpp>
#include <random>

#include "launch/spy/traffic_text.h"
#include "messaging/command_trailer.h"
#include "tests/messaging/examples.h"

namespace fastball::launch {
namespace {

using messaging::TypeLibrary;
using messaging::examples::example;
using testing::HasSubstr;

constexpr int64_t kStart = 1'700'000'000'000'000;

template <class T>
std::vector<char> encoded(const T& message) {
  std::vector<char> bytes(static_cast<std::size_t>(message.getEncodedSize()));
  message.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
  return bytes;
}

template <class T>
class Layout : public testing::Test {};
using OwnTypes = testing::Types<arm_command_t,
                                arm_state_t,
                                ball_observation_t,
                                ball_track_t,
                                camera_info_t,
                                controller_status_t,
                                estop_t,
                                grip_t,
                                hand_command_t,
                                hand_state_t,
                                heartbeat_t,
                                image_t,
                                landing_t,
                                logger_status_t,
                                plan_request_t,
                                release_t,
                                scene_t,
                                sim_truth_t,
                                swing_plan_t,
                                throw_start_t>;
TYPED_TEST_SUITE(Layout, OwnTypes);

TYPED_TEST(Layout, SaysSizeAndSequenceNumberOfAMessage) {
  const TypeLibrary types;
  TypeParam message = example<TypeParam>();
  for (const int64_t seq : {int64_t{0}, int64_t{-1}, std::numeric_limits<int64_t>::max()}) {
    message.seq = seq;
    const auto bytes = encoded(message);
    const auto layout = layoutOf(types, *types.typeOf(bytes.data(), bytes.size()));
    EXPECT_EQ(layout.bytes.value_or(bytes.size()), bytes.size());
    EXPECT_EQ(layout.seq(bytes.data(), bytes.size()), seq);
    EXPECT_FALSE(layout.seq(bytes.data(), 20));
  }
}

TEST(LayoutOfTypes, VaryingSizeIsKnownAsSuch) {
  const TypeLibrary types;
  const auto layout = [&](const auto& message) {
    const auto bytes = encoded(message);
    return layoutOf(types, *types.typeOf(bytes.data(), bytes.size()));
  };
  EXPECT_TRUE(layout(arm_state_t{}).bytes);
  EXPECT_FALSE(layout(heartbeat_t{}).bytes);
  EXPECT_FALSE(layout(image_t{}).bytes);
}

class TrafficTest : public testing::Test {
 protected:
  void hear(const std::string& channel, const std::vector<char>& bytes) {
    traffic_.take(channel, bytes.data(), bytes.size(), now_ += 1000);
  }
  void hearSeq(int64_t seq) {
    arm_state_t state = example<arm_state_t>();
    state.seq = seq;
    hear("ARM_STATE", encoded(state));
  }
  void hearHeartbeat(const std::string& name, int64_t seq) {
    heartbeat_t heartbeat = example<heartbeat_t>();
    heartbeat.name = name;
    heartbeat.seq = seq;
    hear("HEARTBEAT", encoded(heartbeat));
  }
  ChannelReport of(const std::string& channel) const {
    for (const ChannelReport& report : traffic_.report(now_)) {
      if (report.channel == channel)
        return report;
    }
    ADD_FAILURE() << "no channel " << channel;
    return {};
  }

  TypeLibrary types_;
  Traffic traffic_{types_};
  int64_t now_ = kStart;
};

TEST_F(TrafficTest, ChannelsHaveTypeCountAndAge) {
  for (int i = 0; i < 100; ++i) {
    hear("CAMERA_LEFT", encoded(example<image_t>()));
    hear("ARM_STATE", encoded(example<arm_state_t>()));
  }
  const auto reports = traffic_.report(now_ + 500'000);
  ASSERT_EQ(reports.size(), 2U);
  EXPECT_EQ(reports[0].channel, "ARM_STATE");
  EXPECT_EQ(reports[0].type, "fastball_arm_state_t");
  EXPECT_EQ(reports[1].type, "fastball_image_t");
  EXPECT_EQ(reports[0].count, 100);
  EXPECT_EQ(reports[0].undecodable, 0);
  EXPECT_NEAR(reports[0].age, 0.5, 1e-9);
  EXPECT_NEAR(reports[1].age, 0.501, 1e-9);
  EXPECT_NEAR(of("ARM_STATE").rate, 500, 1e-6);
}

TEST_F(TrafficTest, CommandsWithATrailerAreMessagesLikeOthers) {
  for (const int64_t seq : {0, 1, 4}) {
    arm_command_t command = example<arm_command_t>();
    command.seq = seq;
    std::vector<char> bytes = encoded(command);
    const std::size_t size = bytes.size();
    bytes.resize(size + messaging::kTrailerBytes, 'x');
    messaging::kTrailerMark.copy(bytes.data() + size, messaging::kTrailerMark.size());
    hear("ARM_COMMAND", bytes);
  }
  EXPECT_EQ(of("ARM_COMMAND").type, "fastball_arm_command_t");
  EXPECT_EQ(of("ARM_COMMAND").undecodable, 0);
  EXPECT_EQ(of("ARM_COMMAND").lost, 2);
  EXPECT_FALSE(traffic_.newestFields("ARM_COMMAND").empty());
}

TEST_F(TrafficTest, GapsInSeqAreLostMessages) {
  for (const int64_t seq : {0, 1, 2, 5, 6, 16})
    hearSeq(seq);
  EXPECT_EQ(of("ARM_STATE").lost, 2 + 9);
}

TEST_F(TrafficTest, ASenderThatBeginsAgainLosesNothing) {
  for (const int64_t seq : {100, 101, 0, 1, 1})
    hearSeq(seq);
  EXPECT_EQ(of("ARM_STATE").lost, 0);
}

TEST_F(TrafficTest, AnySequenceNumbersCountUpwards) {
  constexpr int64_t kMax = std::numeric_limits<int64_t>::max();
  int64_t before = 0;
  for (int i = 0; i < 10; ++i) {
    for (const int64_t seq : {kMax, int64_t{0}, -kMax - 1, kMax - 1}) {
      hearSeq(seq);
      EXPECT_GE(of("ARM_STATE").lost.value(), before);
      before = of("ARM_STATE").lost.value();
    }
  }
}

TEST_F(TrafficTest, SendersOfOneChannelAreCountedEachByItself) {
  for (int64_t seq = 0; seq < 10; ++seq) {
    hearHeartbeat("planner", seq);
    hearHeartbeat("controller", 1000 + seq + (seq > 4 ? 3 : 0));
  }
  EXPECT_EQ(of("HEARTBEAT").lost, 3);
}

TEST_F(TrafficTest, SendersThatDoNotSayTheirNameCannotBeFollowed) {
  for (const int64_t seq : {0, 7, 9}) {
    auto stop = example<estop_t>();
    auto camera = example<camera_info_t>();
    stop.seq = camera.seq = seq;
    hear("ESTOP", encoded(stop));
    hear("CAMERA_INFO", encoded(camera));
  }
  EXPECT_FALSE(of("ESTOP").lost);
  EXPECT_FALSE(of("CAMERA_INFO").lost);
}

TEST_F(TrafficTest, BytesThatAreNoMessageAreCountedAndChangeNothingElse) {
  arm_state_t state = example<arm_state_t>();
  state.q[0] = 0.25;
  hear("ARM_STATE", encoded(state));
  for (std::size_t cut : {std::size_t{0}, std::size_t{3}, std::size_t{8}, std::size_t{50}}) {
    auto bytes = encoded(example<arm_state_t>());
    bytes.resize(cut);
    hear("ARM_STATE", bytes);
  }
  EXPECT_EQ(of("ARM_STATE").undecodable, 4);
  EXPECT_EQ(of("ARM_STATE").count, 5);
  EXPECT_EQ(of("ARM_STATE").type, "fastball_arm_state_t");
  const auto fields = traffic_.newestFields("ARM_STATE");
  const auto q = std::find_if(fields.begin(), fields.end(),
                              [](const auto& field) { return field.name() == "q"; });
  ASSERT_NE(q, fields.end());
  EXPECT_EQ(q->number(0), 0.25);
}

TEST_F(TrafficTest, AMessageOfVaryingSizeIsReadToItsEnd) {
  auto bytes = encoded(example<heartbeat_t>());
  bytes.pop_back();
  hear("HEARTBEAT", bytes);
  EXPECT_EQ(of("HEARTBEAT").undecodable, 1);
  EXPECT_EQ(of("HEARTBEAT").type, "fastball_heartbeat_t");
  EXPECT_TRUE(traffic_.newestFields("HEARTBEAT").empty());
}

TEST_F(TrafficTest, ForeignTypesAreKnownOnceTheirLibraryIsLoaded) {
  laboratory::part_t part{};
  part.n = 2;
  part.values = {1, 2};
  part.label = "first";
  hear("PART", encoded(part));
  EXPECT_EQ(of("PART").undecodable, 1);
  EXPECT_THAT(of("PART").type, HasSubstr("unknown 0x"));
  TypeLibrary more;
  more.load(TYPES_FILE);
  Traffic traffic(more);
  const auto bytes = encoded(part);
  traffic.take("PART", bytes.data(), bytes.size(), now_);
  EXPECT_EQ(traffic.report(now_)[0].type, "laboratory_part_t");
  EXPECT_EQ(traffic.report(now_)[0].undecodable, 0);
  EXPECT_FALSE(traffic.report(now_)[0].lost);
  const auto object =
      toJson(traffic.report(now_)[0], traffic.newestFields("PART"), now_).at("fields");
  EXPECT_EQ(object.at("label"), "first");
  EXPECT_EQ(object.at("values").at("mean"), 1.5);
}

TEST_F(TrafficTest, AnyBytesAreSafe) {
  std::mt19937 random(6);
  const std::vector<std::vector<char>> whole{
      encoded(example<arm_state_t>()), encoded(example<heartbeat_t>()), encoded(example<image_t>()),
      encoded(example<swing_plan_t>())};
  const std::vector<char> hostile{'\x00', '\x01', '\x7f', '\x80', '\xff'};
  for (int trial = 0; trial < 4000; ++trial) {
    auto bytes = whole[random() % whole.size()];
    for (int i = 0; i < 4; ++i)
      bytes[random() % bytes.size()] = hostile[random() % hostile.size()];
    const std::string channel = trial % 2 == 0 ? "HEARTBEAT" : std::string("\xff\x1b[2J\n");
    hear(channel, bytes);
    const auto line = toJson(of(channel), traffic_.newestFields(channel), now_)
                          .dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
    EXPECT_TRUE(nlohmann::json::accept(line)) << line;
  }
  EXPECT_EQ(of("HEARTBEAT").count, 2000);
  EXPECT_GT(of("HEARTBEAT").undecodable, 100);
  for (const std::string& line : trafficTable(traffic_.report(now_)).lines)
    EXPECT_TRUE(std::all_of(line.begin(), line.end(), [](char c) { return c >= ' ' && c <= '~'; }));
}

TEST_F(TrafficTest, ChannelsWithoutEndAreOnlyCounted) {
  for (std::size_t i = 0; i < Traffic::kMaxChannels + 10; ++i)
    hear("CHANNEL_" + std::to_string(i), {});
  EXPECT_EQ(traffic_.report(now_).size(), Traffic::kMaxChannels);
  EXPECT_EQ(traffic_.unlisted(), 10);
}

TEST_F(TrafficTest, AllLinesOfTheTableAreEquallyLong) {
  hearSeq(0);
  hear("A_CHANNEL_WITH_A_LONG_NAME", {'x'});
  hearHeartbeat("planner", 0);
  const TrafficTable table = trafficTable(traffic_.report(now_));
  ASSERT_EQ(table.lines.size(), 3U);
  for (const std::string& line : table.lines)
    EXPECT_EQ(line.size(), table.heading.size());
  for (std::size_t width = table.heading.size() + 1; width > 95; --width) {
    const TrafficTable narrow = trafficTable(traffic_.report(now_), width);
    EXPECT_LE(narrow.heading.size(), width);
    for (const std::string& line : narrow.lines)
      EXPECT_EQ(line.size(), narrow.heading.size());
  }
}

}  // namespace
}  // namespace fastball::launch
