// The filter of the aim as a file.
#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "config/strict_yaml.h"
#include "launch/aim_filter.h"

namespace fastball::launch {
namespace {

constexpr int kMostThrows = 1000000000;
// Far beyond what any set-up does.
constexpr config::Range kBias{-10, 10};
constexpr double kLeastEigenvalue = -1e-12;

std::string numbers(const Eigen::Ref<const Eigen::VectorXd>& v) {
  std::string text;
  for (const double value : v)
    text += fmt::format("{}{:.17g}", text.empty() ? "" : ", ", value);
  return '[' + text + ']';
}

}  // namespace

void AimFilter::save(const std::string& path) const {
  const std::string unfinished = path + ".new";
  std::ofstream file(unfinished);
  file << "# What strategy adaptive has learned of the set-up; delete this file to forget it.\n"
       << "throws: " << throws_ << "\n"
       << "# drag [share], velocity towards the target, left, up [m/s], place of the target right, "
          "up [m]\n"
       << "biases: " << numbers(biases_) << "\ncovariance:\n";
  for (int i = 0; i < model::kLandingBiases; ++i)
    file << "  - " << numbers(covariance_.row(i).transpose()) << '\n';
  file.close();
  std::error_code error;
  std::filesystem::rename(unfinished, path, error);
  if (!file || error)
    throw std::runtime_error(fmt::format("{}: what was learned cannot be written there", path));
}

void AimFilter::load(const std::string& path) {
  if (!std::filesystem::exists(path))
    return;
  config::Section file = config::Section::fromFile(path);
  const int throws = file.integer("throws", 0, kMostThrows);
  const model::LandingBiases biases = file.vector("biases", model::kLandingBiases, kBias);
  const Covariance covariance =
      file.matrix("covariance", model::kLandingBiases, model::kLandingBiases, kBias);
  file.finish();
  const Eigen::SelfAdjointEigenSolver<Covariance> spectrum(covariance);
  if (!covariance.isApprox(covariance.transpose(), 1e-9) ||
      spectrum.eigenvalues().minCoeff() < kLeastEigenvalue)
    throw file.error("covariance", "is no covariance: symmetric, without negative eigenvalues");
  throws_ = throws;
  biases_ = biases;
  covariance_ = covariance;
}

}  // namespace fastball::launch
