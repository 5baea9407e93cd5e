#pragma once

#include <unistd.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "config/experiment.h"
#include "launch/view/timeline.h"
#include "logger/log_writer.h"
#include "messaging/channels.h"

namespace fastball::view {

constexpr int64_t kWallUs = 1'700'000'000'000'000;  // when the messages of these tests are received
constexpr double kFloor = -1.2;

template <class T>
std::vector<char> encoded(const T& message) {
  std::vector<char> bytes(static_cast<std::size_t>(message.getEncodedSize()));
  message.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
  return bytes;
}

template <class T>
void take(Timeline& timeline,
          const messaging::Channel<T>& channel,
          const T& message,
          int64_t utime = kWallUs) {
  const auto bytes = encoded(message);
  timeline.take(channel.name, bytes.data(), bytes.size(), utime);
}

inline arm_state_t armState(int64_t scene_id, int64_t tick, double q = 0.1) {
  arm_state_t state{};
  state.scene_id = scene_id;
  state.tick = tick;
  state.utime = scene_id * 10'000'000 + 1000 * tick;
  for (int i = 0; i < model::kArmJoints; ++i) {
    state.q[i] = q;
    state.qd[i] = q + i;
    state.tau[i] = -q;
  }
  return state;
}

inline hand_state_t handState(int64_t scene_id, int64_t tick) {
  hand_state_t state{};
  state.scene_id = scene_id;
  state.tick = tick;
  state.utime = scene_id * 10'000'000 + 1000 * tick;
  state.f_normal[1] = 6;
  state.f_tangential[1][0] = 3;
  state.f_tangential[1][1] = 4;
  return state;
}

inline const config::Experiment& defaultExperiment() {
  static const auto experiment = config::loadExperiment(config::experimentPath(""));
  return experiment;
}

/// A log that is written message by message and removed at the end.
class WrittenLog {
 public:
  WrittenLog() : writer_(std::make_unique<logger::LogWriter>(path)) {}
  ~WrittenLog() { std::filesystem::remove(path); }
  WrittenLog(const WrittenLog&) = delete;
  WrittenLog& operator=(const WrittenLog&) = delete;

  template <class T>
  void add(const messaging::Channel<T>& channel, const T& message) {
    const auto bytes = encoded(message);
    writer_->write(channel.name, bytes.data(), bytes.size(), kWallUs + 1000 * count_++);
  }
  void close() { writer_.reset(); }

  const std::string path = std::filesystem::temp_directory_path() /
                           ("view_test_" + std::to_string(getpid()) + ".lcmlog");

 private:
  std::unique_ptr<logger::LogWriter> writer_;
  int64_t count_ = 0;
};

}  // namespace fastball::view
