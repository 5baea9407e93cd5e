#include <gmock/gmock.h>

#include <cstdio>

#include "launch/systems/held_process.h"
#include "launch/systems/system_file.h"
#include "tests/config/temporary_folder.h"

namespace fastball::launch {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class SystemFile : public testing::Test {
 protected:
  System load(const std::string& text) const {
    return loadSystem(folder_.write("system.yaml", text));
  }
  std::string errorOf(const std::string& text) const {
    try {
      load(text);
    } catch (const std::invalid_argument& e) {
      return e.what();
    }
    return "none";
  }
  config::TemporaryFolder folder_;
};

TEST_F(SystemFile, GivesWhatIsLeftOutItsDefault) {
  const System system = load("processes:\n  - {name: planner, command: [fastball-planner]}\n");
  ASSERT_EQ(system.processes.size(), 1u);
  const SystemProcess& planner = system.processes[0];
  EXPECT_TRUE(planner.host.isHere());
  EXPECT_EQ(planner.restart, Restart::kNever);
  EXPECT_EQ(planner.ready_when, ReadyWhen::kHeartbeat);
  EXPECT_EQ(planner.stop_signal, "INT");
  EXPECT_TRUE(system.isOnOneMachine());
}

TEST_F(SystemFile, NamesWhatIsWrongWithLineAndKey) {
  EXPECT_THAT(errorOf("processes: []\n"), HasSubstr("must name a process"));
  EXPECT_THAT(errorOf("processes:\n  - {name: a, command: []}\n"),
              HasSubstr("system.yaml:2: key 'command': must name a program"));
  EXPECT_THAT(errorOf("processes:\n  - {name: a, host: mars, command: [x]}\n"),
              HasSubstr("key 'host': is 'mars', which is not among the hosts"));
  EXPECT_THAT(errorOf("processes:\n  - {name: a, command: [x]}\n  - {name: a, command: [x]}\n"),
              HasSubstr(":3: key 'name': is 'a', as that of another process"));
  EXPECT_THAT(errorOf("processes:\n  - {name: a, command: [x], environment: [HOME]}\n"),
              HasSubstr("has 'HOME', must be KEY=VALUE"));
  EXPECT_THAT(errorOf("processes:\n  - {name: a, command: [x], realtime_priority: 100}\n"),
              HasSubstr("must be in [1, 99]"));
  EXPECT_THAT(errorOf("processes:\n  - {name: a, command: [x], sort: of}\n"),
              HasSubstr("key 'sort': is not known here"));
}

TEST_F(SystemFile, SeveralMachinesNeedAUrlThatLeavesThem) {
  const std::string rest =
      "hosts: [{name: robot}]\nprocesses: [{name: a, host: robot, command: [x]}]\n";
  EXPECT_THAT(errorOf("lcm_url: udpm://239.255.76.67:7667?ttl=0\n" + rest),
              HasSubstr("with ttl=0 no message leaves a machine"));
  EXPECT_EQ(load("lcm_url: udpm://239.255.76.67:7667?ttl=1\n" + rest).processes[0].host.address,
            "robot");
}

TEST_F(SystemFile, SeveralMachinesHaveASilenceLimitThatEveryProcessIsTold) {
  const std::string here = "processes: [{name: a, command: [x], environment: [A=1]}]\n";
  const std::string there =
      "hosts: [{name: robot}]\nlcm_url: udpm://239.255.76.67:7667?ttl=1\n"
      "processes: [{name: a, host: robot, command: [x]}]\n";
  EXPECT_EQ(load(here).silence_limit, 0);
  EXPECT_THAT(load(here).processes[0].environment, ElementsAre("A=1"));
  EXPECT_EQ(load(there).silence_limit, 0.5);
  EXPECT_THAT(load(there).processes[0].environment, ElementsAre("FASTBALL_SILENCE_LIMIT=0.5"));
  EXPECT_EQ(load("silence_limit: 0\n" + there).silence_limit, 0);
  EXPECT_THAT(load("silence_limit: 2\n" + here).processes[0].environment,
              ElementsAre("FASTBALL_SILENCE_LIMIT=2", "A=1"));
  EXPECT_THAT(errorOf("silence_limit: 0.05\n" + here),
              HasSubstr("key 'silence_limit': is 0.05 s, must be 0 (none) or at least 0.1 s"));
}

TEST_F(SystemFile, ClocksOfSeveralMachinesHaveALimit) {
  const std::string process = "processes: [{name: a, command: [x]}]\n";
  EXPECT_EQ(load(process).clock_limit, 0);
  EXPECT_EQ(load("clock_limit: 0.001\n" + process).clock_limit, 0.001);
  EXPECT_EQ(load("hosts: [{name: robot}]\nlcm_url: udpm://239.255.76.67:7667?ttl=1\n"
                 "processes: [{name: a, host: robot, command: [x]}]\n")
                .clock_limit,
            0.05);
}

TEST(ShippedSystems, CanBeRead) {
  const std::string folder = FASTBALL_SOURCE_DIR "/config/systems/";
  EXPECT_EQ(loadSystem(folder + "one-machine.yaml").processes.size(), 6u);
  EXPECT_FALSE(loadSystem(folder + "three-machines.yaml").isOnOneMachine());
}

TEST(HoldCommand, OnAnotherMachineIsOneQuotedLineForItsShell) {
  SystemProcess process;
  process.name = "planner";
  process.host = {"robot", "robot.lab", "/opt/fast ball", "", {"ssh", "-T"}};
  process.command = {"fastball-planner", "--config", "it's.yaml"};
  process.environment = {"A=b c"};
  EXPECT_THAT(
      holdCommand(process, "udpm://x"),
      ElementsAre("ssh", "-T", "robot.lab",
                  "exec '/opt/fast ball/fastball' 'hold' '--stop-signal' 'INT' '--grace' '2' "
                  "'--environment' 'FASTBALL_LCM_URL=udpm://x' '--environment' 'A=b c' "
                  "'--silence' '3' 'fastball-planner' '--config' 'it'\\''s.yaml'"));
}

TEST(ShellQuoted, IsReadBackByAShell) {
  for (const std::string word : {"", "plain", "two words", "it's", "$HOME `x` \"y\" \\ ;&|"}) {
    std::FILE* shell = popen(("printf %s " + shellQuoted(word)).c_str(), "r");
    ASSERT_NE(shell, nullptr);
    char text[100]{};
    const std::size_t size = std::fread(text, 1, sizeof text, shell);
    pclose(shell);
    EXPECT_EQ(std::string(text, size), word);
  }
}

}  // namespace
}  // namespace fastball::launch
