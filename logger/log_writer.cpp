#include "logger/log_writer.h"

#include <fmt/format.h>
#include <lcm/lcm-cpp.hpp>

#include <cerrno>
#include <cstring>
#include <stdexcept>

namespace fastball::logger {
namespace {

/// An encoded message of ours begins with its type's fingerprint, utime and seq, each 8 bytes, most significant byte first.
constexpr std::size_t kSeqOffset = 16;

int64_t readBigEndian(const void* data) {
  uint64_t value = 0;
  for (int i = 0; i < 8; ++i)
    value = value << 8 | static_cast<const unsigned char*>(data)[i];
  return static_cast<int64_t>(value);
}

/// Several processes say these, each with its own seq.
bool hasManySenders(const std::string& channel) {
  return channel == "HEARTBEAT" || channel == "CAMERA_INFO" || channel == "ESTOP";
}

}  // namespace

LogWriter::LogWriter(const std::string& path) : path_(path) {
  errno = 0;
  file_ = std::make_unique<lcm::LogFile>(path, "w");
  if (!file_->good())
    throw std::invalid_argument(
        fmt::format("cannot write the log file '{}': {}", path, std::strerror(errno)));
}

LogWriter::~LogWriter() = default;

void LogWriter::write(const std::string& channel,
                      const void* data,
                      std::size_t size,
                      int64_t utime) {
  countGaps(channel, data, size);
  lcm::LogEvent event{};
  event.timestamp = utime;
  event.channel = channel;
  event.datalen = static_cast<int32_t>(size);
  event.data = const_cast<void*>(data);  // LogEvent has no const; writeEvent only reads
  errno = 0;
  if (file_->writeEvent(&event) != 0) {
    ++lost_;
    failure_ = fmt::format("cannot write to '{}': {}", path_, std::strerror(errno));
    return;
  }
  ++messages_;
  bytes_ += static_cast<int64_t>(size);
}

void LogWriter::countGaps(const std::string& channel, const void* data, std::size_t size) {
  if (size < kSeqOffset + 8 || hasManySenders(channel))
    return;
  const int64_t seq = readBigEndian(static_cast<const char*>(data) + kSeqOffset);
  const auto [entry, is_first] = last_seq_.emplace(channel, seq);
  if (is_first)
    return;
  if (seq > entry->second + 1)
    lost_ += seq - entry->second - 1;
  entry->second = seq;
}

void LogWriter::flush() {
  errno = 0;
  if (std::fflush(file_->getFilePtr()) != 0)
    failure_ = fmt::format("cannot write to '{}': {}", path_, std::strerror(errno));
}

}  // namespace fastball::logger
