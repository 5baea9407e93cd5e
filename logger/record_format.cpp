#include "logger/record_format.h"

#include "messaging/big_endian.h"

namespace fastball::logger {
namespace {

void append(std::string& bytes, uint64_t value, int size) {
  for (int i = size - 1; i >= 0; --i)
    bytes.push_back(static_cast<char>(value >> 8 * i));
}

/// Differences of such numbers are numbers.
bool isCount(int64_t value) {
  return value >= 0 && value < int64_t{1} << 62;
}

}  // namespace

int64_t int64At(const char* bytes) {
  return static_cast<int64_t>(messaging::bigEndian({bytes, 8}));
}

bool parseHeader(const char* bytes, RecordHeader& header) {
  if (std::string_view(bytes, kSyncWord.size()) != kSyncWord)
    return false;
  header.number = int64At(bytes + 4);
  header.utime = int64At(bytes + 12);
  header.channel_bytes = messaging::bigEndian({bytes + 20, 4});
  header.data_bytes = messaging::bigEndian({bytes + 24, 4});
  return isCount(header.number) && isCount(header.utime) &&
         canBeRecorded(header.channel_bytes, header.data_bytes);
}

std::string headerBytes(const RecordHeader& header) {
  std::string bytes(kSyncWord);
  append(bytes, static_cast<uint64_t>(header.number), 8);
  append(bytes, static_cast<uint64_t>(header.utime), 8);
  append(bytes, header.channel_bytes, 4);
  append(bytes, header.data_bytes, 4);
  return bytes;
}

}  // namespace fastball::logger
