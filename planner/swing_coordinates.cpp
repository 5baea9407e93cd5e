#include "planner/swing_coordinates.h"

namespace fastball::planner {
namespace {

// Of the variables of each base function.
enum { kAmplitude, kOmega, kPhase, kOffset, kBlock };

constexpr int kExponential = 1;  // which base function is one

BaseCurve curveOf(int block, const Eigen::Vector4d& p) {
  return block == kExponential
             ? BaseCurve(model::ExpBase{p[kAmplitude], p[kOmega], p[kPhase], p[kOffset]})
             : BaseCurve(model::SinBase{p[kAmplitude], p[kOmega], p[kPhase], p[kOffset]});
}

}  // namespace

SwingVector coordinatesOf(const SwingVector& x) {
  SwingVector y = x;
  for (int i = 0; i < 4; ++i) {
    const Eigen::Vector4d p = x.segment<kBlock>(kBlock * i);
    y[kBlock * i + kAmplitude] = p[kAmplitude] * p[kOmega];
    y[kBlock * i + kOffset] = curveOf(i, p).at(0).q;
  }
  return y;
}

SwingVector parametersOf(const SwingVector& y) {
  SwingVector x = y;
  for (int i = 0; i < 4; ++i) {
    Eigen::Vector4d p = y.segment<kBlock>(kBlock * i);
    p[kAmplitude] /= p[kOmega];
    p[kOffset] += p[kOffset] - curveOf(i, p).at(0).q;
    x.segment<kBlock>(kBlock * i) = p;
  }
  return x;
}

CoordinateGradient::CoordinateGradient(const SwingVector& x) {
  for (int i = 0; i < 4; ++i) {
    const Eigen::Vector4d p = x.segment<kBlock>(kBlock * i);
    const Eigen::Vector4d by = curveOf(i, p).derivativesAt(0).dq;
    Block& block = blocks_[i];
    block.amplitude_by_speed = 1 / p[kOmega];
    block.amplitude_by_omega = -p[kAmplitude] / p[kOmega];
    // The value at the release stays the same.
    block.c_by_speed = -by[kAmplitude] * block.amplitude_by_speed;
    block.c_by_omega = -by[kAmplitude] * block.amplitude_by_omega - by[kOmega];
    block.c_by_phase = -by[kPhase];
  }
}

SwingVector CoordinateGradient::operator()(const SwingVector& by_parameters) const {
  SwingVector result = by_parameters;
  for (int i = 0; i < 4; ++i) {
    const Block& block = blocks_[i];
    const Eigen::Vector4d g = by_parameters.segment<kBlock>(kBlock * i);
    result[kBlock * i + kAmplitude] =
        g[kAmplitude] * block.amplitude_by_speed + g[kOffset] * block.c_by_speed;
    result[kBlock * i + kOmega] +=
        g[kAmplitude] * block.amplitude_by_omega + g[kOffset] * block.c_by_omega;
    result[kBlock * i + kPhase] += g[kOffset] * block.c_by_phase;
  }
  return result;
}

}  // namespace fastball::planner
