#include "launch/report/target_face.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <vector>

#include "launch/figures/style.h"
#include "launch/gnuplot.h"

namespace fastball::launch {
namespace {

constexpr double kChiSquare95 = 5.991;  // of two degrees of freedom

Eigen::Matrix2d covarianceOf(const landing_t& landing) {
  Eigen::Matrix2d covariance;
  covariance << landing.cov_landing[0], landing.cov_landing[1], landing.cov_landing[1],
      landing.cov_landing[2];
  return covariance;
}

/// Outlines of two circles [mm] as blocks of data.
std::string circles(double outer, double inner) {
  std::string outlines;
  for (const double radius : {outer, inner}) {
    for (int i = 0; i <= 72; ++i)
      outlines += fmt::format("{:.3f} {:.3f}\n", radius * std::cos(i * M_PI / 36),
                              radius * std::sin(i * M_PI / 36));
    outlines += "\n\n";
  }
  return outlines;
}

/// The landing as gnuplot shall draw it.
struct Marks {
  std::vector<Eigen::Vector2d> places;  ///< [mm]
  std::string data, plot;
  std::string key;  ///< plot of what the signs mean
  /// Half the width [mm] of a square about centre() that holds them, the ellipse included.
  double reach = 0.5;
  Eigen::Vector2d centre() const { return (places.front() + places.back()) / 2; }
};

Marks marksOf(const LoggedThrow& thrown) {
  Marks marks;
  const auto add = [&marks](const std::string& name, const Eigen::Vector2d& place) {
    marks.places.push_back(1e3 * place);
    marks.data += dataBlock(name, fmt::format("{:.4f} {:.4f}\n", 1e3 * place.x(), 1e3 * place.y()));
  };
  double ellipse = 0;
  if (thrown.isMeasured()) {
    const landing_t& landing = *thrown.record.landing;
    add("measured", {landing.landing[0], landing.landing[1]});
    marks.data += dataBlock("ellipse", ellipse95(landing));
    marks.plot += fmt::format(
        ", $ellipse w l lw 2 lc rgb {0}, $measured w p pt 7 ps 0.9 lc rgb {0}", kColours[1]);
    marks.key +=
        fmt::format(", NaN w lp pt 7 ps 0.9 lw 2 lc rgb {} title 'landing measured, 95 % ellipse'",
                    kColours[1]);
    ellipse = 1e3 * extent95(landing).maxCoeff();
  }
  if (thrown.truth.landing) {
    add("true", *thrown.truth.landing);
    marks.plot += ", $true w p pt 2 ps 1.2 lw 2 lc rgb '#000000'";
    marks.key += ", NaN w p pt 2 ps 1.2 lw 2 lc rgb '#000000' title 'true landing'";
  }
  for (const Eigen::Vector2d& place : marks.places)
    marks.reach =
        std::max(marks.reach, (place - marks.centre()).lpNorm<Eigen::Infinity>() + ellipse);
  return marks;
}

/// Axes of a square panel about a place [mm].
std::string squareAxes(const Eigen::Vector2d& centre, double half_width) {
  const double step = roundStep(half_width / 2);
  return fmt::format(
      "set xrange [{:.4f}:{:.4f}]; set yrange [{:.4f}:{:.4f}]; set xtics {:g}; set ytics {:g}\n",
      centre.x() - half_width, centre.x() + half_width, centre.y() - half_width,
      centre.y() + half_width, step, step);
}

}  // namespace

std::string ellipse95(const landing_t& landing) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(covarianceOf(landing));
  const Eigen::Matrix2d spread =
      axes.eigenvectors() *
      (kChiSquare95 * axes.eigenvalues().cwiseMax(0)).cwiseSqrt().asDiagonal();
  std::string outline;
  for (int i = 0; i <= 72; ++i) {
    const double angle = i * M_PI / 36;
    const Eigen::Vector2d p = spread * Eigen::Vector2d(std::cos(angle), std::sin(angle));
    outline += fmt::format("{:.4f} {:.4f}\n", 1e3 * (landing.landing[0] + p.x()),
                           1e3 * (landing.landing[1] + p.y()));
  }
  return outline;
}

Eigen::Vector2d extent95(const landing_t& landing) {
  return (kChiSquare95 * covarianceOf(landing).diagonal()).cwiseMax(0).cwiseSqrt();
}

FacePanels facePanels(const LoggedThrow& thrown,
                      const model::Target& target,
                      double ball_radius,
                      const std::string& whole,
                      const std::string& enlarged) {
  const Marks marks = marksOf(thrown);
  const double ring = 1e3 * target.radius, inner = std::max(ring - 1e3 * ball_radius, 0.0);
  double farthest = ring;
  for (const Eigen::Vector2d& place : marks.places)
    farthest = std::max(farthest, place.lpNorm<Eigen::Infinity>());
  FacePanels panels;
  panels.data = dataBlock("rings", circles(ring, inner)) + marks.data;
  panels.commands = fmt::format(
      "set xlabel 'right (mm)' offset 0,0.5; set ylabel 'up (mm)' offset 1.2,0\n"
      "set title 'The net, seen from the robot' offset 0,-0.6\n{}{}{}"
      "plot $rings index 0 w l lw 3 lc rgb '#222222', "
      "$rings index 1 w l lw 1.5 dt 2 lc rgb '#222222'{}{}\nunset label 9; set key off\n",
      whole, squareAxes({0, 0}, 1.25 * farthest),
      marks.places.empty() ? "set label 9 'no landing' at graph 0.5,0.5 center front\n" : "",
      marks.plot, marks.key);
  if (!marks.places.empty())
    panels.commands += fmt::format(
        "set title 'The landing, enlarged' offset 0,-0.6; set ylabel offset -0.3,0\n{}{}plot "
        "NaN{}\n",
        enlarged, squareAxes(marks.centre(), 1.3 * marks.reach), marks.plot);
  return panels;
}

double roundStep(double least) {
  const double power = std::pow(10, std::floor(std::log10(least)));
  for (const double digit : {1, 2, 5}) {
    if (digit * power >= least * (1 - 1e-9))
      return digit * power;
  }
  return 10 * power;
}

}  // namespace fastball::launch
