#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "lcmtypes/fastball_types.h"
#include "logger/log_reader.h"
#include "logger/log_writer.h"

namespace fastball::logger {

template <class T>
std::vector<char> encode(const T& message) {
  std::vector<char> bytes(static_cast<std::size_t>(message.getEncodedSize()));
  message.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
  return bytes;
}

inline std::vector<char> armState(int64_t seq) {
  arm_state_t state{};
  state.seq = seq;
  return encode(state);
}

template <class T>
void write(LogWriter& writer, const char* channel, const T& message, int64_t utime) {
  const auto bytes = encode(message);
  writer.write(channel, bytes.data(), bytes.size(), utime);
}

/// A folder for the logs of one test.
class LogFiles : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::path(testing::TempDir()) /
              (std::string(testing::UnitTest::GetInstance()->current_test_info()->name()) +
               std::to_string(getpid()));
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  /// ARM_STATE with these numbers; number n is received at n milliseconds.
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

/// Overwrites bytes of a file.
inline void damage(const std::string& log, std::uintmax_t offset, const std::string& bytes) {
  std::fstream file(log, std::ios::in | std::ios::out | std::ios::binary);
  file.seekp(static_cast<std::streamoff>(offset));
  file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

}  // namespace fastball::logger
