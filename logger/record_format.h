#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

/// One record of LCM's log file format (LCM's documentation, "LCM Log File format"): sync word [4
/// bytes], number of the record [8], time [8], length of channel [4] and data [4], channel, data;
/// all numbers big endian.
namespace fastball::logger {

inline constexpr std::size_t kHeaderBytes = 28;
inline constexpr std::string_view kSyncWord{"\xed\xa1\xda\x01", 4};
/// LCM's own limit.
inline constexpr std::size_t kMaxChannelBytes = 63;
/// Larger data is taken for damage, so that a damaged length cannot fill the memory.
inline constexpr std::size_t kMaxDataBytes = std::size_t{64} << 20;

struct RecordHeader {
  int64_t number = 0;  ///< 0, 1, 2, ... in a file
  int64_t utime = 0;   ///< [us since 1970]
  std::size_t channel_bytes = 0;
  std::size_t data_bytes = 0;
  std::size_t recordBytes() const { return kHeaderBytes + channel_bytes + data_bytes; }
};

/// True if LCM can carry such a message and a log can hold it.
inline bool canBeRecorded(std::size_t channel_bytes, std::size_t data_bytes) {
  return channel_bytes >= 1 && channel_bytes <= kMaxChannelBytes && data_bytes <= kMaxDataBytes;
}

/// @return false if the kHeaderBytes at `bytes` cannot be the header of a record: no sync word, a length beyond its limit, or a
/// time or number that is negative or beyond 2^62.
bool parseHeader(const char* bytes, RecordHeader& header);

/// The kHeaderBytes of a record.
std::string headerBytes(const RecordHeader& header);

/// A big-endian number of eight bytes.
int64_t int64At(const char* bytes);

}  // namespace fastball::logger
