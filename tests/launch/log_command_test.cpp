// `fastball log` as a user calls it: exit statuses and output. What it computes is tested in tests/logger.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <boost/process.hpp>
#include <filesystem>

#include "logger/log_writer.h"

namespace fastball {
namespace {

namespace process = boost::process;
using testing::HasSubstr;

class LogCommand : public testing::Test {
 protected:
  void SetUp() override {
    folder_ =
        std::filesystem::path(testing::TempDir()) / ("log_command_" + std::to_string(getpid()));
    std::filesystem::create_directories(folder_);
    for (int i = 0; i < 3; ++i) {
      logger::LogWriter writer(log(i));
      for (int k = 0; k < 4; ++k)
        writer.write("A", "abc", 3, 1'000'000 * k + i);
    }
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::string log(int i) const { return (folder_ / (std::to_string(i) + ".lcmlog")).string(); }

  /// @return the exit status; what it said is in `said`.
  int run(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "log");
    process::ipstream output;
    process::child child(process::exe = FASTBALL_BIN_DIR "/fastball", process::args = arguments,
                         (process::std_out & process::std_err) > output);
    said.assign(std::istreambuf_iterator<char>(output), {});
    child.wait();
    return child.exit_code();
  }

  std::string said;

 private:
  std::filesystem::path folder_;
};

TEST_F(LogCommand, InfoTakesSeveralLogs) {
  EXPECT_EQ(run({"info", log(0), log(1)}), 0);
  EXPECT_THAT(said, HasSubstr(log(0) + ": 4 messages"));
  EXPECT_THAT(said, HasSubstr(log(1) + ": 4 messages"));
}

TEST_F(LogCommand, CheckFailsWhereSomethingIsWrong) {
  EXPECT_EQ(run({"check", log(0)}), 0);
  EXPECT_THAT(said, HasSubstr("nothing wrong"));
  std::filesystem::resize_file(log(0), std::filesystem::file_size(log(0)) - 1);
  EXPECT_EQ(run({"check", log(0)}), 1);
  EXPECT_THAT(said, HasSubstr("are no record"));
  EXPECT_EQ(run({"repair", log(0), "-o", log(9)}), 0);
  EXPECT_THAT(said, HasSubstr("wrote 3 messages"));
  EXPECT_EQ(run({"check", log(9)}), 0);
}

TEST_F(LogCommand, CutAndMergeWriteNewLogs) {
  EXPECT_EQ(run({"cut", log(0), "-o", log(9), "--from", "1", "--to", "2"}), 0);
  EXPECT_THAT(said, HasSubstr("wrote 2 messages"));
  EXPECT_EQ(run({"merge", log(0), log(1), log(2), "-o", log(8)}), 0);
  EXPECT_THAT(said, HasSubstr("wrote 12 messages"));
}

TEST_F(LogCommand, WrongUseEndsWithStatus2) {
  EXPECT_EQ(run({}), 2);
  EXPECT_EQ(run({"info", "/no/such.lcmlog"}), 2);
  EXPECT_THAT(said, HasSubstr("/no/such.lcmlog"));
  EXPECT_EQ(run({"cut", log(0)}), 2);
  EXPECT_EQ(run({"cut", log(0), "-o", log(1)}), 2);
  EXPECT_THAT(said, HasSubstr("exists already"));
  EXPECT_EQ(run({"export", log(0), "--channel", "A"}), 2);
  EXPECT_EQ(run({"info", log(0), "--types", "/no/such.so"}), 2);
}

}  // namespace
}  // namespace fastball
