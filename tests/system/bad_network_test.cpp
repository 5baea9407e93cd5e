#include <fmt/format.h>
#include <gmock/gmock.h>
#include <unistd.h>

#include <algorithm>

#include <chrono>
#include <cstdlib>
#include <string>
#include <thread>
#include <vector>

#include "messaging/lcm_endpoint.h"
#include "tests/config/temporary_folder.h"
#include "tests/kit/unreliable_relay.h"
#include "tests/system/fastball_run.h"

namespace fastball::system_test {
namespace {

using test_kit::Mischief;
using test_kit::UnreliableRelay;

/// The experiment on two networks, some of it on the second, with a bad cable between them.
class BadNetwork : public testing::Test {
 protected:
  BadNetwork() { setenv("XDG_RUNTIME_DIR", folder_.path().c_str(), 1); }
  ~BadNetwork() override { fastball({"down", file_}); }

  void upWithFar(const std::vector<std::string>& far) {
    std::string file = fmt::format("lcm_url: '{}'\nprocesses:\n", near_);
    for (const char* name :
         {"logger", "planner", "sim-bullet", "vision-tracker", "controller", "hand-server"})
      file += process(name, std::count(far.begin(), far.end(), name) == 0 ? near_ : far_);
    file_ = folder_.write("system.yaml", file);
    ASSERT_EQ(fastball({"up", file_}).exit_status, 0);
  }
  std::string process(const std::string& program, const std::string& url) const {
    std::string name = program;
    std::replace(name.begin(), name.end(), '-', '_');
    const std::string more =
        name == "logger" ? fmt::format(", --log, {}/log", folder_.path().string()) : "";
    return fmt::format(
        "  - {{name: {}, command: [fastball-{}{}], environment: ['FASTBALL_LCM_URL={}']}}\n", name,
        program, more, url);
  }
  /// What two throws came to, the second aimed by what was seen of the first.
  nlohmann::json run(const std::vector<std::string>& how) const {
    std::vector<std::string> command = {"run", "--throws", "2"};
    command.insert(command.end(), how.begin(), how.end());
    const Outcome outcome = fastball(command);
    EXPECT_EQ(outcome.exit_status, 0) << outcome.output;
    nlohmann::json results;
    for (const auto& one : outcome.json.at("throws"))
      results.push_back(
          {one["landing_true_mm"], one["landing_measured_mm"], one["release_speed_mps"]});
    return results;
  }
  static Mischief mischief() {
    Mischief mischief;
    mischief.lost = 0.01;
    mischief.duplicated = 0.02;
    mischief.reordered = 0.05;
    return mischief;
  }

  config::TemporaryFolder folder_;
  std::string near_ = fmt::format("udpm://239.255.76.67:{}?ttl=0", 20000 + getpid() % 20000);
  std::string far_ = fmt::format("udpm://239.255.76.67:{}?ttl=0", 40000 + getpid() % 20000);
  std::string file_ = folder_.path() / "system.yaml";
};

TEST_F(BadNetwork, LosesDoublesAndMixesMessagesAndTheThrowsStayTheSame) {
  const UnreliableRelay relay(near_, far_, mischief());
  upWithFar({"controller", "hand-server"});
  EXPECT_EQ(run({"--system", file_}), run({"--no-network"}));
  EXPECT_GT(relay.lost(), 50);
  EXPECT_GT(relay.passed(), 5000);
}

TEST_F(BadNetwork, LosesDoublesAndMixesImagesAndTheTrackerStillMeasures) {
  const UnreliableRelay relay(near_, far_, mischief());
  upWithFar({"vision-tracker"});
  const nlohmann::json thrown = run({"--system", file_}), clean = run({"--no-network"});
  EXPECT_EQ(thrown[0][0], clean[0][0]);
  for (const auto& one : thrown)
    EXPECT_TRUE(one[1].is_array());  // measured
  EXPECT_GT(relay.lost(), 50);
}

TEST_F(BadNetwork, ACutCableStopsTheLockstepAndThrowsGoOnWhenItIsMended) {
  UnreliableRelay relay(near_, far_, {});
  upWithFar({"controller", "hand-server"});
  FastballRun run({"run", "--system", file_, "--throws", "1"});
  messaging::LcmEndpoint endpoint(near_);
  int64_t tick = -1;
  endpoint.subscribe<arm_state_t>(messaging::kArmState,
                                  [&tick](const arm_state_t& m) { tick = m.tick; });
  const auto listen = [&](double seconds) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
    while (std::chrono::steady_clock::now() < end) {
      endpoint.drain();
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  };
  while (tick < 200 && run.running())
    listen(0.01);
  relay.cut(true);
  listen(0.5);
  const int64_t stopped = tick;
  listen(0.5);
  EXPECT_EQ(tick, stopped);
  relay.cut(false);
  const Outcome outcome = run.wait();
  EXPECT_EQ(outcome.exit_status, 0) << outcome.output;
  EXPECT_TRUE(outcome.json.at("throws").at(0).at("hit").get<bool>());
}

}  // namespace
}  // namespace fastball::system_test
