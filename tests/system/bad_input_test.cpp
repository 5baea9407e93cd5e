// Bad input is refused before anything is started, with a sentence that names the cause.
#include <gmock/gmock.h>

#include <csignal>
#include <cstdlib>
#include <ostream>

#include "tests/system/fastball_run.h"

namespace fastball::system_test {
namespace {

using testing::HasSubstr;

struct WrongFlag {
  const char* name;
  std::vector<std::string> arguments;
  const char* sentence;
};
std::ostream& operator<<(std::ostream& out, const WrongFlag& wrong) {
  return out << wrong.name;
}

class WrongUsage : public testing::TestWithParam<WrongFlag> {};

TEST_P(WrongUsage, HasExitStatus2) {
  const Outcome outcome = fastball(GetParam().arguments);
  EXPECT_EQ(outcome.exit_status, 2);
  EXPECT_THAT(outcome.output, HasSubstr(GetParam().sentence));
}

INSTANTIATE_TEST_SUITE_P(
    Of,
    WrongUsage,
    testing::Values(
        WrongFlag{"no_command", {}, "Usage"},
        WrongFlag{"unknown_command", {"fly"}, "fly"},
        WrongFlag{"unknown_flag", {"run", "--thrws", "3"}, "--thrws"},
        WrongFlag{"no_throws", {"run", "--throws", "0"}, "--throws"},
        WrongFlag{"negative_seed", {"run", "--seed", "-1"}, "--seed"},
        WrongFlag{"unknown_strategy", {"run", "--strategy", "luck"}, "luck"},
        WrongFlag{"no_config", {"run", "--config", "/nonexistent.yaml"}, "/nonexistent.yaml"},
        WrongFlag{"no_uncertainty",
                  {"run", "--uncertainty", "/nonexistent.yaml"},
                  "/nonexistent.yaml"},
        WrongFlag{"unwritable_log",
                  {"run", "--log", "/nonexistent/a.lcmlog"},
                  "/nonexistent/a.lcmlog"},
        WrongFlag{"unwritable_json",
                  {"run", "--json", "/nonexistent/a.json"},
                  "/nonexistent/a.json"},
        WrongFlag{"bad_url", {"run", "--lcm-url", "carrier-pigeon://"}, "carrier-pigeon"},
        WrongFlag{"log_without_network", {"run", "--no-network", "--log", "a"}, "--log"},
        WrongFlag{"unwritable_figures", {"figures", "-o", "/dev/null/a"}, "-o /dev/null/a"},
        WrongFlag{"bad_filter", {"bench", "--filter", "("}, "regular expression"}),
    [](const auto& test) { return test.param.name; });

struct WrongConfig {
  const char* name;
  const char* file;
  const char* from;
  const char* to;
  const char* key;
};
std::ostream& operator<<(std::ostream& out, const WrongConfig& wrong) {
  return out << wrong.name;
}

class WrongConfiguration : public testing::TestWithParam<WrongConfig> {};

TEST_P(WrongConfiguration, HasExitStatus2AndNamesFileLineAndKey) {
  const WrongConfig& wrong = GetParam();
  const EditedConfig config(wrong.file, wrong.from, wrong.to);
  const Outcome outcome = fastball({"run", "--config", config.experiment()});
  EXPECT_EQ(outcome.exit_status, 2);
  EXPECT_THAT(outcome.output, testing::ContainsRegex(std::string(wrong.file) + ":[0-9]+"));
  EXPECT_THAT(outcome.output, HasSubstr(wrong.key));
  EXPECT_THAT(outcome.json["error"].dump(), HasSubstr(wrong.key));
}

INSTANTIATE_TEST_SUITE_P(Of,
                         WrongConfiguration,
                         testing::Values(WrongConfig{"unknown_key", "experiment.yaml",
                                                     "\ntarget:", "\ntraget: 1\ntarget:", "traget"},
                                         WrongConfig{"unknown_key_of_a_process", "experiment.yaml",
                                                     "\nrun:", "\nrun:\n  setle: 1", "setle"},
                                         WrongConfig{"negative_radius", "experiment.yaml",
                                                     "radius: 0.10", "radius: -0.10", "radius"},
                                         WrongConfig{"negative_ball", "ball.yaml", "0.05", "-0.05",
                                                     "radius"}),
                         [](const auto& test) { return test.param.name; });

TEST(BadInput, ATargetOutOfReachFailsWithTheSentenceOfThePlanner) {
  const EditedConfig config("experiment.yaml", "position: [3.0, 0.0, -0.5]",
                            "position: [30.0, 0.0, -0.5]");
  const Outcome outcome = fastball({"run", "--config", config.experiment()});
  EXPECT_EQ(outcome.exit_status, 1);
  EXPECT_THAT(outcome.output, HasSubstr("the planner refused"));
}

TEST(BadInput, WithoutARouteTheMendIsNamed) {
  if (std::system("unshare -n true 2>/dev/null") != 0) {
    GTEST_SKIP() << "no private network namespace to be had here";
  }
  const Outcome outcome = fastball({"run"}, {"unshare", "-n"});
  EXPECT_EQ(outcome.exit_status, 1);
  EXPECT_THAT(outcome.output, HasSubstr("ip route add"));
}

TEST(BadInput, ASecondRunOnThePortIsRefusedAndTheFirstGoesOn) {
  FastballRun first({"run", "--throws", "100"});
  ASSERT_NO_FATAL_FAILURE(first.awaitHeartbeat("planner"));
  const Outcome second = fastball({"run"});
  EXPECT_EQ(second.exit_status, 1);
  EXPECT_THAT(second.output, HasSubstr("another run is on"));
  EXPECT_NO_FATAL_FAILURE(first.awaitSwing());
  first.signal(SIGINT);
  EXPECT_EQ(first.wait().exit_status, 1);
}

}  // namespace
}  // namespace fastball::system_test
