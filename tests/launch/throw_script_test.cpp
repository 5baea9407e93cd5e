#include "launch/throw_script.h"

#include <gmock/gmock.h>

#include <set>

#include "tests/launch/scripted_peers.h"

namespace fastball::launch {
namespace {

RunSettings settings() {
  RunSettings s;
  s.config.settle = 0.6;
  s.config.scene_period = 10.0;
  s.config.camera_lead = 0.15;
  s.config.camera_tail = 0.1;
  s.config.scene_tail = 0.2;
  return s;
}

TEST(ThrowSeed, IsNeverNegativeAndNeverTheSame) {
  std::set<int64_t> seeds;
  for (const int64_t seed : {int64_t{0}, int64_t{1}, int64_t{2}, INT64_MAX}) {
    for (int k = 1; k <= 100; ++k) {
      EXPECT_GE(throwSeed(seed, k), 0);
      seeds.insert(throwSeed(seed, k));
    }
  }
  EXPECT_EQ(seeds.size(), 400U);
}

TEST(ThrowSeed, IsTheSameOnEveryMachine) {
  EXPECT_EQ(throwSeed(1, 1), 3831962387588225989);
}

TEST(Scene, CoversTheThrowAndTheFlight) {
  const swing_plan_t plan =
      ScriptedPeers::examplePlan();  // swing at 1.2 s, landing at 2.0 s, rest at 2.0 s
  const scene_t first = scene(settings(), 1, plan);
  EXPECT_DOUBLE_EQ(first.camera_start, 0.6 + 1.2 - 0.15);
  EXPECT_DOUBLE_EQ(first.camera_end, 0.6 + 2.0 + 0.1);
  EXPECT_DOUBLE_EQ(first.duration, 0.6 + 2.0 + 0.2);
  EXPECT_EQ(scene(settings(), 2, plan).utime - first.utime, 10000000);
}

TEST(Scene, LastsAtLeastAsLongAsThePlan) {
  swing_plan_t plan = ScriptedPeers::examplePlan();
  plan.n_samples = 401;
  EXPECT_DOUBLE_EQ(scene(settings(), 1, plan).duration, 0.6 + 4.0);
}

TEST(Scene, MustEndBeforeTheNextOneBegins) {
  RunSettings dense = settings();
  dense.config.scene_period = 2.0;
  EXPECT_THROW(scene(dense, 1, ScriptedPeers::examplePlan()), std::runtime_error);
}

}  // namespace
}  // namespace fastball::launch
