#pragma once

#include <atomic>
#include <string>
#include <thread>

namespace fastball::bench {

/// What a browser asks of `fastball view`, without drawing anything: it takes every frame and, with each, the newest image of
/// every camera.
class ViewingPage {
 public:
  /// @param port of a server on this machine.
  explicit ViewingPage(const std::string& port);
  /// Closes the connection.
  ~ViewingPage();
  ViewingPage(const ViewingPage&) = delete;
  ViewingPage& operator=(const ViewingPage&) = delete;

  int frames() const { return frames_; }
  int pictures() const { return pictures_; }

 private:
  void look(const std::string& port);
  std::atomic<bool> ended_{false};
  std::atomic<int> frames_{0}, pictures_{0};
  std::thread thread_;
};

}  // namespace fastball::bench
