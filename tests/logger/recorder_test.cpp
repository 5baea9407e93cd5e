// From the queue to the files: bounded memory, what is dropped and when, splitting, and a disk that is full for a while.
#include "logger/recorder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>

#include <chrono>
#include <filesystem>
#include <functional>
#include <thread>

#include "logger/log_reader.h"

namespace fastball::logger {
namespace {

using testing::ElementsAre;

constexpr std::size_t kRecord = 28 + 1 + 1000;  // header, channel "A", data
const std::string kData(1000, 'x');

TEST(RecordQueue, DropsWhatDoesNotFitAndKnowsWhatAndWhen) {
  RecordQueue queue(3 * kRecord);
  for (int utime = 0; utime < 3; ++utime)
    EXPECT_TRUE(queue.add("A", kData, utime));
  EXPECT_FALSE(queue.add("A", kData, 3));
  EXPECT_FALSE(queue.add("B", kData, 4));
  EXPECT_FALSE(queue.add("A", kData, 5));
  EXPECT_EQ(queue.droppedMessages(), 3);
  EXPECT_EQ(queue.dropped().at("A").messages, 2);
  EXPECT_EQ(queue.dropped().at("A").first_utime, 3);
  EXPECT_EQ(queue.dropped().at("A").last_utime, 5);
  EXPECT_EQ(queue.dropped().at("B").messages, 1);
  EXPECT_EQ(queue.bytes(), 3 * kRecord);
}

TEST(RecordQueue, HasRoomAgainOnlyWhenWhatWasTakenIsWritten) {
  RecordQueue queue(3 * kRecord);
  for (int utime = 0; utime < 3; ++utime)
    queue.add("A", kData, utime);
  std::string records;
  ASSERT_TRUE(queue.take(records));
  EXPECT_EQ(records.size(), 3 * kRecord);
  EXPECT_FALSE(queue.add("A", kData, 3)) << "more in memory than allowed";
  queue.close();
  EXPECT_FALSE(queue.take(records));
  EXPECT_EQ(queue.bytes(), 0U);
}

TEST(RecordQueue, WhatLcmCannotCarryIsDropped) {
  RecordQueue queue(1000000);
  EXPECT_FALSE(queue.add(std::string(64, 'c'), kData, 0));
  EXPECT_FALSE(queue.add("", kData, 0));
  EXPECT_EQ(queue.droppedMessages(), 2);
}

class RecorderFiles : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::path(testing::TempDir()) / ("recorder_" + std::to_string(getpid()));
    std::filesystem::create_directories(folder_);
    options_.path = path("run.lcmlog");
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  static std::vector<int64_t> utimes(const std::string& log) {
    std::vector<int64_t> all;
    readLog(log, [&](const LogEntry& entry) { all.push_back(entry.utime); });
    return all;
  }
  std::filesystem::path folder_;
  RecorderOptions options_;
};

TEST_F(RecorderFiles, AFileEndsBeforeItsLimitOfBytes) {
  options_.split_bytes = 2 * kRecord + 1;
  Recorder recorder(options_);
  for (int utime = 0; utime < 5; ++utime)
    recorder.add("A", kData, utime);
  recorder.add("A", std::string(5000, 'y'), 5);  // longer than a file may be: has one to itself
  recorder.stop();
  EXPECT_THAT(recorder.status().files, ElementsAre(path("run.000.lcmlog"), path("run.001.lcmlog"),
                                                   path("run.002.lcmlog"), path("run.003.lcmlog")));
  EXPECT_THAT(utimes(path("run.000.lcmlog")), ElementsAre(0, 1));
  EXPECT_THAT(utimes(path("run.001.lcmlog")), ElementsAre(2, 3));
  EXPECT_THAT(utimes(path("run.002.lcmlog")), ElementsAre(4));
  EXPECT_THAT(utimes(path("run.003.lcmlog")), ElementsAre(5));
  EXPECT_EQ(recorder.status().messages, 6);
}

TEST_F(RecorderFiles, AFileEndsAtItsLimitOfTimeAndOnlyTheNewestAreKept) {
  options_.split_us = 10;
  options_.keep = 2;
  Recorder recorder(options_);
  for (const int utime : {100, 109, 110, 115, 119, 120, 300})
    recorder.add("A", kData, utime);
  recorder.stop();
  EXPECT_FALSE(std::filesystem::exists(path("run.000.lcmlog")));
  EXPECT_FALSE(std::filesystem::exists(path("run.001.lcmlog")));
  EXPECT_THAT(utimes(path("run.002.lcmlog")), ElementsAre(120));
  EXPECT_THAT(utimes(path("run.003.lcmlog")), ElementsAre(300));
  EXPECT_EQ(recorder.status().files.size(), 2U);
}

/// While one lives, no file of this process can get longer: the disk is full, as far as it can tell.
class FullDisk {
 public:
  explicit FullDisk(rlim_t bytes) {
    signal(SIGXFSZ, SIG_IGN);
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{bytes, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FullDisk() { setrlimit(RLIMIT_FSIZE, &before_); }

 private:
  rlimit before_{};
};

void waitUntil(const std::function<bool()>& condition) {
  for (int i = 0; i < 3000 && !condition(); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  ASSERT_TRUE(condition());
}

TEST_F(RecorderFiles, AFullDiskCostsNothingWhileTheBufferHolds) {
  Recorder recorder(options_);
  {
    const FullDisk full(2 * kRecord + kRecord / 2);
    for (int utime = 0; utime < 5; ++utime)
      recorder.add("A", kData, utime);
    waitUntil([&] { return !recorder.status().failure.empty(); });
    EXPECT_THAT(recorder.status().failure, testing::HasSubstr("File too large"));
    EXPECT_THAT(utimes(options_.path), ElementsAre(0, 1)) << "half a record was left";
    EXPECT_EQ(std::filesystem::file_size(options_.path), 2 * kRecord);
  }
  waitUntil([&] { return recorder.status().messages == 5; });
  EXPECT_EQ(recorder.status().failure, "");
  recorder.stop();
  EXPECT_THAT(utimes(options_.path), ElementsAre(0, 1, 2, 3, 4));
  EXPECT_EQ(recorder.queue().droppedMessages(), 0);
}

TEST_F(RecorderFiles, WhatADiskThatStaysFullDoesNotTakeIsCounted) {
  options_.buffer_bytes = 4 * kRecord;
  Recorder recorder(options_);
  const FullDisk full(2 * kRecord);
  recorder.add("A", kData, 0);
  recorder.add("A", kData, 1);
  waitUntil([&] { return recorder.queue().bytes() == 0; });
  for (int utime = 2; utime < 10; ++utime)
    recorder.add("A", kData, utime);
  EXPECT_EQ(recorder.queue().dropped().at("A").messages, 4);
  recorder.stop();
  EXPECT_EQ(recorder.status().messages, 2);
  EXPECT_EQ(recorder.queue().dropped().at("A").messages, 8);
  EXPECT_THAT(utimes(options_.path), ElementsAre(0, 1));
}

}  // namespace
}  // namespace fastball::logger
