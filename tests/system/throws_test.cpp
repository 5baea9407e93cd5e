// The whole experiment: real processes over LCM, real images, measured landings.
#include <gtest/gtest.h>

#include <fstream>

#include "tests/system/fastball_run.h"

namespace fastball::system_test {
namespace {

/// The throws of a run without what the wall clock says.
nlohmann::json timeless(const Outcome& run) {
  nlohmann::json throws = run.json.at("throws");
  for (auto& object : throws)
    object.erase("plan_ms");
  return throws;
}

TEST(Throws, ThreeLandWhereTheCamerasSayAndTwoHit) {
  const Outcome run = fastball({"run", "--throws", "3", "--seed", "1"});
  ASSERT_EQ(run.exit_status, 0) << run.output;
  ASSERT_EQ(run.json["throws"].size(), 3U) << run.json;
  for (const auto& object : run.json["throws"]) {
    SCOPED_TRACE(object.dump());
    ASSERT_FALSE(object["landing_measured_mm"].is_null());
    ASSERT_FALSE(object["landing_true_mm"].is_null());
    for (int axis = 0; axis < 2; ++axis) {
      EXPECT_NEAR(object["landing_measured_mm"][axis], object["landing_true_mm"][axis], 10.0);
      EXPECT_GT(object["landing_sigma_mm"][axis], 0.0);
      EXPECT_LT(object["landing_sigma_mm"][axis], 10.0);
    }
    const double speed = object["release_speed_mps"];
    const double planned = object["planned_speed_mps"];
    EXPECT_GE(speed, 5.0);
    EXPECT_NEAR(speed, planned, 0.05 * planned);
  }
  EXPECT_GE(run.json["hits"], 2);
}

TEST(Throws, TheSameCommandGivesTheSameThrows) {
  const std::vector<std::string> command = {"run", "--throws", "2", "--seed", "3"};
  const Outcome first = fastball(command);
  const Outcome second = fastball(command);
  ASSERT_EQ(first.exit_status, 0) << first.output;
  ASSERT_EQ(second.exit_status, 0) << second.output;
  EXPECT_EQ(timeless(first), timeless(second));
}

TEST(Throws, ProcessesAndOneProcessGiveTheSameThrowsBitForBit) {
  const Outcome network = fastball({"run", "--throws", "2", "--seed", "2"});
  const Outcome alone = fastball({"run", "--throws", "2", "--seed", "2", "--no-network"});
  ASSERT_EQ(network.exit_status, 0) << network.output;
  ASSERT_EQ(alone.exit_status, 0) << alone.output;
  EXPECT_EQ(timeless(network), timeless(alone));
}

TEST(Throws, AnotherSeedGivesOtherImages) {
  const Outcome one = fastball({"run", "--throws", "1", "--seed", "1", "--no-network"});
  const Outcome two = fastball({"run", "--throws", "1", "--seed", "2", "--no-network"});
  ASSERT_EQ(one.exit_status, 0) << one.output;
  ASSERT_EQ(two.exit_status, 0) << two.output;
  EXPECT_NE(one.json["throws"][0]["landing_measured_mm"],
            two.json["throws"][0]["landing_measured_mm"]);
}

TEST(Throws, ADroppedBallIsAMissThatSaysWhyItWasNotMeasured) {
  const EditedConfig weak_grip("experiment.yaml", "grip_force: 6.0", "grip_force: 0.3");
  const std::string errors = weak_grip.experiment() + ".errors";
  std::ofstream(errors) << "throw:\n  friction: {uniform: [-0.94, -0.93], unit: relative}\n"
                           "  grasp_offset: {normal: 0.01, unit: m}\n";
  const std::vector<std::string> command = {
      "run",           "--throws", "1", "--strategy", "paper", "--config", weak_grip.experiment(),
      "--uncertainty", errors};
  std::vector<std::string> command_alone = command;
  command_alone.emplace_back("--no-network");
  const Outcome network = fastball(command);
  const Outcome alone = fastball(command_alone);
  ASSERT_EQ(network.exit_status, 0) << network.output;
  const nlohmann::json& dropped = network.json["throws"][0];
  EXPECT_EQ(dropped["hit"], false);
  EXPECT_TRUE(dropped["landing_measured_mm"].is_null());
  EXPECT_TRUE(dropped["landing_true_mm"].is_null());
  EXPECT_NE(dropped["note"], "");
  EXPECT_EQ(timeless(network), timeless(alone));
}

}  // namespace
}  // namespace fastball::system_test
