#pragma once

#include <boost/asio/io_context.hpp>
#include <boost/asio/steady_timer.hpp>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "launch/view/throw_run.h"
#include "launch/view/viewed_log.h"
#include "launch/view/web_server.h"
#include "messaging/clock.h"
#include "messaging/lcm_endpoint.h"

namespace fastball::view {

struct ViewOptions {
  std::string log;     ///< empty: what is said on the network
  std::string config;  ///< experiment file
  std::string remark;  ///< a sentence that every page shows, or empty
  std::string lcm_url;
  std::string host = "127.0.0.1";
  unsigned short port = 8080;  ///< 0: any that is free
  std::string page_folder;
  RunPlace run;           ///< where runs started from the page meet
  bool may_throw = true;  ///< runs can be started from the page, if only this machine can reach it
};

/// Listens, serves the page, and tells every viewer sixty times a second what is new. It says nothing on the network and no one
/// waits for it: messages wait in LCM's queue for the next of the sixty times, and a viewer that has not taken its last frame is
/// passed over. Everything happens on the thread that calls run().
class ViewServer {
 public:
  static constexpr int kFramesPerSecond = 60;

  /// @throw what Timeline, ViewedLog, LcmEndpoint, PageFiles and WebServer throw.
  explicit ViewServer(const ViewOptions& options);
  ~ViewServer();
  ViewServer(const ViewServer&) = delete;
  ViewServer& operator=(const ViewServer&) = delete;

  /// Where a browser finds the page.
  std::string url() const;
  /// Serves until `stopped` says so; asks sixty times a second.
  void run(const std::function<bool()>& stopped);
  const Timeline& timeline() const { return log_ ? log_->timeline() : *live_; }

 private:
  void tick(const std::function<bool()>& stopped);
  void tell(Viewer& viewer);
  void renewNews();
  std::string advice() const;
  void obey(const nlohmann::json& order);
  void join(boost::beast::tcp_stream stream, const Viewer::Request& request);
  std::optional<PageFiles::File> picture(const std::string& channel, int64_t index);

  const ViewOptions options_;
  const messaging::SystemClock clock_;
  boost::asio::io_context io_;
  boost::asio::steady_timer timer_;
  std::unique_ptr<ViewedLog> log_;
  std::unique_ptr<Timeline> live_;
  std::unique_ptr<messaging::LcmEndpoint> endpoint_;
  std::unique_ptr<ThrowRun> throw_run_;
  std::string order_fault_;  // why the last order could not be obeyed
  std::string hello_;
  nlohmann::json news_;  // what is missing, and the run
  std::string news_text_;
  int64_t next_news_us_ = 0;
  std::vector<std::shared_ptr<Viewer>> viewers_;
  std::unique_ptr<WebServer> web_;
};

}  // namespace fastball::view
