// The logger's library alone: what is written is read back, damage is stepped over, gaps are counted.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "lcmtypes/fastball_types.h"
#include "logger/log_reader.h"
#include "logger/log_writer.h"
#include "logger/run_record.h"

namespace fastball::logger {
namespace {

using testing::HasSubstr;

std::vector<char> encode(const arm_state_t& message) {
  std::vector<char> bytes(static_cast<std::size_t>(message.getEncodedSize()));
  message.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
  return bytes;
}

std::vector<char> armState(int64_t seq) {
  arm_state_t state{};
  state.seq = seq;
  return encode(state);
}

class LogFiles : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::path(testing::TempDir()) /
              testing::UnitTest::GetInstance()->current_test_info()->name();
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  void writeStates(const std::string& log, const std::vector<int64_t>& seqs) const {
    LogWriter writer(log);
    for (const int64_t seq : seqs) {
      const auto bytes = armState(seq);
      writer.write("ARM_STATE", bytes.data(), bytes.size(), 1000 * seq);
    }
  }

  static std::vector<int64_t> readSeqs(const std::string& log, int* damaged = nullptr) {
    std::vector<int64_t> seqs;
    const int steps = readLog(log, [&](const LogEntry& entry) {
      arm_state_t state{};
      if (entry.decode(state))
        seqs.push_back(state.seq);
    });
    if (damaged)
      *damaged = steps;
    return seqs;
  }

 private:
  std::filesystem::path folder_;
};

TEST_F(LogFiles, WhatIsWrittenIsReadBackInOrder) {
  writeStates(path("a.lcmlog"), {0, 1, 2, 3});
  EXPECT_THAT(readSeqs(path("a.lcmlog")), testing::ElementsAre(0, 1, 2, 3));
}

TEST_F(LogFiles, GapsInTheSequenceAreCountedAsLost) {
  LogWriter writer(path("a.lcmlog"));
  for (const int64_t seq : {0, 1, 5, 6, 6, 8}) {
    const auto bytes = armState(seq);
    writer.write("ARM_STATE", bytes.data(), bytes.size(), 0);
  }
  EXPECT_EQ(writer.lost(), 4);  // 2, 3, 4 and 7
  EXPECT_EQ(writer.messages(), 6);
}

TEST_F(LogFiles, ChannelsWithManySendersHaveNoGaps) {
  LogWriter writer(path("a.lcmlog"));
  for (const int64_t seq : {7, 0, 9}) {
    const auto bytes = armState(seq);
    writer.write("HEARTBEAT", bytes.data(), bytes.size(), 0);
  }
  EXPECT_EQ(writer.lost(), 0);
}

TEST_F(LogFiles, AFlushedLogIsReadableWhileItIsStillOpen) {
  LogWriter writer(path("a.lcmlog"));
  const auto bytes = armState(3);
  writer.write("ARM_STATE", bytes.data(), bytes.size(), 0);
  writer.flush();
  EXPECT_THAT(readSeqs(path("a.lcmlog")), testing::ElementsAre(3));
}

TEST_F(LogFiles, ALogCutInTheMiddleKeepsWhatIsWhole) {
  writeStates(path("a.lcmlog"), {0, 1, 2, 3});
  std::filesystem::resize_file(path("a.lcmlog"), std::filesystem::file_size(path("a.lcmlog")) - 5);
  EXPECT_THAT(readSeqs(path("a.lcmlog")), testing::ElementsAre(0, 1, 2));
}

TEST_F(LogFiles, ABadRecordIsSteppedOverWithItsNeighbourAndReported) {
  writeStates(path("a.lcmlog"), {0, 1, 2, 3, 4});
  const auto record_size = std::filesystem::file_size(path("a.lcmlog")) / 5;
  std::fstream file(path("a.lcmlog"), std::ios::in | std::ios::out | std::ios::binary);
  file.seekp(2 * static_cast<std::streamoff>(record_size));
  file.write("\xff\xff\xff\xff", 4);  // the sync word of record 2
  file.close();
  int damaged = 0;
  EXPECT_THAT(readSeqs(path("a.lcmlog"), &damaged), testing::ElementsAre(0, 3, 4));
  EXPECT_EQ(damaged, 1);
}

TEST_F(LogFiles, AFileThatIsNoLogIsRefusedByName) {
  std::ofstream(path("a.txt")) << "not a log\n";
  EXPECT_THROW(readSeqs(path("a.txt")), std::invalid_argument);
  EXPECT_THROW(readSeqs(path("absent.lcmlog")), std::invalid_argument);
}

TEST_F(LogFiles, AnUnwritablePathIsRefusedByName) {
  try {
    LogWriter writer(path("no/such/folder/a.lcmlog"));
    FAIL() << "the writer took a path that cannot be written";
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(error.what(), HasSubstr("no/such/folder/a.lcmlog"));
    EXPECT_THAT(error.what(), HasSubstr("No such file or directory"));
  }
}

TEST_F(LogFiles, TheRecordBesideTheLogHoldsTheConfigurationAsItWas) {
  std::ofstream(path("experiment.yaml")) << "arm: arm.yaml\n";
  std::ofstream(path("arm.yaml")) << "profile: wam4-48v\n";
  writeRunRecord(path("a.lcmlog"), {"0.1.0", "fastball run --seed 4", path("experiment.yaml"), 4},
                 17);
  std::ifstream file(runRecordPath(path("a.lcmlog")));
  const auto record = nlohmann::json::parse(file);
  EXPECT_EQ(record.at("seed"), 4);
  EXPECT_EQ(record.at("command_line"), "fastball run --seed 4");
  EXPECT_EQ(record.at("configuration").at("arm.yaml"), "profile: wam4-48v\n");
}

}  // namespace
}  // namespace fastball::logger
