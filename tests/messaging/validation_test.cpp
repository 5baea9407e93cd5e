// Rules beyond finite numbers, one broken field at a time.
#include "messaging/validation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/messaging/examples.h"

namespace fastball::messaging {
namespace {

using examples::example;
using ::testing::HasSubstr;

/// The fault of an example after `spoil` has changed it.
template <class T, class Spoil>
std::string faultOf(Spoil spoil) {
  T message = example<T>();
  spoil(message);
  return fault(message).value_or("no fault");
}

TEST(Validation, SentenceNamesChannelFieldAndValue) {
  EXPECT_EQ(faultOf<arm_state_t>([](auto& m) { m.q[2] = NAN; }), "ARM_STATE: q[2] is nan");
  EXPECT_EQ(faultOf<arm_state_t>([](auto& m) { m.tick = -3; }), "ARM_STATE: tick is -3, below 0");
}

TEST(Validation, EnumerationsStayInRange) {
  EXPECT_EQ(faultOf<arm_command_t>([](auto& m) { m.phase = 7; }),
            "ARM_COMMAND: phase is 7, not in 0 .. 6");
  EXPECT_THAT(faultOf<arm_command_t>([](auto& m) { m.phase = -1; }), HasSubstr("phase"));
  EXPECT_THAT(faultOf<hand_command_t>([](auto& m) { m.phase = 5; }), HasSubstr("phase"));
  EXPECT_THAT(faultOf<controller_status_t>([](auto& m) { m.phase = 9; }), HasSubstr("phase"));
  EXPECT_THAT(faultOf<release_t>([](auto& m) { m.event = 2; }), HasSubstr("event"));
  EXPECT_THAT(faultOf<release_t>([](auto& m) { m.reason = 2; }), HasSubstr("reason"));
  EXPECT_THAT(faultOf<sim_truth_t>([](auto& m) { m.event = 5; }), HasSubstr("event"));
  EXPECT_THAT(faultOf<swing_plan_t>([](auto& m) { m.status = 2; }), HasSubstr("status"));
  EXPECT_THAT(faultOf<landing_t>([](auto& m) { m.measured = 2; }), HasSubstr("measured"));
  EXPECT_THAT(faultOf<ball_observation_t>([](auto& m) { m.found = -1; }), HasSubstr("found"));
  EXPECT_THAT(faultOf<image_t>([](auto& m) { m.pixelformat = 0; }), HasSubstr("pixelformat"));
}

TEST(Validation, PlanLengthsAgree) {
  EXPECT_EQ(faultOf<swing_plan_t>([](auto& m) { m.qd.pop_back(); }),
            "SWING_PLAN: qd has 2 elements but n_samples is 3");
  EXPECT_THAT(faultOf<swing_plan_t>([](auto& m) { m.q[1].push_back(0); }),
              HasSubstr("q[1] has 5 joints, not 4"));
  EXPECT_THAT(faultOf<swing_plan_t>([](auto& m) { m.parameters.clear(); }),
              HasSubstr("parameters has 0 elements"));
  EXPECT_THAT(faultOf<swing_plan_t>([](auto& m) { m.parameter_names.clear(); }),
              HasSubstr("parameter_names has 0 elements"));
  EXPECT_THAT(faultOf<swing_plan_t>([](auto& m) { m.n_samples = 1001; }),
              HasSubstr("n_samples is 1001, not in 2 .. 1000"));
  EXPECT_THAT(faultOf<swing_plan_t>([](auto& m) { m.n_samples = -1; }), HasSubstr("n_samples"));
  EXPECT_THAT(faultOf<swing_plan_t>([](auto& m) { m.dt = 0; }), HasSubstr("dt"));
}

TEST(Validation, NumbersThatNoRobotMeasuresAreRefused) {
  EXPECT_EQ(faultOf<arm_state_t>([](auto& m) { m.q[2] = 1e300; }),
            "ARM_STATE: q[2] is 1e+300, beyond 1000");
  EXPECT_THAT(faultOf<arm_state_t>([](auto& m) { m.qd[0] = -2e4; }), HasSubstr("qd[0]"));
  EXPECT_THAT(faultOf<hand_state_t>([](auto& m) { m.q[9] = -1e4; }), HasSubstr("q[9]"));
  EXPECT_EQ(faultOf<swing_plan_t>([](auto& m) { m.qdd[1][2] = -1e7; }),
            "SWING_PLAN: qdd[1][2] is -10000000, beyond 1000000");
  EXPECT_THAT(faultOf<hand_state_t>([](auto& m) { m.f_normal[0] = 1e7; }), HasSubstr("f_normal"));
}

TEST(Validation, PlansLastNoYears) {
  EXPECT_EQ(faultOf<swing_plan_t>([](auto& m) { m.dt = 1e6; }),
            "SWING_PLAN: dt is 1000000, not in 0 .. 0.1");
  EXPECT_THAT(faultOf<swing_plan_t>([](auto& m) { m.t_release = 1e300; }), HasSubstr("t_release"));
}

TEST(Validation, RefusedPlanNeedsNoTrajectory) {
  EXPECT_EQ(faultOf<swing_plan_t>([](auto& m) {
              m = swing_plan_t{};
              m.plan_id = 1;
              m.strategy = "paper";
              m.status = swing_plan_t::REFUSED;
              m.message = "the target is 9 m away, the arm reaches 5 m";
            }),
            "no fault");
}

TEST(Validation, TargetIsAPlane) {
  for (const double slip : {1.1e-6, -1.1e-6}) {
    EXPECT_THAT(faultOf<scene_t>([&](auto& m) { m.n_WTarget[0] = -1 + slip; }),
                HasSubstr("n_WTarget has length"));
    EXPECT_THAT(faultOf<plan_request_t>([&](auto& m) { m.n_WTarget[0] = -1 + slip; }),
                HasSubstr("n_WTarget has length"));
  }
  EXPECT_EQ(faultOf<scene_t>([](auto& m) { m.n_WTarget[0] = -1 + 0.9e-6; }), "no fault");
  EXPECT_THAT(faultOf<scene_t>([](auto& m) { m.target_radius = 0; }), HasSubstr("target_radius"));
  EXPECT_THAT(faultOf<scene_t>([](auto& m) { m.camera_end = 0.5; }),
              HasSubstr("camera_end is 0.5, below 1"));
}

TEST(Validation, ImagesAreWholeAndOfSaneSize) {
  EXPECT_THAT(faultOf<image_t>([](auto& m) { m.width = 0; }), HasSubstr("width"));
  EXPECT_THAT(faultOf<image_t>([](auto& m) { m.height = 8193; }), HasSubstr("height"));
  EXPECT_THAT(faultOf<image_t>([](auto& m) { m.data.pop_back(); }), HasSubstr("data has 11"));
  EXPECT_THAT(faultOf<image_t>([](auto& m) { m.height = 4; }), HasSubstr("size is 12"));
  const auto jpeg = [](int bytes) {
    return faultOf<image_t>([&](auto& m) {
      m.pixelformat = image_t::MJPEG;
      m.size = bytes;
      m.data.assign(static_cast<std::size_t>(bytes), 0);
    });
  };
  EXPECT_EQ(jpeg(60000), "no fault");
  EXPECT_THAT(jpeg(60001), HasSubstr("size is 60001"));
  EXPECT_THAT(jpeg(0), HasSubstr("size is 0"));
}

TEST(Validation, GainsForcesAndVariancesAreNotNegative) {
  EXPECT_THAT(faultOf<hand_command_t>([](auto& m) { m.kp[3] = -1; }), HasSubstr("kp[3] is -1"));
  EXPECT_THAT(faultOf<hand_command_t>([](auto& m) { m.kd[0] = -1; }), HasSubstr("kd[0] is -1"));
  EXPECT_THAT(faultOf<hand_state_t>([](auto& m) { m.f_normal[0] = -1; }), HasSubstr("f_normal[0]"));
  EXPECT_THAT(faultOf<landing_t>([](auto& m) { m.cov_landing[2] = -1; }), HasSubstr("cov_landing"));
}

TEST(Validation, TextIsBounded) {
  EXPECT_EQ(faultOf<estop_t>([](auto& m) { m.reason.assign(kSentenceBytes, 'x'); }), "no fault");
  EXPECT_THAT(faultOf<estop_t>([](auto& m) { m.reason.assign(kSentenceBytes + 1, 'x'); }),
              HasSubstr("reason has 801 bytes"));
  EXPECT_THAT(faultOf<estop_t>([](auto& m) { m.reason.push_back('\0'); }), HasSubstr("zero byte"));
  EXPECT_THAT(faultOf<heartbeat_t>([](auto& m) { m.state = ""; }), HasSubstr("state is empty"));
}

TEST(Shortened, KeepsWhatFitsAndWholeCharacters) {
  EXPECT_EQ(shortened("abcdef", 6), "abcdef");
  EXPECT_EQ(shortened("abcdefg", 6), "abc...");
  EXPECT_EQ(shortened("ab\u00e9defg", 6), "ab...");
  EXPECT_EQ(shortened(std::string(2000, 'x')).size(), kSentenceBytes);
}

}  // namespace
}  // namespace fastball::messaging
