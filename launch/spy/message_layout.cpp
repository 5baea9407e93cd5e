#include "launch/spy/message_layout.h"

#include <endian.h>

#include <algorithm>
#include <cstring>
#include <string>
#include <vector>

namespace fastball::launch {
namespace {

using Type = messaging::TypeLibrary::Type;

constexpr std::size_t kFingerprintBytes = 8;

/// [bytes] of one encoded value; 0: a text or a nested type, which tells it itself.
std::size_t bytesOf(lcm_field_type_t type) {
  switch (type) {
    case LCM_FIELD_INT8_T:
    case LCM_FIELD_BYTE:
    case LCM_FIELD_BOOLEAN:
      return 1;
    case LCM_FIELD_INT16_T:
      return 2;
    case LCM_FIELD_INT32_T:
    case LCM_FIELD_FLOAT:
      return 4;
    case LCM_FIELD_INT64_T:
    case LCM_FIELD_DOUBLE:
      return 8;
    default:
      return 0;
  }
}

bool isSeq(const lcm_field_t& field) {
  return std::string("seq") == field.name && field.num_dim == 0 &&
         (field.type == LCM_FIELD_INT32_T || field.type == LCM_FIELD_INT64_T);
}

class Measurement {
 public:
  explicit Measurement(const messaging::TypeLibrary& types) : types_(types) {}

  /// @return the bytes of all members, none if messages of the type differ in it.
  std::optional<std::size_t> members(const Type& type) {
    if (std::find(within_.begin(), within_.end(), type.info) != within_.end())
      return std::nullopt;  // A type that holds itself can be of any size.
    within_.push_back(type.info);
    const std::vector<std::max_align_t> empty(
        static_cast<std::size_t>(type.info->struct_size()) / sizeof(std::max_align_t) + 1);
    std::optional<std::size_t> sum = 0;
    for (int i = 0; sum && i < type.info->num_fields(); ++i) {
      lcm_field_t field{};
      if (type.info->get_field(empty.data(), i, &field) != 0)
        sum.reset();
      else
        add(type, field, sum);
    }
    within_.pop_back();
    return sum;
  }

  MessageLayout layout;

 private:
  void add(const Type& type, const lcm_field_t& field, std::optional<std::size_t>& sum) {
    if (within_.size() == 1 && isSeq(field)) {
      layout.seq_offset = kFingerprintBytes + *sum;
      layout.seq_bytes = bytesOf(field.type);
    }
    const auto one = value(type, field);
    sum = one ? std::optional(*sum + *one * count(field)) : std::nullopt;
  }

  std::optional<std::size_t> value(const Type& type, const lcm_field_t& field) {
    if (std::find(field.dim_is_variable, field.dim_is_variable + field.num_dim, 1) !=
        field.dim_is_variable + field.num_dim)
      return std::nullopt;
    if (field.type == LCM_FIELD_USER_TYPE) {
      const Type* nested = types_.nested(type, field.typestr);
      return nested == nullptr ? std::nullopt : members(*nested);
    }
    return bytesOf(field.type) == 0 ? std::nullopt : std::optional(bytesOf(field.type));
  }

  static std::size_t count(const lcm_field_t& field) {
    std::size_t product = 1;
    for (int i = 0; i < field.num_dim; ++i)
      product *= static_cast<std::size_t>(field.dim_size[i]);
    return product;
  }

  const messaging::TypeLibrary& types_;
  std::vector<const lcm_type_info_t*> within_;
};

}  // namespace

std::optional<int64_t> MessageLayout::seq(const void* data, std::size_t size) const {
  if (!seq_offset || size < *seq_offset + seq_bytes)
    return std::nullopt;
  const char* place = static_cast<const char*>(data) + *seq_offset;
  if (seq_bytes == sizeof(uint32_t)) {
    uint32_t value = 0;
    std::memcpy(&value, place, sizeof value);
    return static_cast<int32_t>(be32toh(value));
  }
  uint64_t value = 0;
  std::memcpy(&value, place, sizeof value);
  return static_cast<int64_t>(be64toh(value));
}

MessageLayout layoutOf(const messaging::TypeLibrary& types, const Type& type) {
  Measurement measurement(types);
  const auto members = measurement.members(type);
  if (members)
    measurement.layout.bytes = kFingerprintBytes + *members;
  return measurement.layout;
}

}  // namespace fastball::launch
