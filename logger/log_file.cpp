#include "logger/log_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>

#include "logger/record_format.h"

namespace fastball::logger {
namespace {

constexpr mode_t kReadableByAll = 0666;

/// The longest part of `records` that is whole records and no longer than `limit`.
std::size_t wholeRecords(std::string_view records, std::size_t limit) {
  std::size_t whole = 0;
  for (;;) {
    const std::size_t next = firstRecordBytes(records.substr(whole));
    if (next == 0 || whole + next > limit)
      return whole;
    whole += next;
  }
}

}  // namespace

LogFile::LogFile(std::string path)
    : path_(std::move(path)),
      file_(open(path_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, kReadableByAll)) {
  if (file_ < 0)
    throw std::invalid_argument(
        fmt::format("cannot write the log file '{}': {}", path_, std::strerror(errno)));
}

LogFile::~LogFile() {
  close(file_);
}

std::size_t LogFile::append(std::string_view records) {
  failure_.clear();
  std::size_t done = 0;
  while (done < records.size()) {
    const ssize_t n = pwrite(file_, records.data() + done, records.size() - done,
                             bytes_ + static_cast<int64_t>(done));
    if (n < 0 && errno == EINTR)
      continue;
    if (n <= 0) {
      failure_ =
          fmt::format("cannot write to '{}': {}", path_, std::strerror(n < 0 ? errno : ENOSPC));
      done = wholeRecords(records, done);
      break;
    }
    done += static_cast<std::size_t>(n);
  }
  bytes_ += static_cast<int64_t>(done);
  // Half a record would make other readers give up the one before it. If this fails the next append() overwrites it.
  if (!failure_.empty() && ftruncate(file_, bytes_) != 0)
    failure_ += fmt::format("; its end cannot be cut off: {}", std::strerror(errno));
  return done;
}

void appendRecord(std::string& records,
                  int64_t number,
                  int64_t utime,
                  std::string_view channel,
                  std::string_view data) {
  records += headerBytes({number, utime, channel.size(), data.size()});
  records += channel;
  records += data;
}

std::size_t firstRecordBytes(std::string_view records) {
  RecordHeader header;
  return records.size() >= kHeaderBytes && parseHeader(records.data(), header)
             ? header.recordBytes()
             : 0;
}

}  // namespace fastball::logger
