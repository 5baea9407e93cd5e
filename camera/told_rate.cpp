#include "camera/told_rate.h"

#include <cmath>

namespace fastball::camera {

double toldRate(const cv::VideoCapture& capture) {
  const double told = capture.get(cv::CAP_PROP_FPS);
  return std::isfinite(told) && told > 0.1 && told < 1e5 ? told : 0;
}

}  // namespace fastball::camera
