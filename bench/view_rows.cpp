#include "bench/view_rows.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <boost/process/args.hpp>
#include <boost/process/exe.hpp>
#include <boost/process/io.hpp>
#include <boost/process/system.hpp>
#include <filesystem>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <thread>

#include "bench/timing.h"
#include "bench/viewing_page.h"
#include "config/experiment.h"
#include "launch/processes.h"
#include "launch/view/view_server.h"

namespace fastball::bench {
namespace {

namespace bp = boost::process;
namespace fs = std::filesystem;

constexpr const char* kThrows = "5";
constexpr int kPairs = 3;

/// A folder of its own, while it is needed.
struct Folder {
  Folder() { fs::create_directories(path); }
  ~Folder() {
    std::error_code ignored;
    fs::remove_all(path, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  const fs::path path = fs::temp_directory_path() / fmt::format("fastball-bench-view-{}", getpid());
};

/// [s] wall time of each throw of a run in lockstep, with all processes and images.
std::vector<double> throwTimes(const std::string& url, const Folder& folder) {
  const fs::path json = folder.path / "run.json";
  const std::vector<std::string> arguments = {
      "run",       "--throws", kThrows, "--json", json, "--log", folder.path / "run.lcmlog",
      "--lcm-url", url};
  const int status = bp::system(bp::exe = launch::programFolder() + "/fastball",
                                bp::args = arguments, bp::std_out > bp::null);
  if (status != 0)
    throw std::runtime_error(fmt::format("the measured run ended with exit status {}", status));
  std::ifstream file(json);
  return nlohmann::json::parse(file).at("throw_wall_s");
}

/// `fastball view` with a page that looks on, each on a thread of its own.
class Watched {
 public:
  Watched(const std::string& url, const Folder& folder) : server_(options(url, folder)) {
    thread_ = std::thread([this] { server_.run([this] { return ended_.load(); }); });
    const std::string page = server_.url();
    const auto colon = page.rfind(':') + 1;
    page_ = std::make_unique<ViewingPage>(page.substr(colon, page.size() - colon - 1));
  }
  ~Watched() {
    page_.reset();
    ended_ = true;
    thread_.join();
  }
  Watched(const Watched&) = delete;
  Watched& operator=(const Watched&) = delete;
  const ViewingPage& page() const { return *page_; }

 private:
  static view::ViewOptions options(const std::string& url, const Folder& folder) {
    std::ofstream(folder.path / "index.html") << "<!doctype html>";
    view::ViewOptions options;
    options.config = config::experimentPath("");
    options.lcm_url = url;
    options.port = 0;
    options.page_folder = folder.path;
    options.may_throw = false;
    return options;
  }
  view::ViewServer server_;
  std::atomic<bool> ended_{false};
  std::thread thread_;
  std::unique_ptr<ViewingPage> page_;
};

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

Row lockstepRatio() {
  const Folder folder;
  const std::string url = privateLcmUrl();
  std::vector<double> alone, watched;
  int frames = 0, pictures = 0;
  // In turn, so that what else the machine does falls on both.
  for (int i = 0; i < kPairs; ++i) {
    for (const double seconds : throwTimes(url, folder))
      alone.push_back(seconds);
    const Watched viewer(url, folder);
    for (const double seconds : throwTimes(url, folder))
      watched.push_back(seconds);
    frames += viewer.page().frames();
    pictures += viewer.page().pictures();
  }
  return {"view.lockstep_ratio",
          median(watched) / median(alone),
          "times",
          "nobody looks on",
          1.0,
          fmt::format("wall time of a throw, all processes and images, median of {}: {:.3f} s, "
                      "alone {:.3f} s; a page took {} "
                      "frames and {} images",
                      watched.size(), median(watched), median(alone), frames, pictures)};
}

}  // namespace

std::vector<Benchmark> viewBenchmarks() {
  return {{"view.lockstep_ratio", lockstepRatio}};
}

}  // namespace fastball::bench
