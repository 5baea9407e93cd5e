// Whatever is asked for: a plan that keeps every limit and lands, or a sentence.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <future>
#include <limits>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "planner/atlas_builder.h"
#include "tests/planner/default_throw.h"
#include "tests/planner/plan_checks.h"

namespace fastball::planner {
namespace {

/// Ten thousand take minutes: FASTBALL_LONG_TESTS asks for them.
int requestCount() {
#if defined(__SANITIZE_ADDRESS__)
  return 200;
#else
  return std::getenv("FASTBALL_LONG_TESTS") != nullptr ? 10000 : 2500;
#endif
}
constexpr int kSpoiledEvery = 100;
constexpr double kLandingTolerance = 1e-3;  // [m]

double uniform(std::mt19937_64& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

/// Anywhere 2 to 4 m away, the ring facing the robot within 45 degrees to the side and 30 up or down, the arm anywhere.
ThrowRequest randomRequest(const DefaultThrow& example, int64_t seed) {
  std::mt19937_64 random(seed);
  const double distance = uniform(random, 2, 4), azimuth = uniform(random, -M_PI / 3, M_PI / 3);
  ThrowRequest request = example.requestTo(
      distance * std::cos(azimuth), distance * std::sin(azimuth), uniform(random, -0.8, 0.8), seed);
  const double aside = azimuth + uniform(random, -M_PI / 4, M_PI / 4),
               up = uniform(random, -M_PI / 6, M_PI / 6);
  request.target.n_WTarget = {-std::cos(aside) * std::cos(up), -std::sin(aside) * std::cos(up),
                              std::sin(up)};
  const model::ArmParameters& arm = example.config.arm;
  for (int j = 0; j < model::kArmJoints; ++j) {
    request.q_arm[j] =
        uniform(random, arm.q_min[j] + arm.position_margin, arm.q_max[j] - arm.position_margin);
  }
  request.strategy = seed % 2 == 0 ? "robust" : "paper";
  return request;
}

/// One number of a good request made absurd.
ThrowRequest spoiledRequest(const DefaultThrow& example, int64_t seed) {
  constexpr double kAbsurd[] = {std::numeric_limits<double>::quiet_NaN(),
                                std::numeric_limits<double>::infinity(),
                                -std::numeric_limits<double>::infinity(),
                                1e300,
                                -1e300,
                                1e12};
  ThrowRequest request = randomRequest(example, seed);
  std::mt19937_64 random(seed);
  double* const numbers[] = {&request.target.p_WTarget[0],
                             &request.target.p_WTarget[1],
                             &request.target.p_WTarget[2],
                             &request.target.n_WTarget[0],
                             &request.target.n_WTarget[1],
                             &request.target.n_WTarget[2],
                             &request.target.radius,
                             &request.q_arm[0],
                             &request.q_arm[1],
                             &request.q_arm[2],
                             &request.q_arm[3]};
  *numbers[random() % std::size(numbers)] = kAbsurd[random() % std::size(kAbsurd)];
  return request;
}

/// What is wrong with the answer; empty if nothing.
std::string fault(const DefaultThrow& example,
                  const ThrowRequest& request,
                  const PlanResult& result) {
  if (const auto* refusal = std::get_if<Refusal>(&result))
    return refusal->sentence.empty() ? "refused without a word" : "";
  const Plan& plan = std::get<Plan>(result);
  if (std::string broken = limitFault(example.config, plan); !broken.empty())
    return broken;
  const double miss =
      landingOf(plan.release, request.target, example.config.ball.dragPerMetre()).norm();
  return miss <= kLandingTolerance ? "" : fmt::format("lands {} m off", miss);
}

struct Outcome {
  int planned = 0;
  std::vector<std::string> faults;
};

/// Plans for the seeds first, first + step, ... and looks at each answer.
Outcome planAndCheck(const DefaultThrow& example,
                     const Planner& planner,
                     int64_t first,
                     int64_t step) {
  Outcome outcome;
  for (int64_t seed = first; seed <= requestCount(); seed += step) {
    const ThrowRequest request =
        seed % kSpoiledEvery == 0 ? spoiledRequest(example, seed) : randomRequest(example, seed);
    const PlanResult result = planner.plan(request);
    outcome.planned += std::holds_alternative<Plan>(result) ? 1 : 0;
    if (const std::string found = fault(example, request, result); !found.empty())
      outcome.faults.push_back(fmt::format("request {}: {}", seed, found));
  }
  return outcome;
}

TEST(RandomRequests, AreRefusedWithASentenceOrThePlansHoldEveryLimitAndLand) {
  constexpr int kThreads = 2;
  const DefaultThrow example;
  const Planner planner(example.config, {},
                        std::make_shared<Atlas>(buildAtlas(example.config, kThreads)));
  std::vector<std::future<Outcome>> parts;
  for (int part = 1; part <= kThreads; ++part) {
    parts.push_back(std::async(std::launch::async, planAndCheck, std::cref(example),
                               std::cref(planner), part, kThreads));
  }
  int planned = 0;
  for (auto& part : parts) {
    const Outcome outcome = part.get();
    planned += outcome.planned;
    for (const std::string& found : outcome.faults)
      ADD_FAILURE() << found;
  }
  EXPECT_GT(planned, 0.95 * requestCount());
}

}  // namespace
}  // namespace fastball::planner
