#include "launch/view/view_server.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "launch/view/missing.h"
#include "launch/view/picture_file.h"

namespace fastball::view {
namespace {

using nlohmann::json;

constexpr auto kFrame = std::chrono::microseconds(1'000'000 / ViewServer::kFramesPerSecond);
/// [us] between two looks at what is missing.
constexpr int64_t kNewsPeriod = 200'000;

/// [m] Where the simulator's floor is; the arm's column stands there.
double floorOf(const std::string& experiment_path) {
  constexpr double kDefault = -1.2;
  config::Section file = config::Section::fromFile(experiment_path);
  if (!file.has("simulation"))
    return kDefault;
  config::Section simulation = file.section("simulation");
  return simulation.has("floor") ? simulation.section("floor").number("height") : kDefault;
}

template <class T>
T valueOf(const json& order, const char* key, T otherwise) {
  const auto value = order.find(key);
  return value != order.end() && value->is_number_integer() ? value->template get<T>() : otherwise;
}

}  // namespace

ViewServer::ViewServer(const ViewOptions& options) : options_(options), timer_(io_) {
  const auto experiment = config::loadExperiment(options.config);
  const double floor = floorOf(options.config);
  if (!options.log.empty()) {
    log_ = std::make_unique<ViewedLog>(options.log, experiment, floor);
  } else {
    live_ = std::make_unique<Timeline>(experiment, floor);
    endpoint_ = std::make_unique<messaging::LcmEndpoint>(options.lcm_url);
    endpoint_->subscribeRaw(live_->channels(),
                            [this](const std::string& channel, const void* data, std::size_t size,
                                   int64_t utime) { live_->take(channel, data, size, utime); });
  }
  web_ = std::make_unique<WebServer>(
      io_, options.host, options.port, PageFiles(options.page_folder),
      Served{[this](const std::string& channel, int64_t index) { return picture(channel, index); },
             [this](boost::beast::tcp_stream stream, const Viewer::Request& request) {
               join(std::move(stream), request);
             }});
  if (live_ && options.may_throw && web_->door().local())
    throw_run_ = std::make_unique<ThrowRun>(options.run);
  json greeting = hello(timeline(), experiment, floor);
  greeting["live"] = live_ != nullptr;
  greeting["source"] = live_ ? options.lcm_url : options.log;
  greeting["mayThrow"] = throw_run_ != nullptr;
  hello_ = text(greeting);
}

ViewServer::~ViewServer() = default;

std::string ViewServer::url() const {
  const Door& door = web_->door();
  const bool v6 = door.host.find(':') != std::string::npos;
  return fmt::format(v6 ? "http://[{}]:{}/" : "http://{}:{}/", door.host, door.port);
}

void ViewServer::run(const std::function<bool()>& stopped) {
  timer_.expires_after(std::chrono::seconds(0));
  tick(stopped);
  io_.run();
  io_.restart();
}

void ViewServer::tick(const std::function<bool()>& stopped) {
  if (stopped()) {
    io_.stop();
    return;
  }
  if (endpoint_)
    endpoint_->drain();
  renewNews();
  for (const auto& viewer : viewers_)
    tell(*viewer);
  viewers_.erase(std::remove_if(viewers_.begin(), viewers_.end(),
                                [](const auto& viewer) { return !viewer->open(); }),
                 viewers_.end());
  // On time again after a pause of the process, without making up for what it missed.
  timer_.expires_at(std::max(timer_.expiry() + kFrame, std::chrono::steady_clock::now()));
  timer_.async_wait([this, stopped](const boost::system::error_code& error) {
    if (!error)
      tick(stopped);
  });
}

void ViewServer::tell(Viewer& viewer) {
  if (!viewer.ready())
    return;
  const bool news = viewer.told != news_text_;
  std::string frame = nextFrame(timeline(), viewer.cursor, news ? news_ : json(), clock_.wallUs());
  if (news)
    viewer.told = news_text_;
  if (!frame.empty())
    viewer.send(std::move(frame), true);
}

void ViewServer::renewNews() {
  const int64_t now_us = clock_.monotonicUs();
  if (now_us < next_news_us_)
    return;
  next_news_us_ = now_us + kNewsPeriod;
  const int64_t wall_us = clock_.wallUs();
  std::vector<std::string> notices;
  if (log_) {
    notices = log_->faults();
    for (const std::string& sentence : missingFromLog(timeline()))
      notices.push_back(sentence);
  } else {
    notices = missingFromNetwork(*live_);
  }
  if (!options_.remark.empty())
    notices.insert(notices.begin(), options_.remark);
  news_ = {{"notices", notices}};
  if (live_) {
    const bool heard = experimentHeard(*live_, wall_us);
    news_["heard"] = heard;
    news_["advice"] = heard ? "" : advice();
    news_["recorded"] = live_->recordedIn();
  }
  if (throw_run_) {
    const bool goes_on = throw_run_->goesOn();
    news_["run"] = {{"goesOn", goes_on},
                    {"failed", throw_run_->failed() || !order_fault_.empty()},
                    {"words", order_fault_.empty() ? throw_run_->words() : order_fault_}};
  }
  news_text_ = text(news_);
}

/// What to do where nothing is heard.
std::string ViewServer::advice() const {
  const std::string url = options_.lcm_url == messaging::defaultLcmUrl()
                              ? ""
                              : fmt::format(" --lcm-url '{}'", options_.lcm_url);
  return fmt::format("No experiment is heard. Start one{}: fastball run{}",
                     throw_run_ ? " with Throw, above, or in a terminal" : "", url);
}

void ViewServer::obey(const json& order) {
  if (!throw_run_)
    return;
  try {
    order_fault_.clear();
    if (order.value("order", "") == "throw") {
      const auto realtime = order.find("realtime");
      throw_run_->start({valueOf(order, "throws", 1), valueOf<int64_t>(order, "seed", 1),
                         realtime != order.end() && *realtime == true});
    } else if (order.value("order", "") == "stop") {
      throw_run_->stop();
    }
  } catch (const std::exception& e) {
    order_fault_ = e.what();
  }
  next_news_us_ = 0;
}

void ViewServer::join(boost::beast::tcp_stream stream, const Viewer::Request& request) {
  viewers_.push_back(
      std::make_shared<Viewer>(std::move(stream), [this](const json& order) { obey(order); }));
  viewers_.back()->accept(request, hello_);
}

std::optional<PageFiles::File> ViewServer::picture(const std::string& channel, int64_t index) {
  const auto kept = timeline().pictures().find(channel);
  const Picture* picture = kept == timeline().pictures().end() ? nullptr : kept->second.at(index);
  if (picture == nullptr)
    return std::nullopt;
  const auto image = picture->image ? picture->image : log_->image(*picture);
  return image ? pictureFile(*image) : std::nullopt;
}

}  // namespace fastball::view
