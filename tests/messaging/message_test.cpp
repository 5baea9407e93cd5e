// What holds for every message type: a valid one passes, survives the wire, and no broken one does.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <random>
#include <regex>
#include <set>
#include <sstream>

#include "messaging/channels.h"
#include "messaging/message_type.h"
#include "tests/messaging/examples.h"
#include "tests/messaging/fields.h"

namespace fastball::messaging {
namespace {

using examples::example;
using examples::numbers;

template <class T>
std::vector<uint8_t> encoded(const T& message) {
  std::vector<uint8_t> bytes(static_cast<std::size_t>(message.getEncodedSize()));
  EXPECT_EQ(message.encode(bytes.data(), 0, static_cast<int>(bytes.size())),
            static_cast<int>(bytes.size()));
  return bytes;
}

template <class T>
int decode(T& message, const std::vector<uint8_t>& bytes) {
  return messageType<T>().decode(&message, bytes.data(), static_cast<int>(bytes.size()));
}

/// Names of the fields that the .lcm file declares as double.
std::set<std::string> declaredDoubles(const std::string& type) {
  std::ifstream file(std::string(FASTBALL_SOURCE_DIR "/lcmtypes/") + type + ".lcm");
  std::set<std::string> names;
  const std::regex declaration(R"(^\s*double\s+(\w+))");
  std::smatch match;
  for (std::string line; std::getline(file, line);) {
    if (std::regex_search(line, match, declaration))
      names.insert(match[1]);
  }
  return names;
}

template <class T>
class EveryMessage : public ::testing::Test {};

using Types = ::testing::Types<arm_state_t,
                               arm_command_t,
                               hand_state_t,
                               hand_command_t,
                               scene_t,
                               throw_start_t,
                               estop_t,
                               plan_request_t,
                               swing_plan_t,
                               controller_status_t,
                               grip_t,
                               release_t,
                               image_t,
                               camera_info_t,
                               sim_truth_t,
                               ball_observation_t,
                               ball_track_t,
                               landing_t,
                               logger_status_t,
                               heartbeat_t,
                               clock_probe_t>;

struct TypeName {
  template <class T>
  static std::string GetName(int /*index*/) {  // NOLINT(readability-identifier-naming)
    return T::getTypeName();
  }
};
TYPED_TEST_SUITE(EveryMessage, Types, TypeName);

TYPED_TEST(EveryMessage, ValidOnePasses) {
  EXPECT_EQ(fault(example<TypeParam>()), std::nullopt);
}

TYPED_TEST(EveryMessage, EveryNumberMustBeFinite) {
  std::set<std::string> named;
  const auto count = [] {
    TypeParam m = example<TypeParam>();
    return numbers(m).size();
  }();
  for (std::size_t i = 0; i < count; ++i) {
    for (const double bad : {NAN, INFINITY, -INFINITY}) {
      TypeParam m = example<TypeParam>();
      *numbers(m)[i] = bad;
      const auto why = fault(m);
      ASSERT_TRUE(why) << "number " << i << " of " << TypeParam::getTypeName();
      std::smatch match;
      ASSERT_TRUE(std::regex_match(
          *why, match, std::regex(R"([A-Z_]+: (\w+)(\[\d+\])*(\[\d+\])* (is -?(nan|inf)).*)")))
          << *why;
      named.insert(match[1]);
    }
  }
  EXPECT_EQ(named, declaredDoubles(TypeParam::getTypeName()));
}

TYPED_TEST(EveryMessage, TimeAndNumberAreNotNegative) {
  TypeParam m = example<TypeParam>();
  m.utime = -1;
  EXPECT_THAT(fault(m).value_or(""), ::testing::HasSubstr("utime is -1"));
  m = example<TypeParam>();
  m.seq = -1;
  EXPECT_THAT(fault(m).value_or(""), ::testing::HasSubstr("seq is -1"));
}

TYPED_TEST(EveryMessage, SurvivesTheWire) {
  const TypeParam sent = example<TypeParam>();
  const auto bytes = encoded(sent);
  TypeParam received{};
  ASSERT_EQ(decode(received, bytes), static_cast<int>(bytes.size()));
  EXPECT_EQ(encoded(received), bytes);
}

TYPED_TEST(EveryMessage, TruncatedOrPaddedBytesDoNotDecode) {
  const auto bytes = encoded(example<TypeParam>());
  TypeParam m{};
  for (std::size_t n = 0; n < bytes.size(); ++n) {
    EXPECT_LT(decode(m, {bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(n)}), 0) << n;
  }
  auto padded = bytes;
  padded.push_back(0);
  EXPECT_LT(decode(m, padded), 0);
}

TYPED_TEST(EveryMessage, WrongFingerprintDoesNotDecode) {
  auto bytes = encoded(example<TypeParam>());
  bytes[3] ^= 1;
  TypeParam m{};
  EXPECT_LT(decode(m, bytes), 0);
}

TYPED_TEST(EveryMessage, HostileLengthsAreSafe) {
  // Every aligned and unaligned place is made a hostile length in turn; most are none, and then the message may decode.
  const auto bytes = encoded(example<TypeParam>());
  TypeParam m{};
  for (const uint32_t length : {0xffffffffU, 0x80000000U, 0x7fffffffU, 600'000'000U, 0U}) {
    for (std::size_t i = 8; i + 4 <= bytes.size(); ++i) {
      auto hostile = bytes;
      for (std::size_t k = 0; k < 4; ++k)
        hostile[i + k] = static_cast<uint8_t>(length >> (24 - 8 * k));
      if (decode(m, hostile) >= 0)
        fault(m);
    }
  }
}

TYPED_TEST(EveryMessage, RandomBytesAreSafe) {
  std::mt19937 random(42);
  const auto bytes = encoded(example<TypeParam>());
  TypeParam m{};
  for (int trial = 0; trial < 5000; ++trial) {
    auto hostile = bytes;
    for (int flips = 0; flips < 1 + trial % 8; ++flips)
      hostile[8 + random() % (bytes.size() - 8)] = static_cast<uint8_t>(random());
    hostile.resize(bytes.size() - (trial % 5 == 0 ? random() % bytes.size() : 0));
    if (decode(m, hostile) >= 0)
      fault(m);
  }
}

/// Encoded size with every name and sentence at its limit.
template <class T>
std::size_t worstSize(const T& longest) {
  EXPECT_EQ(fault(longest), std::nullopt);
  return static_cast<std::size_t>(longest.getEncodedSize());
}

TEST(ControlMessages, FitOneFrameAtTheirWorst) {
  const std::string name(kNameBytes, 'n');
  const std::string sentence(kSentenceBytes, 's');
  std::vector<std::size_t> sizes = {
      worstSize(example<arm_state_t>()),  worstSize(example<arm_command_t>()),
      worstSize(example<hand_state_t>()), worstSize(example<hand_command_t>()),
      worstSize(example<scene_t>()),      worstSize(example<throw_start_t>()),
      worstSize(example<release_t>()),    worstSize(example<ball_track_t>()),
      worstSize(example<grip_t>()),
  };
  const auto add = [&](auto message, auto fill) {
    fill(message);
    sizes.push_back(worstSize(message));
  };
  add(example<estop_t>(), [&](auto& m) { m.reason = sentence; });
  add(example<plan_request_t>(), [&](auto& m) { m.strategy = name; });
  add(example<controller_status_t>(), [&](auto& m) { m.message = sentence; });
  add(example<camera_info_t>(), [&](auto& m) { m.channel = name; });
  add(example<sim_truth_t>(), [&](auto& m) { m.note = sentence; });
  add(example<ball_observation_t>(), [&](auto& m) { m.channel = name; });
  add(example<landing_t>(), [&](auto& m) { m.message = sentence; });
  add(example<heartbeat_t>(), [&](auto& m) {
    m.name = m.host = m.version = m.state = name;
    m.detail = sentence;
  });
  add(example<clock_probe_t>(), [&](auto& m) { m.name = m.host = m.asker_host = name; });
  EXPECT_THAT(sizes, ::testing::Each(::testing::Le(kControlBytes)));
}

TEST(SwingPlan, OfHalfASecondAtAMillisecondFitsOneDatagram) {
  auto plan = example<swing_plan_t>();
  plan.n_samples = 500;
  for (auto* rows : {&plan.q, &plan.qd, &plan.qdd})
    rows->assign(500, std::vector<double>(4, 0));
  EXPECT_EQ(refusal("SWING_PLAN", kSwingPlan.max_bytes, &plan, messageType<swing_plan_t>()),
            std::nullopt);
}

}  // namespace
}  // namespace fastball::messaging
