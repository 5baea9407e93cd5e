// The manual page and the completion say what --help says.
#include "launch/docs/manual.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <fstream>

#include "tests/config/temporary_folder.h"

namespace fastball::launch {
namespace {

using testing::HasSubstr;
using testing::Not;

class Manual : public testing::Test {
 protected:
  Manual() {
    CLI::App* run = app_.add_subcommand("run", ".throws \\ a ball");
    run->add_option("--throws", throws_, "How many")->capture_default_str();
    run->add_option("--strategy", strategy_, "Which")->check(CLI::IsMember({"paper", "robust"}));
    app_.add_subcommand("log", "Logs")->add_subcommand("check", "Looks for damage");
    app_.add_subcommand("part", "Of a campaign")->group("");
  }
  /// What bash offers after these words.
  std::string completed(const std::string& words, int count) const {
    const std::string path = (folder_.path() / "completion.bash").string();
    std::ofstream(path) << bashCompletion(app_);
    const std::string script = "source " + path + "; COMP_WORDS=(" + words +
                               "); COMP_CWORD=" + std::to_string(count) +
                               "; _fastball; echo ${COMPREPLY[*]}";
    FILE* pipe =
        popen(("cd " + folder_.path().string() + " && bash -c '" + script + "'").c_str(), "r");
    char line[1000] = "";
    const char* got = fgets(line, sizeof line, pipe);
    pclose(pipe);
    return got == nullptr ? "" : line;
  }

  config::TemporaryFolder folder_;
  CLI::App app_{"Throws", "fastball"};
  int throws_ = 3;
  std::string strategy_;
};

TEST_F(Manual, PageHasEveryCommandAndFlagAndEscapesTroff) {
  const std::string page = manualPage(app_, "1.2");
  for (const char* text : {".SS fastball run\n\\&.throws \\e a ball\n", "\\-\\-throws",
                           "(default: 3)", "{paper,robust}", ".SS fastball log check"})
    EXPECT_THAT(page, HasSubstr(text));
  EXPECT_THAT(page, Not(HasSubstr("Of a campaign")));
}

TEST_F(Manual, BashCompletesCommandsFlagsAndChoices) {
  EXPECT_EQ(completed("fastball r", 1), "run\n");
  EXPECT_EQ(completed("fastball p", 1), "\n");
  EXPECT_EQ(completed("fastball run --th", 2), "--throws\n");
  EXPECT_EQ(completed("fastball run --strategy \"\"", 3), "paper robust\n");
  EXPECT_EQ(completed("fastball log c", 2), "check\n");
}

}  // namespace
}  // namespace fastball::launch
