#include "logger/log_reader.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <stdexcept>

namespace fastball::logger {
namespace {

constexpr std::size_t kWindowBytes = 1 << 16;

bool isControlCharacter(char c) {
  return static_cast<unsigned char>(c) < ' ' || c == '\x7f';
}

}  // namespace

LogReader::LogReader(std::string path) : path_(std::move(path)) {
  const auto refuse = [this](const char* reason) {
    throw std::invalid_argument(fmt::format("cannot read the log file '{}': {}", path_, reason));
  };
  file_ = open(path_.c_str(), O_RDONLY | O_CLOEXEC);
  struct stat status {};
  if (file_ < 0 || fstat(file_, &status) != 0)
    refuse(std::strerror(errno));
  if (!S_ISREG(status.st_mode))
    refuse("it is no regular file");
  file_bytes_ = status.st_size;
}

void LogReader::rewind() {
  offset_ = 0;
  damages_.clear();
  damage_count_ = 0;
  damaged_bytes_ = 0;
}

LogReader::~LogReader() {
  if (file_ >= 0)
    close(file_);
}

std::size_t LogReader::readFile(int64_t offset, char* bytes, std::size_t size) const {
  std::size_t done = 0;
  while (done < size) {
    const ssize_t n = pread(file_, bytes + done, size - done, offset + static_cast<int64_t>(done));
    if (n < 0 && errno == EINTR)
      continue;
    if (n < 0)
      throw std::runtime_error(
          fmt::format("cannot read '{}' at byte {}: {}", path_, offset, std::strerror(errno)));
    if (n == 0)
      break;
    done += static_cast<std::size_t>(n);
  }
  return done;
}

/// Up to kWindowBytes, and no more than the file has behind `offset`.
std::size_t LogReader::bytesOfWindow(int64_t offset) const {
  return std::min(kWindowBytes,
                  static_cast<std::size_t>(std::max<int64_t>(file_bytes_ - offset, 0)));
}

/// Copies up to `size` bytes. @return how many there are.
std::size_t LogReader::readAt(int64_t offset, char* bytes, std::size_t size) {
  if (size > kWindowBytes)
    return readFile(offset, bytes, size);
  const int64_t window_end = window_offset_ + static_cast<int64_t>(window_.size());
  // Near its end no window holds more of the file than this one.
  const int64_t needed = std::min(offset + static_cast<int64_t>(size), file_bytes_);
  if (offset < window_offset_ || offset > window_end || needed > window_end) {
    window_.resize(bytesOfWindow(offset));
    window_.resize(readFile(offset, window_.data(), window_.size()));
    window_offset_ = offset;
  }
  return readWindow(static_cast<std::size_t>(offset - window_offset_), bytes, size);
}

std::size_t LogReader::readWindow(std::size_t ahead, char* bytes, std::size_t size) const {
  const std::size_t n = std::min(size, window_.size() - ahead);
  std::copy_n(window_.data() + ahead, n, bytes);
  return n;
}

/// True if what stands there can be a whole record: a header, a channel that is a name, and an end within the file.
bool LogReader::headerAt(int64_t offset, RecordHeader& header, std::string& channel) {
  std::array<char, kHeaderBytes> bytes{};
  if (readAt(offset, bytes.data(), bytes.size()) < bytes.size() ||
      !parseHeader(bytes.data(), header) ||
      offset + static_cast<int64_t>(header.recordBytes()) > file_bytes_)
    return false;
  channel.resize(header.channel_bytes);
  return readAt(offset + static_cast<int64_t>(kHeaderBytes), channel.data(), channel.size()) ==
             channel.size() &&
         std::none_of(channel.begin(), channel.end(), isControlCharacter);
}

bool LogReader::beginsRecord(int64_t offset) {
  RecordHeader header;
  std::string channel;
  return headerAt(offset, header, channel);
}

bool LogReader::next(LogEntry& entry) {
  while (offset_ < file_bytes_) {
    const int64_t from = offset_;
    if (takeRecord(entry))
      return true;
    skipDamage(from);
  }
  return false;
}

/// Takes the record at offset_ if it is one. Where no record follows it, either its own length is damaged or what comes next is;
/// the numbering tells: if the next record that can be found has the number after this one's, nothing lies between.
bool LogReader::takeRecord(LogEntry& entry) {
  RecordHeader header;
  if (!headerAt(offset_, header, entry.channel))
    return false;
  const int64_t end = offset_ + static_cast<int64_t>(header.recordBytes());
  entry.utime = header.utime;
  entry.data.resize(header.data_bytes);
  if (readAt(end - static_cast<int64_t>(header.data_bytes), entry.data.data(), entry.data.size()) <
      entry.data.size())
    return false;
  if (end < file_bytes_ && !beginsRecord(end)) {
    const int64_t found = findRecord(offset_ + static_cast<int64_t>(kSyncWord.size()));
    RecordHeader following;
    std::string channel;
    if (found < end || (found < file_bytes_ && headerAt(found, following, channel) &&
                        following.number == header.number + 1))
      return false;
  }
  offset_ = end;
  return true;
}

void LogReader::skipDamage(int64_t from) {
  offset_ = findRecord(from + 1);
  ++damage_count_;
  damaged_bytes_ += offset_ - from;
  if (damages_.size() < kMaxDamages)
    damages_.push_back({from, offset_ - from});
}

/// @return where the first record at or after `from` begins, or the end of the file.
int64_t LogReader::findRecord(int64_t from) {
  std::vector<char> window(bytesOfWindow(from));
  while (from < file_bytes_) {
    const std::size_t n = readAt(from, window.data(), window.size());
    if (n < kHeaderBytes)
      break;
    const auto end = window.begin() + static_cast<std::ptrdiff_t>(n);
    auto candidate = window.begin();
    for (;; ++candidate) {
      candidate = std::search(candidate, end, kSyncWord.begin(), kSyncWord.end());
      if (candidate == end)
        break;
      const int64_t offset = from + (candidate - window.begin());
      if (beginsRecord(offset))
        return offset;
    }
    // A sync word may lie across the edge of the window.
    from += static_cast<int64_t>(n - (kSyncWord.size() - 1));
  }
  return file_bytes_;
}

int readLog(const std::string& path, const std::function<void(const LogEntry&)>& handler) {
  LogReader reader(path);
  LogEntry entry;
  int64_t messages = 0;
  for (; reader.next(entry); ++messages)
    handler(entry);
  if (messages == 0)
    throw std::invalid_argument(fmt::format("'{}' holds no LCM message", path));
  return reader.damageCount();
}

}  // namespace fastball::logger
