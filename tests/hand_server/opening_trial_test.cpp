// The hand feels how late its fingers obey.
#include "hand_server/opening_trial.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "model/grasp.h"
#include "tests/hand_server/scripted_hand.h"

namespace fastball::hand_server {
namespace {

constexpr std::array<model::Finger, model::kFingers> kEachFinger{model::kFingerA, model::kThumb,
                                                                 model::kFingerB};

constexpr DeadTimes kPrompt{8e-4, 6e-4, 9e-4};

class Trial : public testing::Test {
 protected:
  /// Fingers that do what they were told so long ago, measured with noise; a command holds for a tick.
  /// @param follows share of the way that a finger goes.
  std::optional<DeadTimes> feel(const DeadTimes& late, double noise = 0, double follows = 1) {
    OpeningTrial trial(retreat_, settings_, kPrompt);
    std::normal_distribution<double> draw(0, 1);
    for (int k = 0; 1e-3 * k <= settings_.length(); ++k) {
      model::HandVector q = retreat_.q_grasp();
      for (const model::Finger finger : kEachFinger) {
        model::JointTargets told;
        told.q = q;
        trial.tell(1e-3 * k - kPrompt[finger] - late[finger], told);
        const int joint = model::Hand::proximalJoint(finger);
        q[joint] += follows * (told.q[joint] - q[joint]) + noise * draw(random_);
      }
      trial.feel(1e-3 * k, q);
    }
    return trial.deadTimes();
  }

  std::mt19937 random_{5};
  const model::Hand hand_ = testHand();
  const model::FingerRetreat retreat_{hand_, model::grasp(experiment().ball, hand_, 6)};
  const TrialSettings settings_ = loadConfig(kExperimentPath).trial;
};

TEST_F(Trial, FindsTheDeadTimeOfEachFinger) {
  std::vector<DeadTimes> cases{{0, 0, 0}, {1e-5, 0, 0}};
  std::uniform_real_distribution<double> late(0, settings_.longest - 2e-3);
  for (int i = 0; i < 30; ++i)
    cases.push_back({late(random_), late(random_), late(random_)});
  for (const DeadTimes& dead_times : cases) {
    for (const double follows : {0.5, 1.0, 1.3}) {
      const auto felt = feel(dead_times, 0, follows);
      ASSERT_TRUE(felt);
      for (const model::Finger finger : kEachFinger)
        EXPECT_NEAR((*felt)[finger], dead_times[finger], 2e-5);
    }
  }
}

TEST_F(Trial, JointSensorsOfATenthOfAMilliradianWillDo) {
  for (int i = 0; i < 30; ++i) {
    const DeadTimes dead_times{2e-3 + 1e-4 * i, 5e-3, 0};
    const auto felt = feel(dead_times, 1e-4);
    ASSERT_TRUE(felt);
    for (const model::Finger finger : kEachFinger)
      EXPECT_NEAR((*felt)[finger], dead_times[finger], 3e-4);
  }
}

TEST_F(Trial, SaysNothingOfFingersThatDoNotDoWhatTheyAreTold) {
  EXPECT_FALSE(feel({0, 0, 0}, 0, 0)) << "stuck";
  EXPECT_FALSE(feel({0, 0, 0}, 0, -1)) << "the other way";
  EXPECT_FALSE(feel({0, 0, 0}, 0.01)) << "too noisy to tell";
  EXPECT_FALSE(feel({0, 0, 2 * settings_.length()})) << "later than is looked for";
  EXPECT_FALSE(OpeningTrial(retreat_, settings_, kPrompt).deadTimes()) << "nothing was felt";
}

TEST_F(Trial, BeginsAndEndsInTheGrasp) {
  const OpeningTrial trial(retreat_, settings_, kPrompt);
  for (const double t : {-1.0, 0.0, settings_.duration, settings_.length()}) {
    model::JointTargets told;
    trial.tell(t, told);
    for (const model::Finger finger : kEachFinger) {
      const int joint = model::Hand::proximalJoint(finger);
      EXPECT_NEAR(told.q[joint], retreat_.q_grasp()[joint], 1e-12);
      EXPECT_NEAR(told.tau[joint], retreat_.tau_grasp()[joint], 1e-12);
      EXPECT_NEAR(told.qd[joint], 0, 1e-12);
    }
  }
}

}  // namespace
}  // namespace fastball::hand_server
