#include "vision_tracker/blurred_sphere.h"

namespace fastball::vision_tracker {
namespace {

double normalDensity(double z) {
  return 0.3989422804014327 * std::exp(-0.5 * z * z);
}

}  // namespace

BlurTable::BlurTable() {
  for (int i = 0; i <= kEntries; ++i) {
    const double s = kLowest + i * kSpacing;
    const double density = normalDensity(s);
    share_[i] = {0.5 * std::erfc(-s * 0.70710678118654752), density};
    density_[i] = {density, -s * density};
    // With s + z = y^2 the integrand is smooth.
    constexpr double kDy = 0.01;
    for (double y = kDy; y < 4.5; y += kDy) {
      const double z = y * y - s;
      const double weight = normalDensity(z) * 2 * y * kDy;
      root_[i].value += weight * y;
      root_[i].slope += weight * y * z;
    }
  }
}

}  // namespace fastball::vision_tracker
