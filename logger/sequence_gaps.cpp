#include "logger/sequence_gaps.h"

#include <cstddef>
#include <utility>
#include <vector>

#include "logger/record_format.h"
#include "messaging/sequence_step.h"

namespace fastball::logger {
namespace {

/// Of an encoded message: behind fingerprint and utime.
constexpr std::size_t kSeqOffset = 16;

bool isInt64(const lcm_type_info_t& type, int index, const char* name) {
  std::vector<std::max_align_t> message(static_cast<std::size_t>(type.struct_size()));
  lcm_field_t field{};
  return type.num_fields() > index && type.get_field(message.data(), index, &field) == 0 &&
         std::string(name) == field.name && field.type == LCM_FIELD_INT64_T && field.num_dim == 0;
}

}  // namespace

bool hasManySenders(const std::string& channel) {
  return channel == "HEARTBEAT" || channel == "CAMERA_INFO" || channel == "CLOCK" ||
         channel == "ESTOP";
}

bool SequenceGaps::hasSeq(const void* data, std::size_t size) {
  if (size < kSeqOffset + sizeof(int64_t))
    return false;
  const auto [entry, is_first] =
      has_seq_.try_emplace(int64At(static_cast<const char*>(data)), false);
  if (is_first) {
    const auto* type = types_.typeOf(data, size);
    entry->second =
        type != nullptr && isInt64(*type->info, 0, "utime") && isInt64(*type->info, 1, "seq");
  }
  return entry->second;
}

int64_t SequenceGaps::missingBefore(const std::string& channel,
                                    const void* data,
                                    std::size_t size) {
  if (hasManySenders(channel) || !hasSeq(data, size))
    return 0;
  const int64_t seq = int64At(static_cast<const char*>(data) + kSeqOffset);
  const auto [entry, is_first] = last_.try_emplace(channel, seq);
  const int64_t last = std::exchange(entry->second, seq);
  return is_first ? 0 : messaging::missingBetween(last, seq);
}

}  // namespace fastball::logger
