#include "logger/log_writer.h"

#include <fmt/format.h>

#include <stdexcept>

#include "logger/record_format.h"

namespace fastball::logger {
namespace {

constexpr std::size_t kBufferBytes = 1 << 20;

}  // namespace

LogWriter::~LogWriter() {
  file_.append(buffer_);
}

void LogWriter::write(const std::string& channel,
                      const void* data,
                      std::size_t size,
                      int64_t utime) {
  if (!canBeRecorded(channel.size(), size))
    throw std::invalid_argument(fmt::format(
        "a message of {} bytes on channel '{}' cannot be put into an LCM log", size, channel));
  appendRecord(buffer_, messages_++, utime, channel, {static_cast<const char*>(data), size});
  if (buffer_.size() >= kBufferBytes)
    flush();
}

void LogWriter::flush() {
  buffer_.erase(0, file_.append(buffer_));
  if (!file_.failure().empty())
    throw std::runtime_error(file_.failure());
}

}  // namespace fastball::logger
