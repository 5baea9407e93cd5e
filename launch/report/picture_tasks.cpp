#include "launch/report/picture_tasks.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/asio/post.hpp>
#include <boost/asio/thread_pool.hpp>
#include <fstream>
#include <stdexcept>
#include <thread>

#include "launch/release_drawing.h"
#include "launch/report/missing.h"
#include "launch/report/run_pictures.h"
#include "launch/report/throw_pictures.h"

namespace fastball::launch {
namespace {

std::string drawReleaseOf(const LoggedThrow& thrown,
                          int64_t number,
                          const config::Experiment& experiment,
                          const std::string& path_stem) {
  const std::string caption =
      drawRelease(thrown.record, experiment, fmt::format("Throw {}", number), path_stem);
  if (!(std::ofstream(path_stem + ".txt") << caption << '\n').flush())
    throw std::runtime_error(fmt::format("cannot write '{}.txt'", path_stem));
  return caption;
}

void addThrow(const LoggedRun& run,
              int64_t number,
              const config::Experiment& experiment,
              std::vector<PictureTask>& tasks) {
  const LoggedThrow& thrown = run.throws.at(number);
  tasks.push_back({"throw", number, false,
                   [&](const std::string& stem) { return drawThrow(thrown, experiment, stem); }});
  tasks.push_back({"motion", number, true,
                   [&](const std::string& stem) { return drawMotion(thrown, experiment, stem); }});
  tasks.push_back({"fingers", number, true,
                   [&](const std::string& stem) { return drawFingers(thrown, stem); }});
  if (!tookPart(run, "vision_tracker"))
    return;
  tasks.push_back({"release", number, true, [&, number](const std::string& stem) {
                     return drawReleaseOf(thrown, number, experiment, stem);
                   }});
  tasks.push_back({"residuals", number, true, [&](const std::string& stem) {
                     return drawResiduals(thrown, run.cameras, experiment, stem);
                   }});
}

void draw(DrawnPicture& picture, const std::string& folder) {
  try {
    picture.caption = picture.task.draw(fmt::format("{}/{}", folder, picture.task.name()));
  } catch (const std::exception& e) {
    picture.failure = e.what();
  }
}

}  // namespace

std::string PictureTask::name() const {
  return number == 0 ? kind : fmt::format("{}-{}", kind, number);
}

std::vector<PictureTask> picturesOf(const LoggedRun& run, const config::Experiment& experiment) {
  std::vector<PictureTask> tasks;
  for (const auto& [number, thrown] : run.throws)
    addThrow(run, number, experiment, tasks);
  if (!run.throws.empty())
    tasks.push_back({"landings", 0, true, [&](const std::string& stem) {
                       return drawRunLandings(run, experiment, stem);
                     }});
  tasks.push_back(
      {"loops", 0, false, [&](const std::string& stem) { return drawLoops(run, stem); }});
  return tasks;
}

std::vector<DrawnPicture> drawAll(const std::vector<PictureTask>& tasks,
                                  const std::string& folder) {
  std::vector<DrawnPicture> pictures;
  for (const PictureTask& task : tasks)
    pictures.push_back({task, "", ""});
  boost::asio::thread_pool pool(std::max(1U, std::thread::hardware_concurrency()));
  for (DrawnPicture& picture : pictures)
    boost::asio::post(pool, [&picture, &folder] { draw(picture, folder); });
  pool.join();
  return pictures;
}

std::vector<std::string> failuresOf(const std::vector<DrawnPicture>& pictures) {
  std::map<std::pair<std::string, std::string>, std::vector<int64_t>> numbers;
  for (const DrawnPicture& picture : pictures) {
    if (!picture.failure.empty())
      numbers[{picture.task.kind, picture.failure}].push_back(picture.task.number);
  }
  std::vector<std::string> sentences;
  for (const auto& [what, throws] : numbers) {
    const auto& [kind, reason] = what;
    sentences.push_back(throws.front() == 0
                            ? fmt::format("There is no picture '{}': {}.", kind, reason)
                            : fmt::format("There is no picture '{}' of throw {}: {}.", kind,
                                          numberWords(throws), reason));
  }
  return sentences;
}

}  // namespace fastball::launch
