// The logger's library alone: what is written is read back, damage is stepped over, gaps are counted.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <random>

#include "logger/run_record.h"
#include "logger/sequence_gaps.h"
#include "tests/logger/log_files.h"

namespace fastball::logger {
namespace {

using testing::HasSubstr;

TEST_F(LogFiles, WhatIsWrittenIsReadBackInOrder) {
  writeStates(path("a.lcmlog"), {0, 1, 2, 3});
  EXPECT_THAT(readSeqs(path("a.lcmlog")), testing::ElementsAre(0, 1, 2, 3));
}

TEST(Gaps, AreCountedOnChannelsWithOneSender) {
  const messaging::TypeLibrary types;
  SequenceGaps gaps(types);
  int64_t missing = 0;
  for (const int64_t seq : {0, 1, 5, 6, 6, 8, 0, 1}) {
    const auto bytes = armState(seq);
    missing += gaps.missingBefore("ARM_STATE", bytes.data(), bytes.size());
  }
  EXPECT_EQ(missing, 4);  // 2, 3, 4 and 7; then the sender began again
}

TEST(Gaps, ANumberFromNowhereDoesNotSpoilTheCount) {
  const messaging::TypeLibrary types;
  SequenceGaps gaps(types);
  int64_t missing = 0;
  for (const int64_t seq :
       {int64_t{0}, INT64_MAX, INT64_MIN, int64_t{-5}, INT64_MAX, int64_t{1}, int64_t{3}}) {
    const auto bytes = armState(seq);
    missing += gaps.missingBefore("ARM_STATE", bytes.data(), bytes.size());
  }
  EXPECT_EQ(missing, 1);  // 2
}

TEST(LogEntry, DoesNotBelieveALength) {
  estop_t estop{};
  estop.reason = "a hand on the red button";
  LogEntry entry;
  entry.data.resize(static_cast<std::size_t>(estop.getEncodedSize()));
  estop.encode(entry.data.data(), 0, estop.getEncodedSize());
  ASSERT_TRUE(entry.decode(estop));
  // The length of the text stands behind fingerprint, utime and seq.
  for (const char top : {'\x7f', '\xff', '\x01'}) {
    entry.data[24] = top;
    EXPECT_FALSE(entry.decode(estop));
  }
}

TEST(Gaps, AreNoneWhereThereIsNoSequence) {
  const messaging::TypeLibrary types;
  SequenceGaps gaps(types);
  for (const int64_t seq : {7, 0, 9}) {
    const auto bytes = armState(seq);
    EXPECT_EQ(gaps.missingBefore("HEARTBEAT", bytes.data(), bytes.size()), 0);
    // The same bytes as another type, of which nobody knows where its seq is.
    auto foreign = bytes;
    foreign[0] = static_cast<char>(foreign[0] + 1);
    EXPECT_EQ(gaps.missingBefore("FOREIGN", foreign.data(), foreign.size()), 0);
    EXPECT_EQ(gaps.missingBefore("SHORT", bytes.data(), 10), 0);
  }
}

TEST(RecordHeader, ATimeThatIsNoneIsNoRecord) {
  RecordHeader header;
  header.channel_bytes = 5;
  RecordHeader read;
  EXPECT_TRUE(parseHeader(headerBytes(header).data(), read));
  for (const int64_t none : {int64_t{-1}, INT64_MIN, INT64_MAX}) {
    RecordHeader wrong = header;
    wrong.utime = none;
    EXPECT_FALSE(parseHeader(headerBytes(wrong).data(), read)) << none;
    wrong = header;
    wrong.number = none;
    EXPECT_FALSE(parseHeader(headerBytes(wrong).data(), read)) << none;
  }
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

TEST_F(LogFiles, OnlyTheDamagedRecordIsLostWhereverItsHeaderIsDamaged) {
  // Where in the header, and what: sync word, length of the channel, length of the data (too long, too short, hostile).
  const std::vector<std::pair<int, std::string>> spots{
      {0, std::string(4, '\xff')},  {20, std::string(4, '\x7f')}, {23, std::string(1, '\0')},
      {26, std::string(1, '\x7f')}, {27, std::string(1, '\1')},   {24, std::string(4, '\xff')}};
  for (const auto& [offset, bytes] : spots) {
    writeStates(path("a.lcmlog"), {0, 1, 2, 3, 4});
    const auto record_size = std::filesystem::file_size(path("a.lcmlog")) / 5;
    damage(path("a.lcmlog"), 2 * record_size + static_cast<std::uintmax_t>(offset), bytes);
    int damaged = 0;
    EXPECT_THAT(readSeqs(path("a.lcmlog"), &damaged), testing::ElementsAre(0, 1, 3, 4)) << offset;
    EXPECT_EQ(damaged, 1) << offset;
  }
}

TEST_F(LogFiles, BytesBetweenRecordsCostNoRecord) {
  writeStates(path("a.lcmlog"), {0, 1, 2, 3});
  std::ifstream whole(path("a.lcmlog"), std::ios::binary);
  std::string bytes((std::istreambuf_iterator<char>(whole)), {});
  const std::size_t record_size = bytes.size() / 4;
  // As long as the reader's window and longer, and with sync words that begin no record.
  for (const std::size_t length : {1UL, 27UL, 65536UL, 200000UL}) {
    std::string noise(length, '\xed');
    for (std::size_t i = 10; i + 4 < length; i += 1000)
      noise.replace(i, 4, kSyncWord);
    std::string longer = bytes;
    longer.insert(2 * record_size, noise);
    std::ofstream(path("b.lcmlog"), std::ios::binary) << longer;
    LogReader reader(path("b.lcmlog"));
    LogEntry entry;
    int messages = 0;
    while (reader.next(entry))
      ++messages;
    // The record before has the number before that of the record after: it may be the one whose length is wrong.
    EXPECT_EQ(messages, 3) << length;
    EXPECT_EQ(reader.damageCount(), 1) << length;
    EXPECT_EQ(reader.damagedBytes(), static_cast<int64_t>(length + record_size)) << length;
  }
}

TEST_F(LogFiles, AnyDamageLeavesEveryRecordThatItDoesNotTouch) {
  std::mt19937 random(3);
  for (int trial = 0; trial < 300; ++trial) {
    writeStates(path("a.lcmlog"), {0, 1, 2, 3, 4, 5, 6, 7, 8, 9});
    const auto size = std::filesystem::file_size(path("a.lcmlog"));
    const auto record_size = static_cast<int64_t>(size) / 10;
    const int64_t length = 1 + static_cast<int64_t>(random() % 200);
    const int64_t offset =
        static_cast<int64_t>(random() % size) % (static_cast<int64_t>(size) - length);
    std::string noise(static_cast<std::size_t>(length), '\0');
    for (char& byte : noise)
      byte = static_cast<char>(random());
    damage(path("a.lcmlog"), static_cast<std::uintmax_t>(offset), noise);
    const std::vector<int64_t> seqs = readSeqs(path("a.lcmlog"));
    for (int64_t seq = 0; seq < 10; ++seq) {
      if ((seq + 1) * record_size <= offset || seq * record_size >= offset + length) {
        EXPECT_THAT(seqs, testing::Contains(seq)) << "damage at " << offset << ", " << length;
      }
    }
  }
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

TEST_F(LogFiles, TheConfigurationComesBackFromTheRecord) {
  std::filesystem::create_directories(path("config/arm"));
  std::ofstream(path("config/trial.yaml")) << "arm: arm/a.yaml\n";
  std::ofstream(path("config/arm/a.yaml")) << "profile: b\n";
  writeRunRecord(path("a.lcmlog"), {"0.1.0", "", path("config/trial.yaml"), 4}, 17);
  std::filesystem::remove_all(path("config"));
  EXPECT_EQ(restoreConfiguration(path("a.lcmlog"), path("back")), path("back/trial.yaml"));
  std::ifstream file(path("back/arm/a.yaml"));
  EXPECT_EQ(std::string(std::istreambuf_iterator<char>(file), {}), "profile: b\n");
  EXPECT_EQ(restoreConfiguration(path("b.lcmlog"), path("none")), "");
}

TEST_F(LogFiles, ARecordWritesNothingOutsideItsFolder) {
  for (const char* name : {"../evil.yaml", "/tmp/evil.yaml", "arm/../../evil.yaml"}) {
    std::ofstream(runRecordPath(path("a.lcmlog")))
        << nlohmann::json{{"config", "e.yaml"}, {"configuration", {{"e.yaml", ""}, {name, "x"}}}};
    EXPECT_THROW(restoreConfiguration(path("a.lcmlog"), path("back")), std::invalid_argument);
    EXPECT_FALSE(std::filesystem::exists(path("evil.yaml")));
  }
}

}  // namespace
}  // namespace fastball::logger
