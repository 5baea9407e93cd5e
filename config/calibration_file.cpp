#include "config/calibration_file.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <cmath>
#include <opencv2/calib3d.hpp>
#include <opencv2/core.hpp>
#include <stdexcept>

namespace fastball::config {
namespace {

constexpr int kLargestSide = 16384;  // [px]

/// One camera's map in the file.
class CameraReader {
 public:
  CameraReader(const std::string& path, const std::string& where, const cv::FileNode& node)
      : path_(path), where_(where), node_(node) {}

  model::Camera read() const {
    model::Camera camera;
    camera.width = side("image_width");
    camera.height = side("image_height");
    const cv::Mat1d K = numbers("camera_matrix", {9});
    camera.fx = K(0);
    camera.cx = K(2);
    camera.fy = K(4);
    camera.cy = K(5);
    if (!(camera.fx > 0 && camera.fy > 0))
      fail("camera_matrix", fmt::format("has focal lengths {} and {} px, both must be positive",
                                        camera.fx, camera.fy));
    if (!(camera.cx > -camera.width && camera.cx < 2 * camera.width && camera.cy > -camera.height &&
          camera.cy < 2 * camera.height))
      fail("camera_matrix", fmt::format("has its principal point at ({}, {}) px, far outside of an "
                                        "image of {} x {}",
                                        camera.cx, camera.cy, camera.width, camera.height));
    const cv::Mat1d distortion = numbers("distortion_coefficients", {4, 5});
    for (int i = 0; i < static_cast<int>(distortion.total()); ++i)
      camera.distortion[i] = distortion(i);
    readPose(camera);
    return camera;
  }

 private:
  [[noreturn]] void fail(const std::string& key, const std::string& sentence) const {
    throw std::invalid_argument(fmt::format("{}: {}key '{}' {}", path_, where_, key, sentence));
  }

  cv::FileNode at(const std::string& key) const {
    const cv::FileNode value = node_[key];
    if (value.empty())
      fail(key, "is missing");
    return value;
  }

  int side(const std::string& key) const {
    const cv::FileNode value = at(key);
    const double pixels = value.isReal() || value.isInt() ? value.real() : 0;
    if (!(pixels >= 16 && pixels <= kLargestSide && pixels == std::floor(pixels)))
      fail(key, fmt::format("must be a whole number of pixels from 16 to {}", kLargestSide));
    return static_cast<int>(pixels);
  }

  /// A matrix or a list of one of `counts` numbers, as one row.
  cv::Mat1d numbers(const std::string& key, const std::vector<int>& counts) const {
    const cv::FileNode value = at(key);
    cv::Mat matrix;
    std::vector<double> list;
    if (value.isMap()) {
      value >> matrix;
    } else if (value.isSeq()) {
      value >> list;
      matrix = cv::Mat(list, true);
    }
    bool fits = false;
    for (const int count : counts)
      fits = fits || (matrix.channels() == 1 && static_cast<int>(matrix.total()) == count);
    if (!fits)
      fail(key, fmt::format("must hold {} numbers, it holds {}", counts.back(), matrix.total()));
    cv::Mat1d row = cv::Mat1d(matrix).reshape(0, 1).clone();
    if (!cv::checkRange(row))
      fail(key, "holds a number that is not finite");
    return row;
  }

  void readPose(model::Camera& camera) const {
    if (node_["R"].empty() && node_["T"].empty())
      return;
    cv::Mat1d R = numbers("R", {3, 9});
    if (R.total() == 3)
      cv::Rodrigues(R.clone(), R);
    const cv::Mat1d T = numbers("T", {3});
    for (int i = 0; i < 9; ++i)
      camera.R_CW(i / 3, i % 3) = R(i / 3 * (R.rows == 3 ? 1 : 0), R.rows == 3 ? i % 3 : i);
    camera.p_CW << T(0), T(1), T(2);
    const double off = (camera.R_CW * camera.R_CW.transpose() - Eigen::Matrix3d::Identity()).norm();
    if (!(off < 1e-4 && camera.R_CW.determinant() > 0))
      fail("R", fmt::format("is no rotation: R R^T differs from the identity by {:.2g}", off));
    // Files hold few digits: the nearest rotation.
    camera.R_CW = Eigen::Quaterniond(camera.R_CW).normalized().toRotationMatrix();
  }

  const std::string& path_;
  std::string where_;
  cv::FileNode node_;
};

cv::Mat1d matrixOf(const Eigen::MatrixXd& m) {
  cv::Mat1d result(static_cast<int>(m.rows()), static_cast<int>(m.cols()));
  for (int r = 0; r < result.rows; ++r)
    for (int c = 0; c < result.cols; ++c)
      result(r, c) = m(r, c);
  return result;
}

cv::FileStorage opened(const std::string& path) {
  try {
    cv::FileStorage file(path, cv::FileStorage::READ);
    if (file.isOpened())
      return file;
  } catch (const cv::Exception& e) {
    throw std::invalid_argument(fmt::format("{}: is no OpenCV file: {}", path, e.err));
  }
  throw std::invalid_argument(fmt::format("{}: cannot be read", path));
}

}  // namespace

std::vector<model::Camera> readCalibration(const std::string& path) {
  const cv::FileStorage file = opened(path);
  std::vector<model::Camera> cameras;
  const cv::FileNode list = file["cameras"];
  if (list.empty()) {
    cameras.push_back(CameraReader(path, "", file.root()).read());
    return cameras;
  }
  if (!list.isSeq() || list.size() < 1 || list.size() > model::kMostCameras)
    throw std::invalid_argument(fmt::format("{}: key 'cameras' must be a list of one to {} cameras",
                                            path, model::kMostCameras));
  for (std::size_t i = 0; i < list.size(); ++i)
    cameras.push_back(
        CameraReader(path, fmt::format("camera {}: ", i + 1), list[static_cast<int>(i)]).read());
  return cameras;
}

void writeCalibration(const std::string& path, const std::vector<model::Camera>& cameras) {
  cv::FileStorage file;
  try {
    file.open(path, cv::FileStorage::WRITE | cv::FileStorage::FORMAT_YAML);
  } catch (const cv::Exception&) {
    file.release();
  }
  if (!file.isOpened())
    throw std::invalid_argument(fmt::format("{}: cannot be written", path));
  file << "cameras"
       << "[";
  for (const model::Camera& camera : cameras) {
    const Eigen::Matrix3d K =
        (Eigen::Matrix3d() << camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1).finished();
    file << "{"
         << "image_width" << camera.width << "image_height" << camera.height << "camera_matrix"
         << matrixOf(K) << "distortion_coefficients" << matrixOf(camera.distortion.transpose())
         << "R" << matrixOf(camera.R_CW) << "T" << matrixOf(camera.p_CW) << "}";
  }
  file << "]";
}

}  // namespace fastball::config
