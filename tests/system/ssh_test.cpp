// The system's own ssh, with a real sshd on each machine.
#include <gmock/gmock.h>

#include "tests/kit/ssh_servers.h"
#include "tests/system/three_hosts.h"

namespace fastball::system_test {
namespace {

using test_kit::SshServers;
using testing::HasSubstr;

class RealSsh : public ThreeHosts {
 protected:
  void SetUp() override {
    if (const std::string why = SshServers::whyNot(); !why.empty())
      GTEST_SKIP() << why;
    ThreeHosts::SetUp();
    servers_ = std::make_unique<SshServers>(*hosts_, std::vector<std::string>{"robot", "vision"});
  }
  nlohmann::json process(const std::string& name) const {
    const Outcome list = fastball({"ps", file_, "--json"}, hosts_->enter("operator"));
    const nlohmann::json state = nlohmann::json::parse(list.output);
    for (const nlohmann::json& process : state.at("processes"))
      if (process.at("name") == name)
        return process;
    ADD_FAILURE() << name << " is not among " << list.output;
    return {};
  }

  std::unique_ptr<SshServers> servers_;
};

TEST_F(RealSsh, StartsASystemOnThreeMachinesThatThrowsAndEndsWhatIsCutOff) {
  const Outcome started = up(kUsualPlaces, "", servers_->client());
  ASSERT_EQ(started.exit_status, 0) << started.output;
  for (const auto& [name, host] : places_)
    EXPECT_EQ(process(name).at("state"), "ready") << name << " on " << host;
  const Outcome thrown = throwOnce();
  ASSERT_EQ(thrown.exit_status, 0) << thrown.output;
  EXPECT_THAT(thrown.output, HasSubstr("clocks: robot "));
  EXPECT_TRUE(thrown.json.at("throws").at(0).at("hit").get<bool>());

  const int tracker = process("vision_tracker").at("pid");
  const int controller = process("controller").at("pid");
  ASSERT_TRUE(isRunning(tracker));
  hosts_->cutLink("vision");
  while (isRunning(tracker))
    pause();
  EXPECT_TRUE(isRunning(controller));
  while (process("vision_tracker").at("state") != "ended")
    pause();
  EXPECT_THAT(process("vision_tracker").at("note").get<std::string>(),
              HasSubstr("the connection ended"));
  down();
  EXPECT_FALSE(isRunning(controller));
}

}  // namespace
}  // namespace fastball::system_test
