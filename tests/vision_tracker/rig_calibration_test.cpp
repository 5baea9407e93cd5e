// Several cameras calibrated together, from boards drawn through cameras that are known.
#include "vision_tracker/rig_calibration.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

#include "sim_bullet/camera_config.h"
#include "tests/vision_tracker/drawn_board.h"
#include "vision_tracker/board_collector.h"

namespace fastball::vision_tracker {
namespace {

using ::testing::HasSubstr;

class Rigs : public ::testing::Test {
 protected:
  Rigs() {
    for (int i = 0; i < 3; ++i) {
      model::Camera camera;
      camera.width = 640;
      camera.height = 480;
      camera.fx = camera.fy = 700 + 20 * i;
      camera.cx = 322 - i;
      camera.cy = 238 + i;
      camera.distortion << -0.1, 0.03, 0, 0, 0;
      sim_bullet::lookAt({-0.35 + 0.35 * i, -0.75, 0.1 * i}, {0, 0, 0}, camera);
      truth_.push_back(camera);
      rays_.push_back(::fastball::testing::DrawnBoard::raysOf(camera));
    }
    for (int k = 0; k < 14; ++k) {
      // Before the cameras, which look along y: x to the right, y down in the image, z away.
      const Eigen::Matrix3d facing = (Eigen::Matrix3d() << 1, 0, 0, 0, 0, 1, 0, -1, 0).finished();
      const Eigen::Vector3d axis(std::cos(1.3 * k), std::sin(1.3 * k), 0.3);
      boards_R_.push_back(facing * Eigen::AngleAxisd(0.45, axis.normalized()).toRotationMatrix());
      boards_p_.push_back(drawn_.origin(
          boards_R_.back(), {0.12 * (k % 3 - 1), -0.12 + 0.02 * k, 0.08 * (k / 3 % 3 - 1)}));
    }
  }

  BoardImage image(std::size_t camera, std::size_t k) const {
    const model::Camera& c = truth_[camera];
    return {"view" + std::to_string(k),
            drawn_.picture(rays_[camera], c.R_CW * boards_R_[k], c.toCamera(boards_p_[k]))};
  }
  CameraImages images(std::size_t camera, std::size_t first = 0, std::size_t end = 14) const {
    CameraImages made{"camera" + std::to_string(camera), {}};
    for (std::size_t k = first; k < end; ++k)
      made.images.push_back(image(camera, k));
    return made;
  }
  WorldBoard world(std::size_t k) const {
    return {"view" + std::to_string(k), boards_R_[k], boards_p_[k]};
  }
  /// Largest distance [m] of what the camera sees at a place before it from where it is, over places about the origin, where
  /// errors of focal length and distance along the axis cannot be told apart: across the rays only.
  static double offset(const model::Camera& found, const model::Camera& truth) {
    double worst = 0;
    for (const double x : {-0.2, 0.0, 0.2})
      for (const double z : {-0.15, 0.0, 0.15}) {
        const Eigen::Vector3d p_W(x, -0.2, z);
        const double pixels = (found.project(p_W) - truth.project(p_W)).norm();
        worst = std::max(worst, pixels * truth.toCamera(p_W).z() / truth.fx);
      }
    return worst;
  }
  std::string refusal(const std::vector<CameraImages>& cameras, const WorldBoard& board) const {
    try {
      calibrateRig(cameras, shape_, board);
    } catch (const std::invalid_argument& e) {
      return e.what();
    }
    return "accepted";
  }

  BoardShape shape_{8, 6, 0.04, 0.03, "5X5_100"};
  ::fastball::testing::DrawnBoard drawn_{shape_};
  std::vector<model::Camera> truth_;
  std::vector<cv::Mat> rays_;
  std::vector<Eigen::Matrix3d> boards_R_;
  std::vector<Eigen::Vector3d> boards_p_;
};

TEST_F(Rigs, StandInTheWorldWhereTheyDo) {
  const RigCalibration rig = calibrateRig({images(0), images(1), images(2)}, shape_, world(2));
  ASSERT_EQ(rig.cameras.size(), 3u);
  EXPECT_LT(rig.pair_rms, 0.12);
  EXPECT_GT(rig.pair_rms, 0);
  for (std::size_t i = 0; i < 3; ++i) {
    const model::Camera& found = rig.cameras[i].camera;
    EXPECT_LT(offset(found, truth_[i]), 0.7e-3) << i;
    const Eigen::AngleAxisd turn(Eigen::Matrix3d(found.R_CW * truth_[i].R_CW.transpose()));
    EXPECT_LT(turn.angle(), 4e-3) << i;
  }
  // What all cameras see is in one place, closer than each knows the world.
  const Eigen::Matrix3d R01 = rig.cameras[1].camera.R_CW * rig.cameras[0].camera.R_CW.transpose();
  const Eigen::Matrix3d truth01 = truth_[1].R_CW * truth_[0].R_CW.transpose();
  EXPECT_LT(Eigen::AngleAxisd(Eigen::Matrix3d(R01 * truth01.transpose())).angle(), 3e-3);
}

TEST_F(Rigs, ReachACameraThroughAnother) {
  // The last one shares no view with the first.
  const RigCalibration rig =
      calibrateRig({images(0, 0, 9), images(1), images(2, 5, 14)}, shape_, world(0));
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_LT(offset(rig.cameras[i].camera, truth_[i]), 3e-3) << i;
}

TEST_F(Rigs, RefuseCamerasThatSeeTooLittleTogether) {
  EXPECT_THAT(
      refusal({images(0, 0, 8), images(1, 6, 14)}, {}),
      HasSubstr("camera0 and camera1 see the board together in only 2 views, 3 are needed"));
}

TEST_F(Rigs, NameTheCameraThatCannotBeCalibrated) {
  EXPECT_THAT(refusal({images(0), images(1, 0, 4)}, {}),
              HasSubstr("camera1: only 4 of 4 images show"));
  EXPECT_THAT(refusal({images(0)}, {"view99", Eigen::Matrix3d::Identity(), {}}),
              HasSubstr("'view99' cannot be the world's view"));
}

TEST_F(Rigs, RefuseNoCamera) {
  EXPECT_EQ(refusal({}, {}), "there is no camera to calibrate");
}

class Collectors : public Rigs {
 protected:
  BoardCollector collector_{shape_, {"left", "right"}};
};

TEST_F(Collectors, TakeABoardThatIsHeldStillInANewPlace) {
  const cv::Mat left = image(0, 0).grey, right = image(1, 0).grey;
  EXPECT_FALSE(collector_.look({left, right})) << "it may be moving";
  EXPECT_GT(collector_.corners()[0], 20u);
  EXPECT_TRUE(collector_.look({left, right}));
  EXPECT_FALSE(collector_.look({left, right})) << "there is nothing new in it";
  EXPECT_EQ(collector_.fewestViews(), 1u);
  // Moving: another place at each look.
  for (const std::size_t k : {1U, 2U, 3U, 4U})
    EXPECT_FALSE(collector_.look({image(0, k).grey, image(1, k).grey}));
  EXPECT_TRUE(collector_.look({image(0, 4).grey, image(1, 4).grey}));
  ASSERT_EQ(collector_.images()[1].images.size(), 2u);
  EXPECT_EQ(collector_.images()[0].images[1].name, collector_.images()[1].images[1].name);
}

TEST_F(Collectors, TakeWhatOneCameraSees) {
  const cv::Mat nothing(480, 640, CV_8U, cv::Scalar(90));
  for (int again = 0; again < 3; ++again)
    collector_.look({image(0, 0).grey, nothing});
  for (int again = 0; again < 3; ++again)
    collector_.look({cv::Mat(), image(1, 1).grey});
  EXPECT_EQ(collector_.images()[0].images.size(), 1u);
  ASSERT_EQ(collector_.images()[1].images.size(), 1u);
  EXPECT_NE(collector_.images()[0].images[0].name, collector_.images()[1].images[0].name);
  EXPECT_EQ(collector_.fewestViews(), 1u);
}

}  // namespace
}  // namespace fastball::vision_tracker
