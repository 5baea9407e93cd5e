#pragma once

#include <opencv2/videoio.hpp>

namespace fastball::camera {

/// [Hz], the rate that OpenCV tells of a device or a file, or 0 where what it tells is none.
double toldRate(const cv::VideoCapture& capture);

}  // namespace fastball::camera
