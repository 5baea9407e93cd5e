// fastball-ceiling: what it prints, and its exit status.

#include <gtest/gtest.h>

#include <sys/wait.h>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

namespace fastball::bench {
namespace {

const std::string kProgram =
    FASTBALL_BIN_DIR "/fastball-ceiling --config " FASTBALL_SOURCE_DIR "/config/experiment.yaml ";

/// Exit status and standard output of the program with those arguments.
std::pair<int, std::string> outcomeOf(const std::string& arguments) {
  FILE* pipe = popen((kProgram + arguments + " 2>/dev/null").c_str(), "r");
  std::string text;
  for (int c = std::fgetc(pipe); c != EOF; c = std::fgetc(pipe))
    text += static_cast<char>(c);
  const int status = pclose(pipe);
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, text};
}

TEST(CeilingProgram, PrintsALinePerTargetAndWritesThem) {
  const auto file = std::filesystem::path(testing::TempDir()) / "ceiling_program_test.json";
  const auto [status, text] =
      outcomeOf("--reachable --target 2.5 0 -0.2 --target 3 0.5 -0.5 --json " + file.string());
  EXPECT_EQ(status, 0);
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 2);
  const auto written = nlohmann::json::parse(std::ifstream(file));
  ASSERT_EQ(written["throws"].size(), 2u);
  EXPECT_GT(written["throws"][1]["release_speed"].get<double>(), 3);
  std::filesystem::remove(file);
}

TEST(CeilingProgram, SaysHowItEnded) {
  EXPECT_EQ(outcomeOf("--help").first, 0);
  EXPECT_EQ(outcomeOf("--reachable --target 30 0 0").first, 1);
  EXPECT_EQ(outcomeOf("--no-such-flag").first, 2);
  EXPECT_EQ(outcomeOf("--starts 0").first, 2);
  EXPECT_EQ(outcomeOf("--target nan 0 0").first, 2);
}

}  // namespace
}  // namespace fastball::bench
