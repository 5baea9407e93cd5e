#include "messaging/message_field.h"

#include <fmt/format.h>

#include <charconv>
#include <cstring>

#include "messaging/big_endian.h"

namespace fastball::messaging {
namespace {

template <class Real, class Bits>
Real fromBits(uint64_t value) {
  const auto bits = static_cast<Bits>(value);
  Real real;
  static_assert(sizeof real == sizeof bits);
  std::memcpy(&real, &bits, sizeof real);
  return real;
}

}  // namespace

std::size_t encodedBytes(MessageField::Kind kind) {
  using Kind = MessageField::Kind;
  switch (kind) {
    case Kind::kInt16:
      return 2;
    case Kind::kInt32:
    case Kind::kFloat:
      return 4;
    case Kind::kInt64:
    case Kind::kDouble:
      return 8;
    default:
      return 1;
  }
}

MessageField::MessageField(std::string name, Kind kind, std::vector<int64_t> sizes)
    : name_(std::move(name)), kind_(kind), sizes_(std::move(sizes)) {
  for (const int64_t size : sizes_)
    count_ *= static_cast<std::size_t>(size);
}

std::string MessageField::elementName(std::size_t i) const {
  std::string indices;
  for (auto size = sizes_.rbegin(); size != sizes_.rend(); ++size) {
    const auto n = static_cast<std::size_t>(*size);
    indices = fmt::format("[{}]", i % n) + indices;
    i /= n;
  }
  return name_ + indices;
}

std::optional<std::size_t> MessageField::indexOf(const std::string& element_name) const {
  if (element_name.compare(0, name_.size(), name_) != 0)
    return std::nullopt;
  const char* next = element_name.data() + name_.size();
  const char* const end = element_name.data() + element_name.size();
  std::size_t index = 0;
  for (const int64_t size : sizes_) {
    int64_t i = -1;
    if (next == end || *next != '[')
      return std::nullopt;
    next = std::from_chars(next + 1, end, i).ptr;
    if (next == end || *next != ']' || i < 0 || i >= size)
      return std::nullopt;
    ++next;
    index = index * static_cast<std::size_t>(size) + static_cast<std::size_t>(i);
  }
  return next == end ? std::optional(index) : std::nullopt;
}

std::string_view MessageField::bytes(std::size_t i) const {
  if (isText())
    return texts_[i];
  const std::size_t size = encodedBytes(kind_);
  return {data_ + i * size, size};
}

double MessageField::number(std::size_t i) const {
  if (kind_ == Kind::kDouble)
    return fromBits<double, uint64_t>(bigEndian(bytes(i)));
  if (kind_ == Kind::kFloat)
    return fromBits<float, uint32_t>(bigEndian(bytes(i)));
  return static_cast<double>(integer(i));
}

int64_t MessageField::integer(std::size_t i) const {
  const uint64_t value = bigEndian(bytes(i));
  switch (kind_) {
    case Kind::kInt16:
      return static_cast<int16_t>(value);
    case Kind::kInt32:
      return static_cast<int32_t>(value);
    case Kind::kInt64:
      return static_cast<int64_t>(value);
    case Kind::kByte:
      return static_cast<int64_t>(value);
    default:
      return static_cast<int8_t>(value);
  }
}

std::string MessageField::text(std::size_t i) const {
  if (isText())
    return std::string(texts_[i]);
  if (kind_ == Kind::kFloat)
    return fmt::format("{}", static_cast<float>(number(i)));
  return isReal() ? fmt::format("{}", number(i)) : fmt::format("{}", integer(i));
}

}  // namespace fastball::messaging
