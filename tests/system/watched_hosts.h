// Three machines, and what is heard on each of them.
#pragma once

#include <gtest/gtest.h>
#include <poll.h>

#include <Eigen/Core>
#include <algorithm>
#include <atomic>
#include <cmath>
#include <map>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "messaging/lcm_endpoint.h"
#include "tests/system/three_hosts.h"

namespace fastball::system_test {

/// What is heard on one host, from a thread of its own: it hears its host's processes also while it is cut off.
class Ear {
 public:
  Ear(const test_kit::Hosts& hosts, const std::string& host) {
    hosts.on(host, [this] {
      endpoint_ = std::make_unique<messaging::LcmEndpoint>(test_kit::Hosts::lcmUrl());
      endpoint_->subscribe<heartbeat_t>(messaging::kHeartbeat, [this](const heartbeat_t& m) {
        beats_[m.host + "/" + m.name].push_back(m);
      });
      endpoint_->subscribe<scene_t>(messaging::kScene, [this](const scene_t& m) { scene_ = m; });
      endpoint_->subscribe<arm_state_t>(messaging::kArmState,
                                        [this](const arm_state_t& m) { state_ = m; });
      endpoint_->subscribe<controller_status_t>(
          messaging::kControllerStatus, [this](const controller_status_t& m) { status_ = m; });
    });
    thread_ = std::thread([this] {
      while (!end_) {
        pollfd wait{endpoint_->fileDescriptor(), POLLIN, 0};
        poll(&wait, 1, 10);
        const std::lock_guard lock(mutex_);
        endpoint_->drain();
      }
    });
  }
  ~Ear() {
    end_ = true;
    thread_.join();
  }
  std::vector<heartbeat_t> beats(const std::string& process) const {
    const std::lock_guard lock(mutex_);
    const auto found = beats_.find(process);
    return found == beats_.end() ? std::vector<heartbeat_t>{} : found->second;
  }
  scene_t scene() const {
    const std::lock_guard lock(mutex_);
    return scene_;
  }
  arm_state_t state() const {
    const std::lock_guard lock(mutex_);
    return state_;
  }
  controller_status_t status() const {
    const std::lock_guard lock(mutex_);
    return status_;
  }

 private:
  std::unique_ptr<messaging::LcmEndpoint> endpoint_;
  mutable std::mutex mutex_;
  std::map<std::string, std::vector<heartbeat_t>> beats_;  ///< by "host/process"
  scene_t scene_{};
  arm_state_t state_{};
  controller_status_t status_{};
  std::atomic<bool> end_ = false;
  std::thread thread_;
};

class WatchedHosts : public ThreeHosts {
 protected:
  void SetUp() override {
    ThreeHosts::SetUp();
    if (hosts_)
      for (const char* host : {"robot", "vision", "operator"})
        ears_[host] = std::make_unique<Ear>(*hosts_, host);
  }
  void upHere(const Places& places, const std::string& flags) {
    const Outcome outcome = up(places, flags, {hosts_->sshStandIn()});
    ASSERT_EQ(outcome.exit_status, 0) << outcome.output;
  }
  /// Starts a run of so many throws and waits until the arm swings.
  std::unique_ptr<FastballRun> swing(const std::string& throws) const;
  /// In a HEARTBEAT of that process since then [us since 1970].
  bool said(const std::string& host,
            const std::string& process,
            int64_t since_us,
            const std::string& words,
            const std::string& state = "") const;
  void expectArmAtRest() const;

  std::map<std::string, std::unique_ptr<Ear>> ears_;
};

inline std::unique_ptr<FastballRun> WatchedHosts::swing(const std::string& throws) const {
  while (true) {
    const int64_t before = ears_.at("robot")->status().scene_id;
    auto thrown = run(throws);
    while (thrown->running()) {
      const controller_status_t status = ears_.at("robot")->status();
      if (status.scene_id > before && status.phase == arm_command_t::SWING)
        return thrown;
      pause();
    }
    const Outcome outcome = thrown->wait();
    if (!wasTooBusy(outcome))
      throw std::runtime_error("ended before the arm swung: " + outcome.output);
  }
}

inline bool WatchedHosts::said(const std::string& host,
                               const std::string& process,
                               int64_t since_us,
                               const std::string& words,
                               const std::string& state) const {
  const auto beats = ears_.at(host)->beats(host + "/" + process);
  return std::any_of(beats.begin(), beats.end(), [&](const heartbeat_t& beat) {
    return beat.utime >= since_us && beat.detail.find(words) != std::string::npos &&
           (state.empty() || beat.state == state);
  });
}

inline void WatchedHosts::expectArmAtRest() const {
  const Ear& ear = *ears_.at("robot");
  const auto speed = [&ear] { return Eigen::Map<const Eigen::Vector4d>(ear.state().qd).norm(); };
  const auto finished = [&ear] {
    const heartbeat_t robot = ear.beats("robot/sim_bullet").back();
    return robot.state == "finished" && robot.plan_id == ear.state().scene_id;
  };
  while (speed() > 0.05 && !finished())
    pause();
  // On a busy machine the kernel drops what this test does not fetch in time, and then the scene's end was not heard.
  if (ear.scene().scene_id != ear.state().scene_id)
    return;
  if (ear.state().tick + 1 < std::llround(ear.scene().duration * 1e3) && speed() > 0.05)
    return;
  EXPECT_LT(speed(), 0.05) << "[rad/s]";
}

}  // namespace fastball::system_test
