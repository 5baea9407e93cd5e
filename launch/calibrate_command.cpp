#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <memory>
#include <opencv2/core/utils/logger.hpp>
#include <opencv2/imgcodecs.hpp>

#include "config/calibration_file.h"
#include "launch/commands.h"
#include "messaging/process.h"
#include "vision_tracker/board_calibration.h"

namespace fastball::launch {
namespace {

struct CalibrateOptions {
  std::vector<std::string> images;
  std::string folder, world;
  vision_tracker::BoardShape board{8, 6, 0, 0, "5X5_100"};
};

vision_tracker::BoardImage readImage(const std::string& path) {
  const cv::Mat grey = cv::imread(path, cv::IMREAD_GRAYSCALE);
  if (grey.empty())
    throw std::invalid_argument(fmt::format("{}: cannot be read as an image", path));
  return {path, grey};
}

/// The board as it lies in the image of this name becomes the world.
void takeWorld(const std::string& name, vision_tracker::BoardCalibration& calibration) {
  for (const vision_tracker::BoardView& view : calibration.views) {
    if (view.name != name)
      continue;
    if (!view.used)
      throw std::invalid_argument(
          fmt::format("--world {}: the image shows too little of the board", name));
    calibration.camera.R_CW = view.R_CB;
    calibration.camera.p_CW = view.p_CB;
    return;
  }
  throw std::invalid_argument(fmt::format("--world {}: is none of the images", name));
}

int calibrate(const CalibrateOptions& options) {
  cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
  std::vector<vision_tracker::BoardImage> images;
  for (const std::string& path : options.images)
    images.push_back(readImage(path));
  vision_tracker::BoardCalibration found =
      vision_tracker::calibrateFromBoard(images, options.board);
  if (!options.world.empty())
    takeWorld(options.world, found);
  const std::filesystem::path folder(options.folder);
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  config::writeCalibration((folder / "calibration.yaml").string(), {found.camera});
  std::ofstream table(folder / "residuals.csv");
  table << "image,corners,used,rms_px\n";
  for (const vision_tracker::BoardView& view : found.views)
    table << fmt::format("{},{},{},{:.4f}\n", view.name, view.corners, view.used ? 1 : 0, view.rms);
  if (!table.flush() || !cv::imwrite((folder / "residuals.png").string(), found.picture))
    throw std::invalid_argument(fmt::format("{}: cannot be written", options.folder));
  const auto used = std::count_if(found.views.begin(), found.views.end(),
                                  [](const vision_tracker::BoardView& view) { return view.used; });
  const model::Camera& camera = found.camera;
  fmt::print("{} of {} images, residuals {:.3f} px rms\n", used, found.views.size(), found.rms);
  fmt::print(
      "focal length {:.2f}, {:.2f} px (+- {:.2f}), principal point {:.2f}, {:.2f} px (+- {:.2f})\n",
      camera.fx, camera.fy, found.focal_sigma, camera.cx, camera.cy, found.centre_sigma);
  fmt::print("wrote {}\n", options.folder);
  return messaging::kExitDone;
}

}  // namespace

void addCalibrateCommand(CLI::App& app, int& exit_status) {
  auto options = std::make_shared<CalibrateOptions>();
  CLI::App* command = app.add_subcommand("calibrate",
                                         "Calibrate a camera from images of a ChArUco board: "
                                         "OpenCV YAML, a table (CSV) and a picture (PNG) of the "
                                         "residuals, 100 times as long");
  command
      ->add_option("IMAGE", options->images,
                   "Images of the board, at least eight, tilted, in all parts of the image")
      ->required();
  command->add_option("--square", options->board.square, "Side of a square [m]")->required();
  command->add_option("--marker", options->board.marker, "Side of a marker [m]")->required();
  command->add_option("--columns", options->board.columns, "Squares of the board across")
      ->capture_default_str();
  command->add_option("--rows", options->board.rows, "Squares of the board down")
      ->capture_default_str();
  command
      ->add_option("--dictionary", options->board.dictionary,
                   "Markers: 4X4_50, 4X4_250, 5X5_100, 5X5_250, 6X6_250, 7X7_250")
      ->capture_default_str();
  command->add_option("--world", options->world,
                      "The image in which the board defines the world: x along its rows, y down "
                      "its columns, origin at its "
                      "first corner (default: the world is the camera's own frame)");
  command->add_option("-o,--output", options->folder, "Folder to write to")->required();
  command->callback([options, &exit_status] { exit_status = calibrate(*options); });
}

}  // namespace fastball::launch
