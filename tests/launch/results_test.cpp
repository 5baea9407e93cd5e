#include "launch/results.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "launch/judge.h"
#include "messaging/local_network.h"

namespace fastball::launch {
namespace {

Throw seenThrow() {
  Throw seen;
  seen.number = 1;
  seen.plan_ms = 3.1;
  seen.planned_speed = 6.1;
  seen.measured = true;
  seen.landing = {0.0121, -0.003};
  seen.landing_sigma = {0.0011, 0.0013};
  return seen;
}

Truth landedAt(double right, double up) {
  Truth truth;
  truth.release_utime = 11500000;
  truth.release_speed = 6.0;
  truth.landing = Eigen::Vector2d(right, up);
  truth.finished = true;
  return truth;
}

TEST(Judgement, AHitIsACentreWithinTheRing) {
  EXPECT_TRUE(judge(seenThrow(), landedAt(0.0, 0.0), 0.1).hit);
  EXPECT_TRUE(judge(seenThrow(), landedAt(0.07, -0.07), 0.1).hit);
  EXPECT_FALSE(judge(seenThrow(), landedAt(0.08, -0.07), 0.1).hit);
  EXPECT_FALSE(judge(seenThrow(), Truth{}, 0.1).hit) << "never crossed the plane";
}

TEST(ResultJson, HasTheDocumentedShape) {
  RunResult result;
  result.version = "1.2.3";
  result.seed = 5;
  result.strategy = "paper";
  result.log = "a.lcmlog";
  result.throws = {judge(seenThrow(), landedAt(0.0118, -0.0027), 0.1)};
  const nlohmann::json object = toJson(result);
  EXPECT_EQ(object["version"], "1.2.3");
  EXPECT_EQ(object["seed"], 5);
  EXPECT_EQ(object["strategy"], "paper");
  EXPECT_EQ(object["hits"], 1);
  EXPECT_EQ(object["log"], "a.lcmlog");
  const nlohmann::json& first = object["throws"][0];
  EXPECT_EQ(first["index"], 0);
  EXPECT_EQ(first["plan_ms"], 3.1);
  EXPECT_EQ(first["release_speed_mps"], 6.0);
  EXPECT_EQ(first["release_utime"], 11500000);
  EXPECT_NEAR(first["landing_measured_mm"][0], 12.1, 1e-9);
  EXPECT_NEAR(first["landing_sigma_mm"][1], 1.3, 1e-9);
  EXPECT_NEAR(first["landing_true_mm"][1], -2.7, 1e-9);
  EXPECT_EQ(first["hit"], true);
}

TEST(ResultJson, WhatDidNotHappenIsNull) {
  RunResult result;
  result.throws = {judge(Throw{}, Truth{}, 0.1)};
  const nlohmann::json first = toJson(result)["throws"][0];
  for (const char* key : {"release_speed_mps", "release_utime", "landing_measured_mm",
                          "landing_sigma_mm", "landing_true_mm"}) {
    EXPECT_TRUE(first[key].is_null()) << key;
  }
  EXPECT_EQ(first["hit"], false);
}

TEST(ThrowLine, SaysTheThrowInOneLine) {
  EXPECT_EQ(
      throwLine(judge(seenThrow(), landedAt(0.0118, -0.0027), 0.1)),
      "throw 1: planned in 3 ms, released at 6.00 m/s (plan 6.10), landing (+12.1, -3.0) mm +- "
      "(1.1, 1.3), true (+11.8, -2.7) mm: hit");
}

TEST(Judge, KeepsTheFirstReleaseAndNamesALaterTouch) {
  messaging::ManualClock clock;
  messaging::LocalNetwork network(clock);
  Judge judge(network.addEndpoint());
  messaging::Publisher<sim_truth_t> truths(network.addEndpoint(), messaging::kSimTruth);
  int index = 0;
  const auto tell = [&](int8_t event, int64_t utime, const std::string& note = "") {
    sim_truth_t truth{};
    truth.scene_id = 4;
    truth.event = event;
    truth.event_index = ++index;
    truth.utime = utime;
    truth.note = note;
    truth.v_WBall[1] = static_cast<double>(utime);
    truths.publish(truth);
  };
  tell(sim_truth_t::RELEASED, 5);
  tell(sim_truth_t::TOUCHED, 6, "thumb");
  tell(sim_truth_t::RELEASED, 7);
  tell(sim_truth_t::FINISHED, 9);
  network.run([] { return false; });
  EXPECT_EQ(judge.of(4).release_utime, 5);
  EXPECT_EQ(judge.of(4).release_speed, 5.0);
  EXPECT_FALSE(judge.of(4).landing);
  EXPECT_EQ(judge.of(4).touched, "thumb");
  EXPECT_TRUE(judge.of(4).finished);
  EXPECT_FALSE(judge.of(3).finished);
}

TEST(Judge, WaitsForAnEventThatWasLostAndTakesItWhenItIsSaidAgain) {
  messaging::ManualClock clock;
  messaging::LocalNetwork network(clock);
  Judge judge(network.addEndpoint());
  messaging::Publisher<sim_truth_t> truths(network.addEndpoint(), messaging::kSimTruth);
  const auto tell = [&](int8_t event, int32_t index, int64_t utime) {
    sim_truth_t truth{};
    truth.scene_id = 1;
    truth.event = event;
    truth.event_index = index;
    truth.utime = utime;
    truths.publish(truth);
    network.run([] { return false; });
  };
  tell(sim_truth_t::RELEASED, 3, 300);
  tell(sim_truth_t::FINISHED, 4, 400);
  EXPECT_FALSE(judge.of(1).finished);
  tell(sim_truth_t::TOUCHED, 2, 200);
  EXPECT_FALSE(judge.of(1).finished);
  tell(sim_truth_t::RELEASED, 1, 100);
  EXPECT_TRUE(judge.of(1).finished);
  EXPECT_EQ(judge.of(1).release_utime, 100);
}

}  // namespace
}  // namespace fastball::launch
