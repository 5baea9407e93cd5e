#include "logger/record_queue.h"

#include <algorithm>
#include <chrono>

#include "logger/log_file.h"
#include "logger/record_format.h"

namespace fastball::logger {
namespace {

constexpr std::size_t kChunkBytes = 1 << 20;

}  // namespace

bool RecordQueue::add(std::string_view channel, std::string_view data, int64_t utime) {
  const std::size_t size = kHeaderBytes + channel.size() + data.size();
  const std::scoped_lock lock(mutex_);
  if (closed_ || !canBeRecorded(channel.size(), data.size()) || size > max_bytes_ ||
      bytes_ > max_bytes_ - size) {
    countDropped(channel, utime);
    return false;
  }
  if (chunks_.empty() || chunks_.back().size() + size > kChunkBytes) {
    chunks_.emplace_back();
    chunks_.back().reserve(std::max(size, kChunkBytes));
    if (chunks_.size() > 1)
      filled_.notify_one();
  }
  appendRecord(chunks_.back(), next_number_++, utime, channel, data);
  bytes_ += size;
  return true;
}

bool RecordQueue::take(std::string& records) {
  std::unique_lock lock(mutex_);
  bytes_ -= records.size();
  records.clear();
  while (chunks_.empty() && !closed_)
    filled_.wait_for(lock, std::chrono::duration<double>(kLongestWait));
  if (chunks_.size() == 1 && !closed_)
    filled_.wait_for(lock, std::chrono::duration<double>(kLongestWait),
                     [this] { return closed_ || chunks_.size() > 1; });
  if (chunks_.empty())
    return false;
  records = std::move(chunks_.front());
  chunks_.pop_front();
  return true;
}

void RecordQueue::close() {
  const std::scoped_lock lock(mutex_);
  closed_ = true;
  filled_.notify_all();
}

void RecordQueue::drop(std::string_view records) {
  const std::scoped_lock lock(mutex_);
  RecordHeader header;
  while (const std::size_t size = firstRecordBytes(records)) {
    parseHeader(records.data(), header);
    countDropped(records.substr(kHeaderBytes, header.channel_bytes), header.utime);
    records.remove_prefix(size);
  }
}

void RecordQueue::countDropped(std::string_view channel, int64_t utime) {
  auto entry = dropped_.find(channel);
  if (entry == dropped_.end())
    entry = dropped_.emplace(channel, Dropped{0, utime, utime}).first;
  ++entry->second.messages;
  entry->second.last_utime = utime;
  ++dropped_messages_;
}

std::map<std::string, RecordQueue::Dropped> RecordQueue::dropped() const {
  const std::scoped_lock lock(mutex_);
  return {dropped_.begin(), dropped_.end()};
}

int64_t RecordQueue::droppedMessages() const {
  const std::scoped_lock lock(mutex_);
  return dropped_messages_;
}

std::size_t RecordQueue::bytes() const {
  const std::scoped_lock lock(mutex_);
  return bytes_;
}

bool RecordQueue::isClosed() const {
  const std::scoped_lock lock(mutex_);
  return closed_;
}

}  // namespace fastball::logger
