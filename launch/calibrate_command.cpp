#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <Eigen/Geometry>
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <memory>
#include <opencv2/core/utils/logger.hpp>
#include <opencv2/imgcodecs.hpp>

#include "config/calibration_file.h"
#include "config/image_channel.h"
#include "launch/commands.h"
#include "launch/live_board.h"
#include "messaging/lcm_endpoint.h"
#include "messaging/process.h"
#include "vision_tracker/rig_calibration.h"

namespace fastball::launch {
namespace {

namespace fs = std::filesystem;
using vision_tracker::BoardCalibration;
using vision_tracker::CameraImages;

struct CalibrateOptions {
  std::vector<std::string> images;  ///< files of one camera, or a folder for each
  std::vector<double> board_pose;   ///< x, y, z [m], roll, pitch, yaw [rad]
  std::string world;
  LiveBoard live;
  vision_tracker::BoardShape board{8, 6, 0, 0, "5X5_100"};
};

vision_tracker::BoardImage readImage(const fs::path& path, const std::string& name) {
  const cv::Mat grey = cv::imread(path.string(), cv::IMREAD_GRAYSCALE);
  if (grey.empty())
    throw std::invalid_argument(fmt::format("{}: cannot be read as an image", path.string()));
  return {name, grey};
}

CameraImages readFolder(const fs::path& folder) {
  // A path that ends in a slash has no last part.
  const fs::path named = folder.has_filename() ? folder : folder.parent_path();
  CameraImages camera{fs::absolute(named).lexically_normal().filename().string(), {}};
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.is_regular_file())
      files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  for (const fs::path& file : files)
    camera.images.push_back(readImage(file, file.filename().string()));
  return camera;
}

std::vector<CameraImages> readImages(const std::vector<std::string>& paths) {
  const auto folders = std::count_if(
      paths.begin(), paths.end(), [](const std::string& path) { return fs::is_directory(path); });
  std::vector<CameraImages> cameras;
  if (folders == 0) {
    cameras.emplace_back();
    for (const std::string& path : paths)
      cameras.back().images.push_back(readImage(path, path));
    return cameras;
  }
  if (folders != static_cast<std::ptrdiff_t>(paths.size()))
    throw std::invalid_argument(
        "give either images of one camera or a folder for each camera, not both");
  for (const std::string& path : paths)
    cameras.push_back(readFolder(path));
  return cameras;
}

void requireNames(const std::vector<CameraImages>& cameras) {
  if (cameras.size() > model::kMostCameras)
    throw std::invalid_argument(fmt::format("there are {} cameras, at most {} can be calibrated",
                                            cameras.size(), model::kMostCameras));
  for (std::size_t i = 0; i < cameras.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (cameras[i].name == cameras[j].name)
        throw std::invalid_argument(fmt::format("there are two cameras '{}'", cameras[i].name));
}

std::vector<CameraImages> camerasOf(CalibrateOptions& options) {
  if (options.live.channels.empty() == options.images.empty())
    throw std::invalid_argument("give either images (or folders of them) or --channel");
  if (options.live.channels.empty())
    return readImages(options.images);
  std::vector<CameraImages> cameras;
  for (const std::string& channel : options.live.channels) {
    if (!config::isImageChannel(channel))
      throw std::invalid_argument(
          fmt::format("--channel: '{}' is no channel of images: CAMERA_ and capitals, digits or "
                      "underscores, not CAMERA_INFO",
                      channel));
    cameras.push_back({channel, {}});
  }
  requireNames(cameras);
  options.live.shape = options.board;
  return collectViews(options.live);
}

vision_tracker::WorldBoard worldOf(const CalibrateOptions& options) {
  vision_tracker::WorldBoard world;
  world.view = options.world;
  const std::vector<double>& pose = options.board_pose;
  if (pose.empty())
    return world;
  world.p_WB = Eigen::Vector3d(pose[0], pose[1], pose[2]);
  world.R_WB = (Eigen::AngleAxisd(pose[5], Eigen::Vector3d::UnitZ()) *
                Eigen::AngleAxisd(pose[4], Eigen::Vector3d::UnitY()) *
                Eigen::AngleAxisd(pose[3], Eigen::Vector3d::UnitX()))
                   .toRotationMatrix();
  return world;
}

/// `stem`.csv and `stem`.png
void writeResiduals(const fs::path& stem, const BoardCalibration& found) {
  std::ofstream table(stem.string() + ".csv");
  table << "image,corners,used,rms_px\n";
  for (const vision_tracker::BoardView& view : found.views)
    table << fmt::format("{},{},{},{:.4f}\n", view.name, view.corners.ids.size(), view.used ? 1 : 0,
                         view.rms);
  if (!table.flush() || !cv::imwrite(stem.string() + ".png", found.picture))
    throw std::invalid_argument(fmt::format("{}.csv or .png: cannot be written", stem.string()));
}

void sayResult(const std::string& name, const BoardCalibration& found) {
  const auto used = std::count_if(found.views.begin(), found.views.end(),
                                  [](const vision_tracker::BoardView& view) { return view.used; });
  const model::Camera& camera = found.camera;
  fmt::print("{}{} of {} images, residuals {:.3f} px rms\n", name.empty() ? "" : name + ": ", used,
             found.views.size(), found.rms);
  fmt::print(
      "focal length {:.2f}, {:.2f} px (+- {:.2f}), principal point {:.2f}, {:.2f} px (+- {:.2f})\n",
      camera.fx, camera.fy, found.focal_sigma, camera.cx, camera.cy, found.centre_sigma);
}

int calibrate(CalibrateOptions& options) {
  cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
  const std::vector<CameraImages> cameras = camerasOf(options);
  requireNames(cameras);
  vision_tracker::RigCalibration rig =
      vision_tracker::calibrateRig(cameras, options.board, worldOf(options));
  // Nobody said where the board was, and there is no other camera to agree with.
  if (cameras.size() == 1 && options.world.empty() && options.board_pose.empty()) {
    rig.cameras[0].camera.R_CW.setIdentity();
    rig.cameras[0].camera.p_CW.setZero();
  }
  const fs::path folder(options.live.folder);
  std::error_code error;
  fs::create_directories(folder, error);
  std::vector<model::Camera> all;
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    const BoardCalibration& found = rig.cameras[i];
    const std::string& name = cameras[i].name;
    all.push_back(found.camera);
    if (!name.empty())
      config::writeCalibration((folder / (name + ".yaml")).string(), {found.camera});
    writeResiduals(folder / (name.empty() ? "residuals" : name + "-residuals"), found);
    sayResult(name, found);
  }
  config::writeCalibration((folder / "calibration.yaml").string(), all);
  if (cameras.size() > 1)
    fmt::print("the cameras to each other: residuals {:.3f} px rms\n", rig.pair_rms);
  fmt::print("wrote {}\n", options.live.folder);
  return messaging::kExitDone;
}

void addBoardFlags(CLI::App& command, vision_tracker::BoardShape& board) {
  command.add_option("--square", board.square, "Side of a square [m]")->required();
  command.add_option("--marker", board.marker, "Side of a marker [m]")->required();
  command.add_option("--columns", board.columns, "Squares of the board across")
      ->capture_default_str();
  command.add_option("--rows", board.rows, "Squares of the board down")->capture_default_str();
  command
      .add_option("--dictionary", board.dictionary,
                  "Markers: 4X4_50, 4X4_250, 5X5_100, 5X5_250, 6X6_250, 7X7_250")
      ->capture_default_str();
}

}  // namespace

void addCalibrateCommand(CLI::App& app, int& exit_status) {
  auto options = std::make_shared<CalibrateOptions>();
  options->live.lcm_url = messaging::defaultLcmUrl();
  options->live.views = 20;
  CLI::App* command = app.add_subcommand("calibrate",
                                         "Calibrate one to four cameras from images of a ChArUco "
                                         "board, of files or as they come: OpenCV "
                                         "YAML, and for each camera a table (CSV) and a picture "
                                         "(PNG) of the residuals, 100 times as long");
  command->add_option(
      "IMAGE", options->images,
      "Images of the board, at least eight, tilted, in all parts of the image; of several "
      "cameras: a folder for each, in which images of one name were taken together");
  command
      ->add_option("--channel", options->live.channels,
                   "A running camera's channel, instead of images; once for each camera")
      ->allow_extra_args(false);
  command->add_option("--views", options->live.views, "Views to collect of each running camera")
      ->check(CLI::Range(8, 500))
      ->capture_default_str();
  command->add_option("--lcm-url", options->live.lcm_url, "LCM network of the running cameras");
  addBoardFlags(*command, options->board);
  command->add_option(
      "--world", options->world,
      "The image in which the board defines the world: x along its rows, y down its "
      "columns, origin at the outer corner of its first square (default: the first; without it, "
      "one "
      "camera's world is its own frame)");
  command
      ->add_option(
          "--board-pose", options->board_pose,
          "X Y Z [m] ROLL PITCH YAW [rad] of the board of that image in the world, turned "
          "about z by YAW after y by PITCH after x by ROLL (default: the board is the world)")
      ->expected(6);
  command->add_option("-o,--output", options->live.folder, "Folder to write to")->required();
  command->callback([options, &exit_status] { exit_status = calibrate(*options); });
}

}  // namespace fastball::launch
