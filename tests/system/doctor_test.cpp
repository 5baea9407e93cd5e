#include <gmock/gmock.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>

#include "tests/config/temporary_folder.h"
#include "tests/system/fastball_run.h"

namespace fastball::system_test {
namespace {

using testing::HasSubstr;

TEST(Doctor, LooksAtEverythingAndItsStatusSaysWhetherSomethingIsBad) {
  const config::TemporaryFolder folder;
  const std::string path = (folder.path() / "findings.json").string();
  const Outcome outcome = fastball({"doctor", "--json", path});
  std::ifstream file(path);
  const nlohmann::json findings = nlohmann::json::parse(file).at("findings");
  int bad = 0;
  for (const nlohmann::json& finding : findings) {
    bad += finding.at("verdict") == "bad";
    EXPECT_THAT(outcome.output, HasSubstr(finding.at("value").get<std::string>()));
  }
  EXPECT_EQ(outcome.exit_status, bad > 0 ? 1 : 0) << outcome.output;
  for (const char* what : {"LCM", "route", "reach", "round trip of 60000 bytes", "receive buffer",
                           "burst", "heard", "real-time priority", "room for logs"}) {
    EXPECT_TRUE(std::any_of(findings.begin(), findings.end(), [&](const auto& finding) {
      return finding.at("what") == what;
    })) << what;
  }
}

TEST(Version, NamesEveryLibraryWithItsNumber) {
  const Outcome outcome = fastball({"--version"});
  EXPECT_EQ(outcome.exit_status, 0);
  EXPECT_THAT(outcome.output, testing::ContainsRegex("LCM [0-9]+\\.[0-9]+"));
  EXPECT_THAT(outcome.output, testing::Not(HasSubstr(" ,")));
}

TEST(Doctor, SaysHowToMakeARouteWhereThereIsNone) {
  if (std::system("unshare -n true 2>/dev/null") != 0)
    GTEST_SKIP() << "no private network namespace to be had here";
  const Outcome outcome = fastball({"doctor"}, {"unshare", "-n"});
  EXPECT_EQ(outcome.exit_status, 1);
  EXPECT_THAT(outcome.output, HasSubstr("mend: sudo ip route add 239.255.76.67/32 dev lo"));
}

}  // namespace
}  // namespace fastball::system_test
