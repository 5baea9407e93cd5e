#pragma once

#include <functional>
#include <regex>
#include <string>
#include <vector>

#include "config/experiment.h"

/// The paper's figures of sections 2, 3, 4.3 and 5, computed anew by this program.
namespace fastball::launch {

/// What figures are drawn from, and where to.
struct FigureTask {
  std::string config;  ///< experiment file
  config::Experiment experiment;
  std::string folder;
};

/// One figure: `draw` writes <name>.png, <name>.svg and <name>*.csv into the folder and gives the
/// caption: sentences that state what is seen, with the numbers computed for them.
struct Figure {
  std::string name;   ///< "fig04"
  std::string title;  ///< for the index of all figures
  std::function<std::string(const FigureTask&)> draw;
};

const std::vector<Figure>& allFigures();

/// Draws the figures whose names `only` finds, writes each caption to <name>.txt and the index of
/// all figures in the folder to README.md. `say` is told of each figure when it is begun and when
/// it is done.
/// @throw std::invalid_argument if none has such a name or nothing can be written to the folder
/// (made if absent).
/// @throw std::runtime_error if a figure cannot be drawn; says which.
void writeFigures(const FigureTask& task,
                  const std::regex& only,
                  const std::function<void(const std::string&)>& say);

// Each in a file of its own.
std::string drawPassiveBend(const FigureTask& task);
std::string drawLevelSwing(const FigureTask& task);
std::string drawPlannedSwing(const FigureTask& task);
std::string drawRollingRange(const FigureTask& task);
std::string drawReleaseShift(const FigureTask& task);
std::string drawTracking(const FigureTask& task);
std::string drawReleasePicture(const FigureTask& task);
std::string drawElasticRelease(const FigureTask& task);
std::string drawTorqueBudget(const FigureTask& task);
std::string drawPlanCost(const FigureTask& task);

}  // namespace fastball::launch
