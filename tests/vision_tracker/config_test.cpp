#include "vision_tracker/config.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "config/strict_yaml.h"
#include "tests/vision_tracker/changed_experiment.h"

namespace fastball::vision_tracker {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr const char* kDefault = "cameras: [CAMERA_LEFT, CAMERA_RIGHT]";

std::string complaint(const std::string& cameras) {
  const ::fastball::testing::ChangedExperiment experiment(kDefault, "cameras: " + cameras);
  try {
    readTracker(experiment.path());
  } catch (const config::ConfigError& error) {
    return error.what();
  }
  return "no complaint";
}

TEST(TrackerConfig, NamesOneToFourCameras) {
  EXPECT_THAT(readTracker(::fastball::testing::experimentPath()).cameras,
              ElementsAre("CAMERA_LEFT", "CAMERA_RIGHT"));
  const ::fastball::testing::ChangedExperiment four(
      kDefault, "cameras: [CAMERA_LEFT, CAMERA_RIGHT, CAMERA_TOP, CAMERA_4]");
  EXPECT_THAT(readTracker(four.path()).cameras,
              ElementsAre("CAMERA_LEFT", "CAMERA_RIGHT", "CAMERA_TOP", "CAMERA_4"));
}

TEST(TrackerConfig, RefusesCamerasThatCannotBe) {
  EXPECT_THAT(complaint("[]"), AllOf(HasSubstr("key 'cameras': names 0 cameras"),
                                     HasSubstr("one to 4"), HasSubstr(".yaml:")));
  EXPECT_THAT(complaint("[CAMERA_1, CAMERA_2, CAMERA_3, CAMERA_4, CAMERA_5]"),
              HasSubstr("names 5 cameras"));
  EXPECT_THAT(complaint("[CAMERA_LEFT, CAMERA_LEFT]"), HasSubstr("names CAMERA_LEFT twice"));
  for (const char* name : {"LEFT", "CAMERA_", "CAMERA_INFO", "CAMERA_left", "CAMERA_.*"})
    EXPECT_THAT(complaint(std::string("[") + name + "]"),
                HasSubstr("has '" + std::string(name) + "', which is no channel of images"));
  EXPECT_THAT(complaint("CAMERA_LEFT"), HasSubstr("must be a list of words"));
}

}  // namespace
}  // namespace fastball::vision_tracker
