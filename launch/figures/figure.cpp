#include "launch/figures/figure.h"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <stdexcept>

namespace fastball::launch {
namespace {

namespace fs = std::filesystem;

void makeFolder(const std::string& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  const std::string probe = folder + "/README.md";
  if (!std::ofstream(probe, std::ios::app)) {
    throw std::invalid_argument(fmt::format("-o {}: no file can be written there{}", folder,
                                            error ? fmt::format(" ({})", error.message()) : ""));
  }
}

void write(const std::string& path, const std::string& text) {
  std::ofstream file(path);
  if (!(file << text).flush())
    throw std::runtime_error(fmt::format("cannot write '{}'", path));
}

/// "[fig04-fits.csv](fig04-fits.csv), ...": the tables of a figure that the folder holds.
std::string tablesOf(const std::string& figure, const std::string& folder) {
  std::set<std::string> names;
  for (const auto& file : fs::directory_iterator(folder)) {
    const std::string name = file.path().filename().string();
    if (file.path().extension() == ".csv" &&
        (name == figure + ".csv" || name.rfind(figure + "-", 0) == 0))
      names.insert(name);
  }
  std::string links;
  for (const std::string& name : names)
    links += fmt::format("{}[{}]({})", links.empty() ? "" : ", ", name, name);
  return links;
}

/// The index of all figures that the folder holds, also those drawn earlier.
void writeIndex(const FigureTask& task) {
  std::string index = fmt::format(
      "# Figures\n\nDrawn by `fastball figures` with the arm `{}`. Each stands here as PNG, as SVG "
      "and as numbers "
      "(CSV).\n",
      task.experiment.arm.profile);
  for (const Figure& figure : allFigures()) {
    std::ifstream caption(fmt::format("{}/{}.txt", task.folder, figure.name));
    if (!caption)
      continue;
    const std::string text{std::istreambuf_iterator<char>(caption), {}};
    index += fmt::format("\n## {0}: {1}\n\n![{1}]({0}.svg)\n\n{2}\nNumbers: {3}\n", figure.name,
                         figure.title, text, tablesOf(figure.name, task.folder));
  }
  write(task.folder + "/README.md", index);
}

}  // namespace

const std::vector<Figure>& allFigures() {
  static const std::vector<Figure> figures = {
      {"fig04", "Joint 2 left to itself, for several speeds of joints 1 and 3 (Fig. 4)",
       drawPassiveBend},
      {"fig05", "The optimal swing of the first model (Fig. 5)", drawLevelSwing},
      {"fig05b", "The planned swing of the analogous model on the arm (section 2.6)",
       drawPlannedSwing},
      {"fig08", "Rolling distance and normal force (Fig. 8)", drawRollingRange},
      {"fig09", "What rolling does for the direction of the throw (Fig. 9)", drawReleaseShift},
      {"fig11", "The planned throw on the simulated arm (Fig. 11)", drawTracking},
      {"fig12", "Hand and ball at the release (Fig. 12)", drawReleasePicture},
      {"fig14_15", "The elastic ball: force, displacement and delay (Figs. 14, 15)",
       drawElasticRelease},
      {"fig_budget", "What the kinetic chain is worth", drawTorqueBudget},
      {"fig_cost", "What planning costs", drawPlanCost},
  };
  return figures;
}

void writeFigures(const FigureTask& task,
                  const std::regex& only,
                  const std::function<void(const std::string&)>& say) {
  std::vector<Figure> wanted;
  for (const Figure& figure : allFigures()) {
    if (std::regex_search(figure.name, only))
      wanted.push_back(figure);
  }
  if (wanted.empty()) {
    std::string names;
    for (const Figure& figure : allFigures())
      names += (names.empty() ? "" : ", ") + figure.name;
    throw std::invalid_argument(
        fmt::format("--only: no figure has such a name; there are {}", names));
  }
  makeFolder(task.folder);
  for (const Figure& figure : wanted) {
    say(fmt::format("{}: {}", figure.name, figure.title));
    try {
      const std::string caption = figure.draw(task);
      write(fmt::format("{}/{}.txt", task.folder, figure.name), caption + "\n");
      say("  " + caption);
    } catch (const std::exception& e) {
      throw std::runtime_error(fmt::format("{} cannot be drawn: {}", figure.name, e.what()));
    }
    writeIndex(task);
  }
}

}  // namespace fastball::launch
