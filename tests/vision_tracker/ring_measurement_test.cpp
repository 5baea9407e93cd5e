#include "vision_tracker/ring_measurement.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <random>

#include "config/experiment.h"
#include "sim_bullet/camera_background.h"
#include "tests/vision_tracker/experiment_path.h"
#include "vision_tracker/background.h"

namespace fastball::vision_tracker {
namespace {

using fastball::testing::experimentPath;

const RingPrior kPrior{0.008, 0.03, 0.05, 0.03};

/// What the cameras of the default experiment show of a target.
struct Scene {
  std::vector<model::Camera> cameras;
  std::vector<cv::Mat> stills;

  explicit Scene(const model::Target& target, bool with_net = true) {
    cv::RNG random(7);
    const sim_bullet::CameraRigOptions rig = sim_bullet::readCameraRig(experimentPath());
    for (const sim_bullet::RigCamera& c : rig.cameras) {
      cameras.push_back(c.camera);
      cv::Mat image = sim_bullet::drawRoom(c.camera, sim_bullet::rayMap(c.camera));
      if (with_net)
        sim_bullet::drawNet(c.camera, target, rig.blur, image);
      // What 16 images with 2 grey levels of noise leave.
      cv::Mat still, added(image.size(), CV_32F);
      random.fill(added, cv::RNG::NORMAL, 0.0, 0.5);
      image.convertTo(still, CV_32F);
      still += added;
      still.convertTo(still, CV_16S, Background::kScale);
      stills.push_back(still);
    }
  }
  RingMeasurement measure(const Ring& nominal) const {
    std::vector<const cv::Mat*> images;
    for (const cv::Mat& still : stills)
      images.push_back(&still);
    return measureRing(images, cameras, nominal, kPrior, 0.6);
  }
};

model::Target nominalTarget() {
  return config::loadExperiment(experimentPath()).target;
}

model::Target drawn(std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(-1, 1);
  const auto draw = [&](double half) { return half * uniform(random); };
  model::Target moved = nominalTarget();
  moved.p_WTarget += Eigen::Vector3d(draw(0.05), draw(0.05), draw(0.05));
  moved.n_WTarget = (moved.n_WTarget + Eigen::Vector3d(0, draw(0.08), draw(0.08))).normalized();
  return moved;
}

Ring ringOf(const model::Target& target) {
  return {target.p_WTarget, target.n_WTarget, target.radius + kPrior.tube / 2};
}

TEST(RingFinder, FindsTheRingFromANominalPoseWrongByCentimetres) {
  std::mt19937 random(5);
  for (int i = 0; i < 20; ++i) {
    const model::Target target = drawn(random);
    const RingMeasurement found = Scene(target).measure(ringOf(nominalTarget()));
    ASSERT_TRUE(found.estimate) << "ring " << i << ": " << found.why_not;
    const Ring& ring = found.estimate->ring;
    EXPECT_LT((ring.p_W - target.p_WTarget).norm(), 0.0015) << "ring " << i;
    EXPECT_LT((ring.n_W - target.n_WTarget).norm(), 0.008) << "ring " << i;
    for (const Eigen::Vector2d& shift : found.estimate->shifts)
      EXPECT_LT(shift.norm(), 0.5) << "ring " << i;
  }
}

// A camera that is assumed turned sees the ring beside the place where the others have it, and says by how much.
TEST(RingFinder, BearsACalibrationThatIsWrong) {
  Scene scene(nominalTarget());
  scene.cameras[1] =
      displaced(scene.cameras[1], (CameraConstants() << 0, 0, 1e-3, 0, 0, 0, 0, 0, 0).finished());
  const RingMeasurement found = scene.measure(ringOf(nominalTarget()));
  ASSERT_TRUE(found.estimate) << found.why_not;
  const Eigen::Vector2d apart = found.estimate->shifts[1] - found.estimate->shifts[0];
  EXPECT_NEAR(apart.norm(), 1e-3 * scene.cameras[1].fy, 0.3);
}

TEST(RingFinder, SaysWhyThereIsNone) {
  const Ring nominal = ringOf(nominalTarget());
  const RingMeasurement without = Scene(nominalTarget(), false).measure(nominal);
  EXPECT_FALSE(without.estimate);
  EXPECT_NE(without.why_not, "");
  Ring outside = nominal;
  outside.p_W.x() += 30;
  EXPECT_EQ(Scene(nominalTarget()).measure(outside).why_not,
            "no camera has the whole ring in its image");
}

}  // namespace
}  // namespace fastball::vision_tracker
