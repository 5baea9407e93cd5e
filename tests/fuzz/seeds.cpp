// Writes what the fuzzers begin with: FOLDER/TARGET/NAME, made of the genuine messages of a throw.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <set>

#include "launch/local_run.h"
#include "logger/log_writer.h"
#include "messaging/channels.h"
#include "tests/fuzz/conversation.h"
#include "tests/messaging/examples.h"

namespace fastball::fuzz {
namespace {

namespace fs = std::filesystem;

constexpr uint8_t kMillisecond = 3;     // a pause
constexpr std::size_t kWindow = 6;      // messages of one conversation
constexpr int kWindows = 8;             // spread over the throw
constexpr double kThumbnail = 1.0 / 8;  // of the cameras' images: decoded in a fraction of the time

template <class T>
Said said(const std::string& channel, const T& message) {
  Bytes bytes(static_cast<std::size_t>(message.getEncodedSize()));
  message.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
  return {channel, kMillisecond, bytes};
}

/// The plan with as few samples as its rule allows: a fuzzer is as quick as its inputs are short. Its numbers stay
/// a motion from rest to rest.
swing_plan_t thinned(swing_plan_t plan) {
  constexpr double kLongestStep = 0.1;  // [s]
  const auto every = static_cast<int32_t>(kLongestStep / plan.dt);
  const auto thin = [&](std::vector<std::vector<double>>& rows) {
    std::vector<std::vector<double>> kept;
    for (int32_t k = 0; k + 1 < plan.n_samples; k += every)
      kept.push_back(rows[static_cast<std::size_t>(k)]);
    kept.push_back(rows.back());
    rows = kept;
  };
  thin(plan.q);
  thin(plan.qd);
  thin(plan.qdd);
  plan.n_samples = static_cast<int32_t>(plan.q.size());
  plan.dt *= every;
  return plan;
}

/// Everything that is said in one throw, in its order, and what no good throw says.
class Recording {
 public:
  Recording() {
    launch::RunOptions options;
    options.throws = 1;
    options.no_network = true;
    const launch::RunSetup setup = launch::prepareRun(options);
    launch::Progress progress(true);
    launch::RunResult result;
    launch::runInOneProcess(setup, progress, result, [this](messaging::Endpoint& e) { listen(e); });
    if (!result.error.empty())
      throw std::runtime_error(result.error);
    namespace examples = messaging::examples;
    all_.push_back(said("ESTOP", examples::example<estop_t>()));
    all_.push_back(said("LOGGER_STATUS", examples::example<logger_status_t>()));
  }

  /// What one target hears of it.
  std::vector<Said> of(const std::vector<std::string>& channels) const {
    std::vector<Said> heard;
    std::copy_if(all_.begin(), all_.end(), std::back_inserter(heard), [&](const Said& one) {
      return std::find(channels.begin(), channels.end(), one.channel) != channels.end();
    });
    return heard;
  }

  /// As it was said, with all its samples.
  const Said& wholePlan() const { return whole_plan_; }

 private:
  template <class T>
  void keep(messaging::Endpoint& endpoint, const messaging::Channel<T>& channel) {
    endpoint.subscribe<T>(channel,
                          [this, channel](const T& m) { all_.push_back(said(channel.name, m)); });
  }

  /// Images and calibrations as they are, and small.
  void keepSmall(messaging::Endpoint& endpoint, const messaging::Channel<image_t>& channel) {
    endpoint.subscribe<image_t>(channel, [this, channel](image_t m) {
      const cv::Mat whole = cv::imdecode(m.data, cv::IMREAD_GRAYSCALE);
      cv::Mat small;
      cv::resize(whole, small, {}, kThumbnail, kThumbnail, cv::INTER_AREA);
      m.width = m.row_stride = small.cols;
      m.height = small.rows;
      cv::imencode(".jpg", small, m.data);
      m.size = static_cast<int32_t>(m.data.size());
      all_.push_back(said(channel.name, m));
    });
  }

  /// What depends on the wall clock, and on this machine, is left out: the seeds differ from run to run only in the order in
  /// which the messages of several processes come.
  void keepNews(heartbeat_t m) {
    m.utime = 0;
    m.host = "host";
    m.pid = 1;
    m.version = "0";
    m.received = m.lost = m.invalid = m.seq = 0;
    m.loop_mean_us = m.loop_max_us = 0;
    const Said news = said(messaging::kHeartbeat.name, m);
    if (newest_[m.name] == news.message)
      return;
    newest_[m.name] = news.message;
    all_.push_back(news);
  }

  void listen(messaging::Endpoint& e) {
    using namespace messaging;
    keep(e, kArmState);
    keep(e, kArmCommand);
    keep(e, kHandState);
    keep(e, kHandCommand);
    keep(e, kScene);
    keep(e, kThrowStart);
    keep(e, kPlanRequest);
    e.subscribe<swing_plan_t>(kSwingPlan, [this](swing_plan_t m) {
      m.plan_ms = 1;
      all_.push_back(said(kSwingPlan.name, thinned(m)));
      whole_plan_ = said(kSwingPlan.name, m);
    });
    keep(e, kControllerStatus);
    keep(e, kGrip);
    keep(e, kRelease);
    keep(e, kSimTruth);
    keep(e, kBallObservation);
    keep(e, kBallTrack);
    keep(e, kLanding);
    e.subscribe<heartbeat_t>(kHeartbeat, [this](const heartbeat_t& m) { keepNews(m); });
    keepSmall(e, kCameraLeft);
    keepSmall(e, kCameraRight);
    e.subscribe<camera_info_t>(kCameraInfo, [this](camera_info_t m) {
      m.width = static_cast<int32_t>(m.width * kThumbnail);
      m.height = static_cast<int32_t>(m.height * kThumbnail);
      for (const int i : {0, 2, 4, 5})
        m.K[i] *= kThumbnail;
      all_.push_back(said(kCameraInfo.name, m));
    });
  }

  std::vector<Said> all_;
  Said whole_plan_;
  std::map<std::string, Bytes> newest_;  // HEARTBEAT of each process
};

void write(const fs::path& path, const Bytes& bytes) {
  fs::create_directories(path.parent_path());
  std::ofstream file(path, std::ios::binary);
  file.write(reinterpret_cast<const char*>(bytes.data()),
             static_cast<std::streamsize>(bytes.size()));
  if (!file.flush())
    throw std::runtime_error(fmt::format("cannot write {}", path.string()));
}

/// What a message is one of: of some channels every sender counts by itself, told by the length of its name.
std::pair<std::string, std::size_t> kindOf(const Said& one) {
  const bool many_senders = one.channel == "CAMERA_INFO" || one.channel == "HEARTBEAT";
  return {one.channel, many_senders ? one.message.size() : 0};
}

/// The first message of each kind, in their order.
std::vector<Said> openingOf(const std::vector<Said>& heard) {
  std::set<std::pair<std::string, std::size_t>> kinds;
  std::vector<Said> opening;
  std::copy_if(heard.begin(), heard.end(), std::back_inserter(opening),
               [&](const Said& one) { return kinds.insert(kindOf(one)).second; });
  return opening;
}

/// The whole throw, with a few messages of each channel; what processes say of themselves stays.
std::vector<Said> inFew(const std::vector<Said>& heard) {
  constexpr std::size_t kMost = 6;  // of a channel
  std::map<std::string, std::size_t> all, count;
  for (const Said& one : heard)
    ++all[one.channel];
  std::vector<Said> few;
  std::copy_if(heard.begin(), heard.end(), std::back_inserter(few), [&](const Said& one) {
    return one.channel == "HEARTBEAT" || count[one.channel]++ % (all[one.channel] / kMost + 1) == 0;
  });
  return few;
}

/// Conversations for a target: single messages, windows on the throw with what came before them, and the whole in few.
std::vector<std::vector<Said>> conversations(const std::vector<Said>& heard) {
  std::vector<Said> opening = openingOf(heard);
  std::vector<std::vector<Said>> all;
  all.reserve(opening.size());
  for (const Said& one : opening)
    all.push_back({one});
  // An ESTOP would end what the others begin.
  opening.erase(std::remove_if(opening.begin(), opening.end(),
                               [](const Said& one) { return one.channel == "ESTOP"; }),
                opening.end());
  for (int i = 0; i < kWindows; ++i) {
    std::vector<Said> window = i == 0 ? std::vector<Said>() : opening;
    const std::size_t from = heard.size() * static_cast<std::size_t>(i) / kWindows;
    for (std::size_t k = from; k < std::min(from + kWindow, heard.size()); ++k)
      window.push_back(heard[k]);
    all.push_back(window);
  }
  all.push_back(inFew(heard));
  return all;
}

/// A log with a few messages of every channel.
void writeLog(const fs::path& path, const std::vector<Said>& all, std::size_t most) {
  fs::create_directories(path.parent_path());
  fs::remove(path);
  logger::LogWriter log(path.string());
  std::map<std::string, std::size_t> count;
  int64_t utime = 1'700'000'000'000'000;
  for (const Said& one : all) {
    if (one.message.size() < messaging::kControlBytes && ++count[one.channel] <= most)
      log.write(one.channel, one.message.data(), one.message.size(), ++utime);
  }
  log.flush();
}

void writeSeeds(const fs::path& folder) {
  const Recording recording;
  for (const char* target : {"planner", "controller", "hand_server", "sim_bullet", "vision_tracker",
                             "experiment", "logger", "spy"}) {
    int number = 0;
    const std::vector<std::string>& channels = channelsOf(target);
    for (const auto& conversation : conversations(recording.of(channels)))
      write(folder / target / fmt::format("{:03}", number++), serialise(conversation));
    if (std::find(channels.begin(), channels.end(), recording.wholePlan().channel) !=
        channels.end())
      write(folder / target / "whole_plan", serialise({recording.wholePlan()}));
  }
  writeLog(folder / "log" / "short", recording.of(allChannels()), 1);
  writeLog(folder / "log" / "longer", recording.of(allChannels()), 4);
}

}  // namespace
}  // namespace fastball::fuzz

int main(int argc, char** argv) {
  if (argc != 2) {
    fmt::print(stderr, "usage: {} FOLDER\n", argv[0]);
    return 2;
  }
  try {
    fastball::fuzz::writeSeeds(argv[1]);
    return 0;
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 1;
  }
}
