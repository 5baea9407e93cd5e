#include "logger/recorder.h"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <filesystem>
#include <stdexcept>

#include "logger/record_format.h"

namespace fastball::logger {
namespace {

constexpr std::chrono::milliseconds kRetryPeriod{100};

}  // namespace

Recorder::Recorder(RecorderOptions options)
    : options_(std::move(options)), queue_(options_.buffer_bytes) {
  file_ = std::make_unique<LogFile>(filePath(next_file_++));
  status_.files.push_back(file_->path());
  writer_ = std::thread([this] { writeAll(); });
}

Recorder::~Recorder() {
  stop();
}

void Recorder::stop() {
  queue_.close();
  if (writer_.joinable())
    writer_.join();
}

Recorder::Status Recorder::status() const {
  const std::scoped_lock lock(status_mutex_);
  return status_;
}

std::string Recorder::filePath(int number) const {
  if (options_.split_bytes == 0 && options_.split_us == 0)
    return options_.path;
  std::filesystem::path path = options_.path;
  const std::string extension = path.extension().string();
  return path.replace_extension(fmt::format(".{:03d}{}", number, extension)).string();
}

void Recorder::writeAll() {
  std::string records;
  while (queue_.take(records)) {
    std::string_view rest = records;
    while (!write(rest)) {
      if (queue_.isClosed()) {
        queue_.drop(rest);
        break;
      }
      std::this_thread::sleep_for(kRetryPeriod);
    }
  }
}

/// Writes from the front of `records`. @return false if the disk does not take all of them; then the rest is left.
bool Recorder::write(std::string_view& records) {
  while (!records.empty()) {
    const std::size_t fitting = fittingBytes(records);
    if (fitting == 0) {
      if (!openNext())
        return false;
      continue;
    }
    const std::size_t written = file_->append(records.substr(0, fitting));
    countWritten(records.substr(0, written));
    records.remove_prefix(written);
    if (written < fitting)
      return fail(file_->failure());
  }
  fail("");
  return true;
}

/// How many bytes of `records` belong into the file that is open. Its first record does whatever its length.
std::size_t Recorder::fittingBytes(std::string_view records) {
  std::size_t fitting = 0;
  RecordHeader header;
  while (const std::size_t size = firstRecordBytes(records.substr(fitting))) {
    parseHeader(records.data() + fitting, header);
    const int64_t bytes = file_->bytes() + static_cast<int64_t>(fitting);
    if (bytes == 0)
      file_start_utime_ = header.utime;
    const bool too_long =
        options_.split_bytes > 0 && bytes + static_cast<int64_t>(size) > options_.split_bytes;
    const bool too_late =
        options_.split_us > 0 && header.utime - file_start_utime_ >= options_.split_us;
    if (bytes > 0 && (too_long || too_late))
      break;
    fitting += size;
  }
  return fitting;
}

bool Recorder::openNext() {
  try {
    file_ = std::make_unique<LogFile>(filePath(next_file_));
  } catch (const std::invalid_argument& error) {
    return fail(error.what());
  }
  ++next_file_;
  const std::scoped_lock lock(status_mutex_);
  status_.files.push_back(file_->path());
  while (options_.keep > 0 && status_.files.size() > static_cast<std::size_t>(options_.keep)) {
    std::error_code ignored;
    std::filesystem::remove(status_.files.front(), ignored);
    status_.files.erase(status_.files.begin());
  }
  return true;
}

void Recorder::countWritten(std::string_view records) {
  RecordHeader header;
  const std::scoped_lock lock(status_mutex_);
  while (const std::size_t size = firstRecordBytes(records)) {
    parseHeader(records.data(), header);
    ++status_.messages;
    status_.bytes += static_cast<int64_t>(header.data_bytes);
    records.remove_prefix(size);
  }
}

bool Recorder::fail(const std::string& why) {
  const std::scoped_lock lock(status_mutex_);
  status_.failure = why;
  return why.empty();
}

}  // namespace fastball::logger
